/// What was measured, as rows of a least-squares problem: residual over sigma, and its derivatives.
/// docs/math/estimate.md, Measurements.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "vispline/estimate/parameter.h"
#include "vispline/estimate/state.h"

namespace vispline {

/// Where the derivatives of a measurement go.
struct Columns {
  Layout layout{};
  ParameterColumns parameters{};
};

/// Robust loss rho(s) of a squared residual s, in sigmas: quadratic up to `width`, linear beyond (Huber).
struct Huber {
  double width = 0.0;  ///< 0: least squares

  double loss(double s) const;
  /// rho'(s): the weight of the residual's rows.
  double weight(double s) const;
};

/// Rows that share their columns; a column of the system stands there once.
struct Rows {
  Eigen::VectorXd r{};       ///< (predicted - measured) / sigma
  Eigen::VectorXd weight{};  ///< rho', one a row
  Eigen::MatrixXd J{};       ///< one column for each entry of `column`, or for each row of `chain`
  Eigen::MatrixXd chain{};   ///< when not empty, the derivatives by `column` are J chain: few columns for all rows
  std::vector<int> column{};
  double cost = 0.0;     ///< sum rho / 2
  std::size_t lost = 0;  ///< readings that the model cannot predict here, behind the camera for instance: left out

  /// Rows with zeros; forgets the columns.
  void start(Eigen::Index rows);
  /// Local index of the first of `size` consecutive columns, appended; -1 for those of a fixed parameter.
  int append(int first_column, int size);
  /// After all columns are appended.
  void allocate_jacobian() { J.setZero(r.size(), static_cast<Eigen::Index>(column.size())); }
  /// One column for each entry of `column`.
  Eigen::MatrixXd jacobian() const { return chain.size() == 0 ? J : Eigen::MatrixXd(J * chain); }
  /// jacobian()^T B, for a B with as many rows as r.
  Eigen::MatrixXd pull(const Eigen::MatrixXd& B) const;
};

/// What a sensor's residuals are in, and how large one of their numbers was assumed to be.
struct SensorScale {
  std::string unit{};
  double sigma = 0.0;  ///< 0: not a reading of an instrument, or one that is not used
};

/// Where a row comes from.
struct RowOrigin {
  Time time{};                   ///< on the clock of the sensor
  int component = 0;             ///< of the reading: 0, 1, 2 for x, y, z
  std::optional<Vector2d> px{};  ///< where in the image
};

/// Readings of one sensor over a short time. Any thread may evaluate it.
class Measurement {
 public:
  virtual ~Measurement() = default;
  /// "imu0.gyroscope", "cam0": whose residuals the rows are.
  virtual std::vector<std::string> sensors() const = 0;
  /// Index into sensors() of a row.
  virtual std::size_t sensor_of(Eigen::Index /*row*/) const { return 0; }
  virtual SensorScale scale_of(std::size_t /*sensor*/) const { return {}; }
  virtual RowOrigin origin_of(Eigen::Index /*row*/) const { return {time()}; }
  /// Rows that hold what nothing measures; no noise is behind them.
  virtual bool only_holds() const { return false; }
  /// When the rows were measured, on the clock of the sensor: orders residuals in time.
  virtual Time time() const = 0;
  /// Fixes what weighs the rows by the state it depends on, until the next call: line_whitening() of a rolling shutter.
  virtual void whiten(const State& /*state*/) {}
  virtual void evaluate(const State& state, const Columns& columns, bool derivatives, Rows& rows) const = 0;
};

/// What a reading that cannot be predicted costs, in sigmas: a step that loses readings must not look cheap.
inline constexpr double kLostSigmas = 100.0;

/// Consecutive knots as local columns: knot `first` begins at `local`.
struct KnotColumns {
  std::size_t first = 0;
  int local = 0;
  /// Adds rows of the knots given by `part`, scaled, to J from row `row` on.
  template <class Part>
  void add(const Part& part, std::size_t part_first, Eigen::Index row, Eigen::MatrixXd& J) const {
    J.block(row, local + 6 * static_cast<int>(part_first - first), part.rows(), part.cols()) += part;
  }
};
/// From `first` to the last knot of the segment that begins with `last_first`.
KnotColumns append_knots(const Curve& curve, const Layout& layout, std::size_t first, std::size_t last_first,
                         Rows& rows);

}  // namespace vispline
