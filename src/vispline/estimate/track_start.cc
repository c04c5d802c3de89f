#include "vispline/estimate/track_start.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <memory>

#include "vispline/core/rn.h"
#include "vispline/core/so3.h"
#include "vispline/estimate/plane_across.h"
#include "vispline/estimate/skyline.h"
#include "vispline/trajectory/spline.h"

namespace vispline {
namespace {

constexpr int kRounds = 6;
constexpr double kFirstDepth_m = 3.0;
constexpr double kHuber_sigmas = 3.0;
constexpr double kSmooth = 300.0;      // m/s^2, as in priors.h
constexpr double kBiasSigma = 0.3;     // m/s^2
constexpr double kPointSigma_m = 1e3;  // holds points that no parallax places

using PositionSpline = Spline<Rn<3>, 4>;

/// Weights of the four knots at an instant, and of their second derivative.
struct Weights {
  std::size_t first;
  std::array<double, 4> value, second;
};

/// One ray: the point lies on it. [n]x R_c_b R_b_w (X - p(t)) = [n]x ..., scaled by the inverse of its depth.
struct Ray {
  Weights at;
  Eigen::Matrix<double, 2, 3> across_w;  ///< two directions across the ray, frame w
  Vector3d lever_w;                      ///< from the body to the camera
  double inverse_depth = 1.0 / kFirstDepth_m;
  double weight = 1.0;
};

class LinearStart {
 public:
  explicit LinearStart(const TrackStartInput& input)
      : input_(input),
        knots_(PositionSpline::knots_for(input.span.end - input.span.begin, input.spacing)),
        spline_(std::make_shared<PositionSpline>(input.span.begin, input.spacing,
                                                 std::vector<Vector3d>(knots_, Vector3d::Zero()))) {
    for (const Track& track : input.tracks) rays_.push_back(rays_of(track));
    points_.resize(rays_.size());
  }

  std::optional<TrackStart> run() {
    for (int round = 0; round < kRounds; ++round) {
      if (!solve()) return std::nullopt;
      update_weights();
    }
    return result();
  }

 private:
  int gravity() const { return 3 * static_cast<int>(knots_); }
  int bias() const { return gravity() + 3; }
  int columns() const { return bias() + 3; }

  Weights weights(Time t, double extra_s) const {
    const auto place = spline_->locate(t, extra_s);
    const auto basis = spline_->basis(place);
    Weights w{place.first, {}, {}};
    for (std::size_t m = 0; m < 4; ++m) {
      const double before = m == 0 ? 1.0 : basis.value[m - 1], after = m == 3 ? 0.0 : basis.value[m];
      const double before2 = m == 0 ? 0.0 : basis.d2[m - 1], after2 = m == 3 ? 0.0 : basis.d2[m];
      w.value[m] = before - after;
      w.second[m] = before2 - after2;
    }
    return w;
  }

  std::vector<Ray> rays_of(const Track& track) const {
    std::vector<Ray> rays;
    for (const Sighting& s : track.sightings) {
      const Camera& camera = input_.rig.cameras[s.camera];
      const auto bearing_c = camera.lens.unproject(s.px);
      const Time at = s.stamp + from_seconds(camera.delay_s(s.px));
      if (!bearing_c || !input_.span.contains(at)) continue;
      const Pose T_b_c = camera.T_c_b.inverse();
      const Matrix3d R_w_b = input_.R_w_b(at);
      Ray ray;
      ray.at = weights(at, 0.0);
      ray.across_w = plane_across(R_w_b * T_b_c.R * *bearing_c).transpose();
      ray.lever_w = R_w_b * T_b_c.p;
      rays.push_back(ray);
    }
    return rays;
  }

  static std::vector<int> knot_columns(const Weights& w) {
    std::vector<int> columns;
    for (int i = 0; i < 12; ++i) columns.push_back(3 * static_cast<int>(w.first) + i);
    return columns;
  }

