#include "vispline/results/calibration_documents.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "vispline/results/calibration_result_testing.h"

namespace vispline {
namespace {

using Json = nlohmann::ordered_json;
const JsonContext kContext{.version = "0.1.0", .inputs = {}, .diagnostics = {}};

std::vector<std::string> keys(const Json& json) {
  std::vector<std::string> names;
  for (const auto& [key, value] : json.items()) names.push_back(key);
  return names;
}

TEST(CalibrationDocuments, ExitCodesAndNames) {
  const std::vector<std::pair<ResultClass, int>> codes{
      {ResultClass::kConverged, 0},     {ResultClass::kConvergedWeak, 0}, {ResultClass::kNotConverged, 5},
      {ResultClass::kRankDeficient, 5}, {ResultClass::kInconsistent, 5},  {ResultClass::kFailed, 5},
      {ResultClass::kStopped, 130}};
  std::set<std::string_view> names;
  for (const auto& [result_class, code] : codes) {
    EXPECT_EQ(exit_code_of(result_class), code) << to_name(result_class);
    EXPECT_EQ(is_trusted(result_class), code == 0);
    names.insert(to_name(result_class));
  }
  EXPECT_EQ(names.size(), codes.size());
}

TEST(CalibrationDocuments, Json) {
  const Json json = Json::parse(calibration_json(testing::calibration_result(), kContext));
  EXPECT_EQ(keys(json), (std::vector<std::string>{"schema",
                                                  "version",
                                                  "class",
                                                  "reasons",
                                                  "parameters",
                                                  "fixed",
                                                  "held",
                                                  "residuals",
                                                  "weak_directions",
                                                  "initialisation",
                                                  "correlation",
                                                  "condition",
                                                  "nees",
                                                  "gradient_sigmas",
                                                  "curvature",
                                                  "knots",
                                                  "ate",
                                                  "jackknife",
                                                  "twin",
                                                  "first_cost",
                                                  "cost",
                                                  "iterations",
                                                  "cpu_s",
                                                  "diagnostics",
                                                  "diagnostic_counts"}));
  EXPECT_EQ(json["schema"], "vispline.result/1");
  EXPECT_EQ(json["class"], "converged-weak");
  const Json& lever = json["parameters"][0];
  EXPECT_EQ(lever["name"], "cam0.T_c_i.translation");
  EXPECT_EQ(lever["value"].dump(), "[0.0301,null,-0.0102]");  // y is not observable
  EXPECT_EQ(lever["sigma"].dump(), "[0.0004,0.041,0.0003]");
  EXPECT_EQ(lever["unit"], "m");
  EXPECT_EQ(lever["not_observable"].dump(), R"(["y"])");
  EXPECT_EQ(json["parameters"][2]["units"].dump(), R"(["px","1"])");
  EXPECT_EQ(json["parameters"][2]["truth"].dump(), "[420.0,null]");
  EXPECT_EQ(json["residuals"][0]["sensor"], "cam0");
  EXPECT_EQ(json["residuals"][0]["count"], 4);
  EXPECT_EQ(json["correlation"]["matrix"].dump(), "[[1.0,-0.3],[-0.3,1.0]]");
  EXPECT_EQ(json["cpu_s"].dump(), R"({"read":0.25,"solve":1.5})");
}

TEST(CalibrationDocuments, EveryKeyIsDocumented) {
  std::ifstream file(VISPLINE_SOURCE_DIR "/docs/json.md");
  std::stringstream page;
  page << file.rdbuf();
  const auto check = [&](const auto& self, const Json& json) -> void {
    if (json.is_array()) {
      for (const Json& element : json) self(self, element);
    }
    if (!json.is_object()) return;
    for (const auto& [key, value] : json.items()) {
      if (key == "cpu_s" || key == "one_sigma" || key == "diagnostic_counts") continue;  // names of the problem
      EXPECT_NE(page.str().find("`" + key + "`"), std::string::npos) << key;
      self(self, value);
    }
  };
  check(check, Json::parse(calibration_json(testing::calibration_result(), kContext)));
}

TEST(CalibrationDocuments, TextSpeaksInUnitsOfPeople) {
  const std::string text = calibration_text(testing::calibration_result());
  for (const char* expected :
       {"class: converged-weak", "cam0.T_c_i.translation y", "not observable", "30.1", "mm", "68.7549", "deg", "29",
        "us", "weak: cam0.T_c_i.translation along y: 41 mm", "cam0.line_delay", "69 %", "NEES 0.97 of 2 numbers",
        "53.5", "turn faster about x and z", "passed", "trajectory against the truth: 2 mm"}) {
    EXPECT_NE(text.find(expected), std::string::npos) << expected << "\n" << text;
  }
  EXPECT_EQ(text.find("90 "), std::string::npos) << "a value that is not observable must not be printed";
}

}  // namespace
}  // namespace vispline
