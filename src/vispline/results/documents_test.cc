#include "vispline/results/documents.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "vispline/core/so3.h"

namespace vispline {
namespace {

using Json = nlohmann::ordered_json;

const JsonContext kContext{.version = "1.2.3", .inputs = {}, .diagnostics = {}};

std::vector<std::string> keys(const Json& object) {
  std::vector<std::string> result;
  for (const auto& [key, value] : object.items()) result.push_back(key);
  return result;
}

std::vector<IntegrationRow> integration_rows() {
  return {{.method = "midpoint",
           .rate_hz = 100.0,
           .error = {.final_error_m = 0.5,
                     .max_error_m = 0.75,
                     .rmse_m = 0.25,
                     .attitude_error_deg = 2.0,
                     .samples = 9,
                     .outside = 1},
           .order = {}},
          {.method = "midpoint", .rate_hz = 200.0, .error = {}, .order = 2.0}};
}

ImuComparison imu_comparison() {
  ImuComparison c;
  c.time_offset_s = -0.0025;
  c.rotation_vector = Vector3d(0.0, 0.0, 0.5 * std::numbers::pi);
  c.R_second_first = SO3::exp<double>(c.rotation_vector);
  c.offset_correlation = 0.99;
  c.offset_confidence = 0.6;
  c.aligned = true;
  c.gyroscope[1] = {.rms = 0.5, .mean = 0.3, .std = 0.4, .correlation = 0.75};
  c.accelerometer[2] = {.rms = 5.0, .mean = 3.0, .std = 4.0, .correlation = {}};
  c.compared = 90;
  c.outside = 7;
  c.in_gaps = 3;
  c.diagnostics.add({"W-UNPAIRED", "m", "", "e", "n"});
  return c;
}

TrajectoryComparison trajectory_comparison() {
  TrajectoryComparison c;
  c.alignment_mode = AlignmentMode::kSim3;
  c.alignment = {SO3::exp<double>(Vector3d(0.0, 0.0, 0.1)), Vector3d(1.0, 2.0, 3.0), 1.5};
  c.association.pairs.resize(2);
  c.association.estimate_outside = 4;
  c.duration_s = 10.0;
  c.path_length_m = 20.0;
  c.position_m = {.rmse = 0.5, .mean = 0.4, .median = 0.3, .max = 0.9, .std = 0.2};
  c.rotation_rmse_deg = 1.5;
  c.rotation_max_deg = 2.5;
  c.relative = {{{1.0, DeltaUnit::kSeconds}, 7, 0.125, 0.25}, {{100.0, DeltaUnit::kMetres}, 0, {}, {}}};
  return c;
}

TEST(Documents, Integrate) {
  const Json json = Json::parse(integrate_json(integration_rows(), kContext));
  EXPECT_EQ(keys(json), (std::vector<std::string>{"schema", "version", "rows", "diagnostics", "diagnostic_counts"}));
  EXPECT_EQ(json["schema"], "vispline.integrate/1");
  EXPECT_EQ(json["version"], "1.2.3");
  EXPECT_EQ(json["rows"][0].dump(),
            R"({"method":"midpoint","rate_hz":100.0,"final_error_m":0.5,"max_error_m":0.75,"rmse_m":0.25,)"
            R"("attitude_error_deg":2.0,"order":null,"samples":9,"outside":1})");
  EXPECT_EQ(json["rows"][1]["order"], 2.0);
}

TEST(Documents, EvaluateImu) {
  const Json json = Json::parse(evaluate_imu_json(imu_comparison(), kContext));
  EXPECT_EQ(keys(json),
            (std::vector<std::string>{"schema", "version", "aligned", "time_offset_s", "offset_correlation",
                                      "offset_confidence", "rotation_deg", "rotation_vector_rad", "rotation_matrix",
                                      "gyroscope", "accelerometer", "samples_compared", "samples_outside",
                                      "samples_in_gaps", "diagnostics", "diagnostic_counts"}));
  EXPECT_EQ(json["schema"], "vispline.evaluate_imu/1");
  EXPECT_EQ(json["time_offset_s"], -0.0025);
  EXPECT_NEAR(json["rotation_deg"].get<double>(), 90.0, 1e-12);
  EXPECT_NEAR(json["rotation_matrix"][0][1].get<double>(), -1.0, 1e-15);
  EXPECT_EQ(json["gyroscope"][1].dump(),
            R"({"axis":"y","rms_rad_per_s":0.5,"correlation":0.75,"mean_rad_per_s":0.3,"std_rad_per_s":0.4})");
  EXPECT_EQ(json["accelerometer"][2].dump(),
            R"({"axis":"z","rms_m_per_s2":5.0,"correlation":null,"mean_m_per_s2":3.0,"std_m_per_s2":4.0})");
  EXPECT_EQ(json["samples_in_gaps"], 3);
  EXPECT_EQ(json["diagnostics"][0]["code"], "W-UNPAIRED");
}

TEST(Documents, EvaluateTrajectory) {
  const Json json = Json::parse(evaluate_trajectory_json(trajectory_comparison(), kContext));
  EXPECT_EQ(keys(json), (std::vector<std::string>{"schema", "version", "alignment", "scale", "rotation_matrix",
                                                  "translation_m", "pairs", "estimate_outside", "estimate_unmatched",
                                                  "reference_unmatched", "duration_s", "path_length_m", "ate", "rpe",
                                                  "diagnostics", "diagnostic_counts"}));
  EXPECT_EQ(json["alignment"], "sim3");
  EXPECT_EQ(json["scale"], 1.5);
  EXPECT_EQ(json["pairs"], 2);
  EXPECT_EQ(json["ate"].dump(),
            R"({"rmse_m":0.5,"mean_m":0.4,"median_m":0.3,"max_m":0.9,"std_m":0.2,"rotation_rmse_deg":1.5,)"
            R"("rotation_max_deg":2.5})");
  EXPECT_EQ(json["rpe"][0].dump(),
            R"({"delta":1.0,"delta_unit":"s","pairs":7,"translation_rmse_m":0.125,"rotation_rmse_deg":0.25})");
  EXPECT_TRUE(json["rpe"][1]["translation_rmse_m"].is_null());
}

/// Every key of every document is explained in docs/json.md.
TEST(Documents, EveryKeyIsDocumented) {
  std::ifstream file(VISPLINE_SOURCE_DIR "/docs/json.md");
  ASSERT_TRUE(file);
  std::stringstream page;
  page << file.rdbuf();
  JsonContext context = kContext;
  context.inputs.push_back({"first", {.read = 1, .kept = 1, .dropped = {}}});
  const auto check = [&](const auto& self, const Json& json) -> void {
    if (json.is_array()) {
      for (const Json& element : json) self(self, element);
    }
    if (!json.is_object()) return;
    for (const auto& [key, value] : json.items()) {
      if (!key.starts_with("W-")) {
        EXPECT_NE(page.str().find("`" + key + "`"), std::string::npos) << key;
      }
      self(self, value);
    }
  };
  check(check, Json::parse(integrate_json(integration_rows(), context)));
  check(check, Json::parse(evaluate_imu_json(imu_comparison(), context)));
  check(check, Json::parse(evaluate_trajectory_json(trajectory_comparison(), context)));
}

TEST(Documents, TextsForPeople) {
  EXPECT_EQ(integrate_text(integration_rows()),
            "method    rate [Hz]  final [m]  max [m]  rmse [m]  attitude [deg]  order\n"
            "--------  ---------  ---------  -------  --------  --------------  -----\n"
            "midpoint        100        0.5     0.75      0.25               2      -\n"
            "midpoint        200          0        0         0               0      2\n");
  const std::string imu = evaluate_imu_text(imu_comparison());
  EXPECT_NE(imu.find("time offset   -0.0025 s"), std::string::npos);
  EXPECT_NE(imu.find("accelerometer  z       5     3    4  m/s^2            -\n"), std::string::npos) << imu;
  const std::string trajectory = evaluate_trajectory_text(trajectory_comparison());
  EXPECT_NE(trajectory.find("alignment     sim3, scale 1.5\n"), std::string::npos);
  EXPECT_NE(trajectory.find("100 m         0                     -                    -\n"), std::string::npos)
      << trajectory;
}

}  // namespace
}  // namespace vispline