  void add_rows(Skyline& H, Eigen::VectorXd& g, const std::vector<int>& columns, const Eigen::MatrixXd& J,
                const Eigen::VectorXd& r) const {
    H.add(columns, J.transpose() * J);
    const Eigen::VectorXd d = J.transpose() * r;
    for (std::size_t i = 0; i < columns.size(); ++i) g(columns[i]) += d(static_cast<Eigen::Index>(i));
  }

  /// R_b_w (p'' - g) + b = f, in frame b.
  void add_accelerometer(Skyline& H, Eigen::VectorXd& g) const {
    for (std::size_t i = 0; i < input_.imu_time.size(); ++i) {
      if (!input_.span.contains(input_.imu_time[i])) continue;
      const Weights w = weights(input_.imu_time[i], 0.0);
      const Matrix3d R_b_w = input_.R_w_b(input_.imu_time[i]).transpose();
      std::vector<int> columns = knot_columns(w);
      for (int c = 0; c < 6; ++c) columns.push_back(gravity() + c);
      Eigen::MatrixXd J(3, 18);
      for (int m = 0; m < 4; ++m) J.middleCols<3>(3 * m) = w.second[static_cast<std::size_t>(m)] * R_b_w;
      J.middleCols<3>(12) = -R_b_w;
      J.rightCols<3>().setIdentity();
      add_rows(H, g, columns, J / input_.accel_sigma, input_.imu[i].accel / input_.accel_sigma);
    }
  }

  /// The first knots stay near the origin; bends and the bias stay small.
  void add_priors(Skyline& H, Eigen::VectorXd& g) const {
    Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(columns());
    diagonal.segment<3>(3).setConstant(1e6);
    diagonal.segment<3>(bias()).setConstant(1.0 / (kBiasSigma * kBiasSigma));
    H.add_to_diagonal(diagonal);
    const double dt = to_seconds(input_.spacing), scale = 1.0 / (kSmooth * dt * dt);
    for (std::size_t k = 0; k + 2 < knots_; ++k) {
      std::vector<int> columns;
      for (int i = 0; i < 9; ++i) columns.push_back(3 * static_cast<int>(k) + i);
      Eigen::MatrixXd J(3, 9);
      J << scale * Matrix3d::Identity(), -2.0 * scale * Matrix3d::Identity(), scale * Matrix3d::Identity();
      add_rows(H, g, columns, J, Eigen::VectorXd::Zero(3));
    }
  }

  struct Point {
    std::vector<int> column{};
    Eigen::MatrixXd W{};
    Matrix3d H = Matrix3d::Zero();
    Vector3d g = Vector3d::Zero();
  };

  Point add_track(Skyline& H, Eigen::VectorXd& g, const std::vector<Ray>& rays) const {
    Point point;
    std::size_t first = knots_, last = 0;
    for (const Ray& ray : rays) {
      first = std::min(first, ray.at.first);
      last = std::max(last, ray.at.first + 3);
    }
    if (rays.empty()) return point;
    for (std::size_t c = 3 * first; c < 3 * (last + 1); ++c) point.column.push_back(static_cast<int>(c));
    point.W = Eigen::MatrixXd::Zero(3, static_cast<Eigen::Index>(point.column.size()));
    point.H.diagonal().setConstant(1.0 / (kPointSigma_m * kPointSigma_m));
    for (const Ray& ray : rays) {
      const double scale = std::sqrt(ray.weight) * ray.inverse_depth / input_.bearing_sigma;
      const Eigen::Matrix<double, 2, 3> A = scale * ray.across_w;
      Eigen::MatrixXd J(2, 12);
      for (int m = 0; m < 4; ++m) J.middleCols<3>(3 * m) = -ray.at.value[static_cast<std::size_t>(m)] * A;
      const Vector2d r = A * ray.lever_w;
      add_rows(H, g, knot_columns(ray.at), J, r);
      point.H += A.transpose() * A;
      point.g += A.transpose() * r;
      point.W.middleCols(3 * static_cast<Eigen::Index>(ray.at.first - first), 12) += A.transpose() * J;
    }
    return point;
  }

