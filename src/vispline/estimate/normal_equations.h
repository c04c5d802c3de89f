/// The problem linearised at a state, and its damped solution. docs/math/estimate.md, The linear system.
#pragma once

#include <optional>
#include <vector>

#include "vispline/estimate/problem.h"
#include "vispline/estimate/skyline.h"

namespace vispline {

struct Step {
  Eigen::VectorXd delta{};
  std::vector<Vector3d> delta_landmark{};
  double predicted = 0.0;  ///< decrease of the cost by the quadratic model
};

/// Cost of a state, without derivatives.
struct CostAt {
  double cost = 0.0;
  std::size_t lost = 0;
};
CostAt cost_at(const Problem& problem, const State& state, const Columns& columns, std::size_t threads);

class NormalEquations {
 public:
  /// That the damping takes a column to have at least: one that nothing was measured of stays where it is.
  static constexpr double kLeastInformation = 1e-6;

  /// Linearises everything, with the weights that the problem has. Work is cut into chunks that do not depend on
  /// `threads`, summed in order.
  NormalEquations(const Problem& problem, const State& state, const Columns& columns, std::size_t threads)
      : NormalEquations(problem, state, columns, threads, Weights::kKept) {}
  /// First fixes the weights of all rows by the state, until the next call: cost_at() goes by them.
  static NormalEquations renewed(Problem& problem, const State& state, const Columns& columns, std::size_t threads);

  double cost() const { return cost_; }
  std::size_t lost() const { return lost_; }
  /// Damped by lambda times the diagonal; empty if the matrix is not positive definite.
  std::optional<Step> step(double lambda) const;
  /// H^-1 B for the columns of the system, the landmarks eliminated; empty if H is not positive definite.
  std::optional<Eigen::MatrixXd> solve(const Eigen::MatrixXd& B) const;
  /// Covariance of the last n columns; empty if the information matrix does not have full rank: not positive definite,
  /// or a variance that has grown beyond what double can tell from infinity.
  std::optional<Eigen::MatrixXd> covariance(int n) const;
  /// As covariance(), of the system damped by lambda (floored where nothing is measured): directions that are not
  /// measured have variances of order 1 / lambda, over the diagonal of the information.
  std::optional<Eigen::MatrixXd> damped_covariance(int n, double lambda) const;
  /// The last n columns with all else absorbed, of the system damped by lambda: their information, and the gradient that
  /// is left. Empty if the matrix is not positive definite.
  struct Tail {
    Eigen::MatrixXd information{};
    Eigen::VectorXd gradient{};
  };
  std::optional<Tail> tail(int n, double lambda) const;
  /// Where everything moves when the gradient is pushed by each column of `push`: H^-1 push, landmarks eliminated.
  /// Empty if the matrix is not positive definite.
  std::vector<Step> respond(const Eigen::MatrixXd& push) const;
  /// Information of each unknown when all others are known.
  Eigen::VectorXd diagonal() const { return H_.diagonal(); }

 private:
  NormalEquations(const Problem& problem, const State& state, const Columns& columns, std::size_t threads,
                  Weights weights);
  struct Reduced {
    Skyline H;
    Eigen::VectorXd g;
    std::vector<Eigen::Matrix3d> L_inverse;  ///< of each track
    bool positive = false;
  };
  Reduced reduce(double lambda) const;
  /// Takes the landmarks of kSize unknowns out of the system; false if they have no unique solution.
  template <int kSize>
  bool eliminate(double lambda, Reduced& reduced) const;
  /// Landmarks after all else is known, with or without their own gradient; returns their share of twice the predicted
  /// decrease.
  double substitute(double lambda, const Reduced& reduced, bool gradient, Step& step) const;
  template <int kSize>
  double substitute_of(double lambda, const Reduced& reduced, bool gradient, Step& step) const;

  LandmarkUnknowns unknowns_;
  Skyline H_;
  Eigen::VectorXd g_;
  std::vector<TrackBlock> tracks_;
  double cost_ = 0.0;
  std::size_t lost_ = 0;
};

}  // namespace vispline
