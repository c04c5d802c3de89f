/// What an estimation found, how well each number is known, and whether it is to be trusted: plain values, for
/// documents, tables and pages. docs/math/uncertainty.md.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "vispline/core/error.h"
#include "vispline/core/types.h"
#include "vispline/results/result_class.h"
#include "vispline/results/sigma_checks.h"
#include "vispline/results/trajectory_metrics.h"

namespace vispline {

/// One number of a parameter.
struct ParameterComponent {
  std::string name{};  ///< "x", "fu", "k1"; empty if it is the only one
  std::string unit{};
  double value = 0.0;
  double start = 0.0;             ///< what the estimation began with
  double sigma = 0.0;             ///< standard deviation; not finite without full rank
  double limit = 0.0;             ///< of sigma: above, the component counts as not observable
  std::optional<double> truth{};  ///< where somebody knows it
  std::optional<double> error{};  ///< value less truth, in the sense of sigma

  bool observable() const { return sigma <= limit; }
};

/// A parameter that was estimated. The value of a rotation R_a_b is its rotation vector, the sigmas are about the axes
/// of frame b (X exp(delta)); those of a unit vector are of its coordinates.
struct EstimatedParameter {
  std::string name{};  ///< "cam0.T_c_i.rotation"
  std::string unit{};  ///< of all components, or "px, 1" where they differ
  std::vector<ParameterComponent> components{};
  std::optional<double> prior_sigma{};  ///< of a prior around `start`
};

/// Residuals of one sensor at the solution; statistics over the single numbers of its readings.
struct SensorResiduals {
  std::string sensor{};     ///< "imu0.gyroscope", "cam0"
  std::string unit{};       ///< of rms and sigma
  std::int64_t count = 0;   ///< numbers: three for a triad, two for a pixel
  double sigma = 0.0;       ///< of one number, as the solver assumed
  double rig_sigma = 0.0;   ///< as the rig says; 0 if it says nothing
  double rms = 0.0;         ///< in the unit
  double dof = 0.0;         ///< count less what the unknowns absorbed
  double chi2_per_dof = 0;  ///< 1 if sigma is right and the model too; robust weights counted
  double lag1 = 0.0;        ///< correlation of consecutive readings, 0 if white
  double lag1_low = 0.0;    ///< band of a white sensor, 99.9 %
  double lag1_high = 0.0;
  std::int64_t lost = 0;         ///< readings that cannot be predicted, behind the camera for instance; not in count
  std::int64_t outliers = 0;     ///< readings beyond 4 sigma
  std::vector<double> time_s{};  ///< of every reading, from the first stamp of the recording
  std::vector<std::vector<double>> residual{};  ///< by component: x, y, z or u, v; in the unit
  std::vector<Vector2d> px{};                   ///< where in the image, cameras only
};

/// A direction of the parameters that the recording hardly measures.
struct WeakDirection {
  bool measured = true;                                ///< false: not at all
  std::string words{};                                 ///< "cam0.T_c_i.translation along y: 41 mm"
  std::string remedy{};                                ///< "turn about x or z"
  double sigma_limits = 0;                             ///< largest sigma along it, over the limit of that component
  std::vector<std::pair<std::string, double>> part{};  ///< component, one sigma along it in the component's unit
};

/// A parameter that was not estimated, though the residuals ask for it.
struct HeldParameter {
  std::string name{};
  std::string unit{};
  double share = 0.0;            ///< of all squared residuals, in sigmas, that freeing it would take away
  std::vector<double> change{};  ///< where it would go from the value it is held at, by one Newton step
  std::vector<double> sigma{};
};

/// One step of the initialisation: a number and what it had to reach.
struct InitialisationStage {
  std::string name{};
  double value = 0.0;
  double limit = 0.0;
  std::string unit{};
  bool passed = false;
  std::string words{};  ///< what the number is
};

struct KnotSpacing {
  double spacing_s = 0.0;
  int order = 4;
  std::string kind{};  ///< "se3" or "split"
  std::string why{};   ///< one sentence
};

struct CalibrationResult {
  ResultClass result_class = ResultClass::kFailed;
  std::vector<std::string> reasons{};  ///< sentences with the numbers that decided the class
  std::vector<EstimatedParameter> parameters{};
  std::vector<std::string> fixed{};               ///< names of what was not estimated
  std::vector<HeldParameter> held{};              ///< those of them that the residuals object to, the worst first
  std::vector<std::string> correlation_labels{};  ///< "cam0.T_c_i.rotation x"
  Eigen::MatrixXd correlation{};                  ///< empty without full rank
  double condition = 0.0;                         ///< of the correlation matrix
  std::optional<double>
      nees{};  ///< squared error of all numbers by their covariance, over their number; with the truth
  double gradient_sigmas = 0.0;  ///< farthest that the cost's lowest point lies from a parameter, in its sigma
  double curvature_low = 1.0;    ///< of the cost along parameters, by differences over that of the information matrix
  double curvature_high = 1.0;
  std::vector<SensorResiduals> residuals{};
  std::vector<WeakDirection> weak{};
  std::vector<InitialisationStage> stages{};
  KnotSpacing knots{};
  double first_cost = 0.0, cost = 0.0;  ///< half the sum of squares
  int iterations = 0;
  std::vector<std::pair<std::string, double>> cpu_s{};  ///< by stage, in order
  std::optional<TrajectoryComparison> trajectory{};     ///< with the truth, where somebody knows it
  std::optional<Jackknife> jackknife{};
  std::optional<Twin> twin{};
  Diagnostics diagnostics{};
};

}  // namespace vispline
