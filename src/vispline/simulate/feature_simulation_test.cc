/// Simulated features against projections found by bisection in code of this file, and their laws.
#include "vispline/simulate/feature_simulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "vispline/core/error.h"
#include "vispline/core/so3.h"
#include "vispline/simulate/random_cloud.h"
#include "vispline/simulate/rig_simulation.h"
#include "vispline/trajectory/analytic.h"

namespace vispline {
namespace {

constexpr Duration kSecond = std::chrono::seconds(1);
const Time kStart = time_from_ns(5'000'000'017);

/// A shaken hand, up to about 4 rad/s and 2 m/s.
AnalyticMotion shaken(const Taylor& t) {
  return {{0.6 * sin(3.1 * t), 0.4 * cos(2.3 * t), 0.3 * sin(4.7 * t)},
          {0.5 * sin(5.3 * t), 0.4 * cos(6.1 * t), 0.7 * sin(4.1 * t)}};
}

const AnalyticCurve kShaken(shaken, kStart, 10 * kSecond);

Rig rolling_rig(ReadoutDirection direction = ReadoutDirection::kDown) {
  Rig rig;
  rig.cameras = {{.name = "cam0", .rate_hz = 23.7}, {.name = "cam1", .rate_hz = 9.3, .resolution_px = {400, 500}}};
  for (Camera& camera : rig.cameras) {
    camera.lens.model = LensModel::kPinholeRadtan;
    camera.lens.params.resize(8);
    camera.lens.params << 410.0, 405.0, 316.0, 243.0, -0.21, 0.05, 1e-3, -5e-4;
    camera.T_c_b.R << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    camera.T_c_b.R = SO3::exp<double>(Vector3d(0.1, -0.2, 0.05)) * camera.T_c_b.R;
    camera.T_c_b.p = Vector3d(0.03, -0.05, 0.02);
    camera.time_offset_s = 0.0123456;
    camera.shutter = {.line_delay_s = 5.1e-5, .direction = direction};
    camera.pixel_sigma_px = 0.0;
  }
  rig.cameras[1].T_c_b.p.x() = -0.1;
  rig.cameras[1].time_offset_s = -0.0031;
  return rig;
}

Scene cloud() { return random_cloud({.count = 300, .seed = 4}); }

FeatureSimulation all_features() {
  FeatureSimulation options{.seed = 11};
  options.tracks = {.is_target = true};
  options.clocks = {{"cam0", {.phase_s = 0.004}}, {"cam1", {.phase_s = 0.0217, .drift = 4e-5}}};
  return options;
}

/// Lens of the test, on its own: pinhole with radial-tangential distortion.
Vector2d seen(const LensParams& k, const Vector3d& point_c) {
  const double x = point_c.x() / point_c.z(), y = point_c.y() / point_c.z(), r2 = x * x + y * y;
  const double radial = 1.0 + k[4] * r2 + k[5] * r2 * r2;
  return {k[0] * (x * radial + 2.0 * k[6] * x * y + k[7] * (r2 + 2.0 * x * x)) + k[2],
          k[1] * (y * radial + k[6] * (r2 + 2.0 * y * y) + 2.0 * k[7] * x * y) + k[3]};
}

double line_of(const Camera& camera, const Vector2d& px) {
  switch (camera.shutter.direction) {
    case ReadoutDirection::kDown:
      return px.y();
    case ReadoutDirection::kUp:
      return camera.resolution_px[1] - 1 - px.y();
    case ReadoutDirection::kRight:
      return px.x();
    case ReadoutDirection::kLeft:
      return camera.resolution_px[0] - 1 - px.x();
  }
  return 0.0;
}

/// By bisection on the time of the line, in seconds since the start of the curve: never rounded to a nanosecond.
Vector2d bisected(const Camera& camera, double first_line_s, const Vector3d& point_w) {
  const auto px_at = [&](double line) {
    const BodyState body = body_state(shaken(Taylor::time(first_line_s + camera.shutter.line_delay_s * line)));
    const Vector3d point_b = body.R_w_b.transpose() * (point_w - body.p_w);
    return seen(camera.lens.params, camera.T_c_b * point_b);
  };
  double low = -1.0, high = std::max(camera.resolution_px[0], camera.resolution_px[1]);
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (line_of(camera, px_at(middle)) > middle ? low : high) = middle;
  }
  return px_at(0.5 * (low + high));
}

void expect_roots(ReadoutDirection direction) {
  const Rig rig = rolling_rig(direction);
  const Scene scene = cloud();
  const FeatureSimulation options = all_features();
  double worst_px = 0.0;
  const FeatureCounts counts = simulate_features(
      Trajectory(kShaken), rig, scene, kStart, 2 * kSecond, options, [&](const SimulatedFrame& frame) {
        const Camera& camera = rig.cameras[frame.instant.camera];
        const double stamp_s = to_seconds(frame.instant.stamp - kStart);
        const double first_line_s =
            stamp_s + clock_of(options.clocks, camera.name).drift * stamp_s + camera.time_offset_s;
        EXPECT_NEAR(to_seconds(frame.body_time - kStart), first_line_s, 1e-9);
        for (std::size_t i = 0; i < frame.features.size(); ++i) {
          const Vector3d& point_w = scene.landmarks[frame.truth[i].landmark].point_w;
          const Vector2d expected = bisected(camera, first_line_s, point_w);
          worst_px = std::max(worst_px, (frame.features[i].px - expected).norm());
          EXPECT_EQ(frame.features[i].px, frame.truth[i].exact_px);
          EXPECT_NEAR(frame.truth[i].line_s, camera.shutter.line_delay_s * line_of(camera, expected), 1e-12);
        }
      });
  EXPECT_GT(counts.features, 500U);
  EXPECT_EQ(counts.outliers, 0U);
  EXPECT_LT(worst_px, 1e-9);
}

TEST(FeatureSimulation, AgreesWithBisection) {
  for (const auto direction :
       {ReadoutDirection::kDown, ReadoutDirection::kUp, ReadoutDirection::kRight, ReadoutDirection::kLeft}) {
    expect_roots(direction);
  }
}

TEST(FeatureSimulation, EveryLandmarkInSightIsThere) {
  Rig rig = rolling_rig();
  for (Camera& camera : rig.cameras) camera.shutter.line_delay_s = 0.0;
  const Scene scene = cloud();
  simulate_features(Trajectory(kShaken), rig, scene, kStart, kSecond, all_features(), [&](const SimulatedFrame& frame) {
    const Camera& camera = rig.cameras[frame.instant.camera];
    const Pose T_w_c = frame.body.T_w_b() * camera.T_c_b.inverse();
    std::size_t visible = 0;
    for (const SceneLandmark& landmark : scene.landmarks) visible += scene.visible(T_w_c, camera, landmark).has_value();
    EXPECT_EQ(frame.features.size(), visible);
  });
}

std::string bytes_of(const FeatureSimulation& options) {
  Rig rig = rolling_rig();
  for (Camera& camera : rig.cameras) camera.pixel_sigma_px = 0.8;
  std::string bytes;
  simulate_features(Trajectory(kShaken), rig, cloud(), kStart, 3 * kSecond, options, [&](const SimulatedFrame& frame) {
    for (const Feature& feature : frame.features) {
      bytes.append(reinterpret_cast<const char*>(&feature.id), sizeof feature.id);
      bytes.append(reinterpret_cast<const char*>(feature.px.data()), 2 * sizeof(double));
    }
  });
  return bytes;
}

TEST(FeatureSimulation, TheSameBytesForAnyNumberOfThreads) {
  FeatureSimulation options{.dropout = 0.1, .outliers = 0.05, .seed = 3};
  const std::string one = bytes_of(options);
  EXPECT_FALSE(one.empty());
  for (const std::size_t threads : {2, 3, 7}) {
    options.threads = threads;
    EXPECT_EQ(bytes_of(options), one);
  }
  options.seed = 4;
  EXPECT_NE(bytes_of(options), one);
}

TEST(FeatureSimulation, NoiseDropoutsAndOutliersAsAsked) {
  Rig rig = rolling_rig();
  for (Camera& camera : rig.cameras) camera.pixel_sigma_px = 0.8;
  FeatureSimulation options = all_features();
  const auto count_all = [&] {
    return simulate_features(Trajectory(kShaken), rig, cloud(), kStart, 8 * kSecond, options, [](const auto&) {})
        .features;
  };
  const auto all = static_cast<double>(count_all());
  options.dropout = 0.2;
  options.outliers = 0.1;
  double squares = 0.0, good = 0.0, bad = 0.0;
  simulate_features(Trajectory(kShaken), rig, cloud(), kStart, 8 * kSecond, options, [&](const SimulatedFrame& frame) {
    for (std::size_t i = 0; i < frame.features.size(); ++i) {
      const Vector2d error = frame.features[i].px - frame.truth[i].exact_px;
      if (frame.truth[i].is_outlier) {
        bad += 1.0;
        EXPECT_LT(error.norm(), 20.0 + 5.0);
      } else {
        good += 1.0;
        squares += error.squaredNorm();
      }
    }
  });
  EXPECT_NEAR((good + bad) / all, 0.8, 5.0 * std::sqrt(0.8 * 0.2 / all));
  EXPECT_NEAR(bad / (good + bad), 0.1, 5.0 * std::sqrt(0.1 * 0.9 / (good + bad)));
  EXPECT_NEAR(std::sqrt(squares / (2.0 * good)), 0.8, 5.0 * 0.8 / std::sqrt(4.0 * good));
}

TEST(FeatureSimulation, StampsAreThoseOfEachClock) {
  const Rig rig = rolling_rig();
  const FeatureSimulation options = all_features();
  std::vector<std::vector<Time>> stamps(2);
  Time last{};
  simulate_features(Trajectory(kShaken), rig, cloud(), kStart, kSecond, options, [&](const SimulatedFrame& frame) {
    EXPECT_GE(frame.instant.stamp, last);
    last = frame.instant.stamp;
    stamps[frame.instant.camera].push_back(frame.instant.stamp);
  });
  for (std::size_t i = 0; i < 2; ++i) {
    const SampleClock clock{kStart + from_seconds(options.clocks.at(rig.cameras[i].name).phase_s),
                            rig.cameras[i].rate_hz};
    for (std::size_t k = 0; k < stamps[i].size(); ++k) {
      EXPECT_EQ(stamps[i][k], clock(static_cast<std::int64_t>(k)));
    }
  }
}

TEST(FeatureSimulation, ImagesOutsideTheTrajectoryAreCounted) {
  const Rig rig = rolling_rig();
  const FeatureCounts counts = simulate_features(Trajectory(kShaken), rig, cloud(), kStart + 9 * kSecond, 2 * kSecond,
                                                 all_features(), [](const auto&) {});
  EXPECT_GT(counts.frames, 25U);
  EXPECT_GT(counts.frames_outside, 25U);
  EXPECT_THROW(simulate_features(Trajectory(kShaken), rig, cloud(), kStart + 20 * kSecond, kSecond, all_features(),
                                 [](const auto&) {}),
               Error);
}

TEST(FeatureSimulation, ARecordingHoldsAllSensors) {
  Rig rig = rolling_rig();
  rig.imus = {{.name = "imu0"}, {.name = "imu1", .rate_hz = 100.0}};
  RigSimulation options{.seed = 2,
                        .clocks = {{"imu1", {.phase_s = 0.003, .drift = 5e-5}}, {"cam1", {.phase_s = 0.02}}}};
  const Time start = kStart + kSecond;
  const Recording recording = simulate(Trajectory(kShaken), rig, cloud(), start, kSecond, options);
  EXPECT_EQ(recording.imus.at("imu0").size(), 200U);
  EXPECT_EQ(recording.imus.at("imu1").size(), 100U);
  EXPECT_EQ(recording.imus.at("imu1").time[0], start + from_seconds(0.003));
  EXPECT_EQ(recording.features.at("cam0").size(), 24U);
  EXPECT_EQ(recording.features.at("cam1").size(), 10U);
  const Time last = recording.imus.at("imu1").time[99];
  const Time body_time = last + from_seconds(5e-5 * to_seconds(last - start));
  const Vector3d expected =
      Gyroscope::predict<double>(kShaken.at(body_time), rig.imus[1].gyroscope, Vector3d(0.0, 0.0, -9.81));
  EXPECT_EQ(recording.imus.at("imu1").value[99].gyro, expected);
}

}  // namespace
}  // namespace vispline