  bool solve() {
    Skyline H(columns());
    std::vector<int> tail;
    for (int c = 0; c < 6; ++c) tail.push_back(gravity() + c);
    for (std::size_t k = 0; k + 3 < knots_; ++k) {
      std::vector<int> columns = knot_columns({k, {}, {}});
      columns.insert(columns.end(), tail.begin(), tail.end());
      H.couple(columns);
    }
    for (const auto& rays : rays_) {
      std::vector<int> columns;
      for (const Ray& ray : rays) {
        const auto part = knot_columns(ray.at);
        columns.insert(columns.end(), part.begin(), part.end());
      }
      H.couple(columns);
    }
    H.allocate();
    Eigen::VectorXd g = Eigen::VectorXd::Zero(columns());
    add_accelerometer(H, g);
    add_priors(H, g);
    std::vector<Point> points;
    for (const auto& rays : rays_) points.push_back(add_track(H, g, rays));
    ProductPanel panel(H);
    for (const Point& point : points) {
      if (point.column.empty()) continue;
      const Matrix3d L_inverse = Eigen::LLT<Matrix3d>(point.H).matrixL().solve(Matrix3d(Matrix3d::Identity()));
      const Eigen::MatrixXd P_t = (L_inverse * point.W).transpose();
      panel.add(point.column, P_t);
      const Eigen::VectorXd p = P_t * (L_inverse * point.g);
      for (std::size_t i = 0; i < point.column.size(); ++i) g(point.column[i]) -= p(static_cast<Eigen::Index>(i));
    }
    panel.flush();
    if (!H.factor()) return false;
    x_ = H.solve(g);
    for (std::size_t t = 0; t < points.size(); ++t) {
      const Point& point = points[t];
      if (point.column.empty()) continue;
      Vector3d rhs = point.g;
      for (std::size_t i = 0; i < point.column.size(); ++i) {
        rhs -= point.W.col(static_cast<Eigen::Index>(i)) * x_(point.column[i]);
      }
      points_[t] = point.H.llt().solve(rhs);
    }
    return x_.allFinite();
  }

  Vector3d position(const Weights& w) const {
    Vector3d p = Vector3d::Zero();
    for (std::size_t m = 0; m < 4; ++m) p += w.value[m] * x_.segment<3>(3 * static_cast<Eigen::Index>(w.first + m));
    return p;
  }

  void update_weights() {
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t t = 0; t < rays_.size(); ++t) {
      for (Ray& ray : rays_[t]) {
        const Vector3d d = points_[t] - position(ray.at) - ray.lever_w;
        ray.inverse_depth = 1.0 / std::clamp(d.norm(), 0.2, 1e3);
        const double off = (ray.across_w * d).norm() * ray.inverse_depth;
        const double size = off / input_.bearing_sigma;
        ray.weight = size > kHuber_sigmas ? kHuber_sigmas / size : 1.0;
        sum += off * off;
        ++count;
      }
    }
    rms_ = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(2 * count, 1)));
  }

  TrackStart result() {
    std::vector<Vector3d> knots;
    for (std::size_t k = 0; k < knots_; ++k) knots.push_back(x_.segment<3>(3 * static_cast<Eigen::Index>(k)));
    spline_ = std::make_shared<PositionSpline>(input_.span.begin, input_.spacing, std::move(knots));
    TrackStart start;
    start.p_w = [spline = spline_](Time t) {
      return spline->element(std::clamp(t, spline->span().begin, spline->span().end));
    };
    start.g_w = x_.segment<3>(gravity());
    start.accel_bias = x_.segment<3>(bias());
    start.bearing_rms = rms_;
    for (std::size_t t = 0; t < rays_.size(); ++t) {
      if (rays_[t].size() < 2) {
        start.point_w.emplace_back();
      } else {
        start.point_w.emplace_back(points_[t]);
      }
    }
    return start;
  }

  const TrackStartInput& input_;
  std::size_t knots_;
  std::shared_ptr<PositionSpline> spline_;
  std::vector<std::vector<Ray>> rays_;
  std::vector<Vector3d> points_;
  Eigen::VectorXd x_;
  double rms_ = 0.0;
};

}  // namespace

std::optional<TrackStart> start_from_tracks(const TrackStartInput& input) { return LinearStart(input).run(); }

}  // namespace vispline
