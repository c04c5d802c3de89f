#include "vispline/results/allan_documents.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "vispline/results/allan_result_testing.h"

namespace vispline {
namespace {

using Json = nlohmann::ordered_json;

const JsonContext kContext{.version = "1.2.3", .inputs = {}, .diagnostics = {}};

std::vector<std::string> keys(const Json& object) {
  std::vector<std::string> result;
  for (const auto& [key, value] : object.items()) result.push_back(key);
  return result;
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> result;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) result.push_back(line);
  return result;
}

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> result(1);
  for (const char c : line) {
    if (c == ',') {
      result.emplace_back();
    } else {
      result.back() += c;
    }
  }
  return result;
}

TEST(AllanJson, KeysOfTheDocument) {
  JsonContext context = kContext;
  context.inputs = {{"imu", {.read = 12, .kept = 10, .dropped = {{"W-NONFINITE", 2}}}}};
  const Json json = Json::parse(allan_json(synthetic_allan_result(), context));
  EXPECT_EQ(keys(json), (std::vector<std::string>{"schema", "version", "rate_hz", "duration_s", "samples", "segments",
                                                  "summary", "signals", "samples_read", "samples_kept",
                                                  "samples_dropped", "inputs", "diagnostics", "diagnostic_counts"}));
  EXPECT_EQ(json["schema"], "vispline.allan/1");
  EXPECT_EQ(json["samples_kept"], 10);
  EXPECT_EQ(json["diagnostic_counts"].dump(), R"({"W-GAP":1,"W-MOTION":1})");
  ASSERT_EQ(json["signals"].size(), 6u);
  EXPECT_EQ(keys(json["signals"][0]),
            (std::vector<std::string>{"sensor", "axis", "unit", "mean", "standard_deviation", "constant", "terms",
                                      "tau_star_s", "minimum", "imu_utils", "misfits", "curves"}));
  EXPECT_EQ(keys(json["signals"][0]["terms"]),
            (std::vector<std::string>{"white", "random_walk", "flicker", "quantization", "ramp"}));
}

TEST(AllanJson, AResolvedTermHasAValueAndNoBound) {
  const Json white = Json::parse(allan_json(synthetic_allan_result(), kContext))["signals"][0]["terms"]["white"];
  EXPECT_EQ(white["value"], 1.7e-4);
  EXPECT_EQ(white["low"], 1.7e-4 * (1.0 - 1.9 * 0.003));
  EXPECT_EQ(white["high"], 1.7e-4 * (1.0 + 2.5 * 0.003));
  EXPECT_EQ(white["low_68"], 1.7e-4 * (1.0 - 0.003));
  EXPECT_EQ(white["confidence"], 0.95);
  EXPECT_EQ(white["unit"], "rad/s/sqrt(Hz)");
  EXPECT_EQ(white["resolved"], true);
  EXPECT_TRUE(white["upper_bound"].is_null());
  EXPECT_NEAR(white["discrete_sigma"], 1.7e-4 * std::sqrt(200.0), 1e-15);
}

TEST(AllanJson, AnUnresolvedTermHasABoundAndNoValue) {
  const Json signal = Json::parse(allan_json(synthetic_allan_result(), kContext))["signals"][2];
  const Json& walk = signal["terms"]["random_walk"];
  for (const char* key : {"value", "low", "high", "low_68", "high_68", "discrete_sigma"}) {
    EXPECT_TRUE(walk.at(key).is_null()) << key;
  }
  EXPECT_EQ(walk["resolved"], false);
  EXPECT_EQ(walk["upper_bound"], 3.1e-6);
  EXPECT_EQ(walk["record_needed_s"], 50400.0);
  EXPECT_EQ(walk["unit"], "rad/s^2/sqrt(Hz)");
  EXPECT_TRUE(signal["tau_star_s"].is_null());
}

TEST(AllanJson, CurvesAreListsOfOneLength) {
  const Json signal = Json::parse(allan_json(synthetic_allan_result(), kContext))["signals"][4];
  const Json& curve = signal["curves"].at(0);
  EXPECT_EQ(curve["deviation"], "oadev");
  EXPECT_EQ(curve["confidence"], 0.683);
  EXPECT_EQ(curve["exact"], false);
  for (const char* key : {"tau_s", "value", "low", "high", "edf", "count"}) EXPECT_EQ(curve.at(key).size(), 90u) << key;
  EXPECT_EQ(curve["tau_s"][0], 0.005);
  EXPECT_EQ(curve["count"][0], 2159998);
  EXPECT_EQ(signal["misfits"].dump(), R"([{"low_hz":50.0,"high_hz":100.0,"ratio":1.8}])");
}

TEST(AllanJson, SummaryHasMeanAndWorstOfTheResolvedAxes) {
  const Json summary = Json::parse(allan_json(synthetic_allan_result(), kContext))["summary"];
  EXPECT_EQ(keys(summary), (std::vector<std::string>{"gyroscope", "accelerometer"}));
  const Json& white = summary["gyroscope"]["white"];
  EXPECT_NEAR(white["mean"], 1.8e-4, 1e-18);
  EXPECT_EQ(white["worst"], 1.9e-4);
  EXPECT_EQ(white["worst_axis"], "z");
  EXPECT_EQ(white["resolved"], true);
  const Json& walk = summary["gyroscope"]["random_walk"];
  EXPECT_NEAR(walk["mean"], 2.25e-6, 1e-18);
  EXPECT_EQ(walk["worst_axis"], "y");
  EXPECT_EQ(walk["resolved"], false);
  EXPECT_EQ(walk["resolved_axes"], 2);
  EXPECT_EQ(walk["upper_bound"], 3.1e-6);
  EXPECT_TRUE(summary["gyroscope"]["ramp"]["mean"].is_null());
}

/// Every number of an analysis that found nothing is null: a 0 would be read as "no noise".
TEST(AllanJson, WhatWasNotFoundIsNullNeverZero) {
  const Json signal = Json::parse(allan_json(odd_allan_result(), kContext))["signals"][0];
  EXPECT_EQ(signal["constant"], true);
  EXPECT_EQ(signal["mean"], 0.5);
  for (const auto& [name, term] : signal["terms"].items()) {
    for (const char* key : {"value", "low", "high", "upper_bound", "record_needed_s", "significance"}) {
      EXPECT_TRUE(term.at(key).is_null()) << name << " " << key;
    }
  }
  EXPECT_EQ(signal["minimum"].dump(), R"({"tau_s":null,"deviation":null})");
  EXPECT_EQ(signal["imu_utils"].dump(), R"({"n":null,"w":null,"w_tau_s":null})");
  EXPECT_EQ(signal["curves"].size(), 0u);
}

TEST(AllanJson, NumbersThatAreNotFiniteAreNull) {
  AllanResult result = synthetic_allan_result();
  result.signals[0].curves[0].high[3] = std::nan("");
  result.signals[0].terms[Term::kWhite].high_95 = HUGE_VAL;
  const Json signal = Json::parse(allan_json(result, kContext))["signals"][0];
  EXPECT_TRUE(signal["curves"][0]["high"][3].is_null());
  EXPECT_TRUE(signal["terms"]["white"]["high"].is_null());
}

TEST(AllanText, FitsATerminalAndNamesEveryQuantity) {
  const std::string text = allan_text(synthetic_allan_result());
  EXPECT_LE(lines(text).size(), 45u);
  for (const std::string& line : lines(text)) EXPECT_LE(line.size(), 132u) << line;
  for (const char* words :
       {"record  3 h (10800 s) at 200 Hz, 2160000 samples in 1 segment;", "1.70e-04 -0.57 +0.75 %", "< 3.10e-06",
        "gyroscope_noise_density", "gyroscope_random_walk", "accelerometer_noise_density", "accelerometer_random_walk",
        "2.25e-06 of x y", "2.55e-03  rad/s = N sqrt(rate)", "sigma at 200 Hz",
        "K of gyroscope z: not observable in this record, < 3.1e-06 rad/s^2/sqrt(Hz); a record of about 14 h would "
        "resolve it\n",
        "imu_utils would print gyr_n ", "not a random walk"}) {
    EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
  }
}

TEST(AllanText, QuantizationHasAColumnOnlyWhereItIsResolved) {
  const auto text = lines(allan_text(synthetic_allan_result()));
  const auto starting = [&](const std::string& word) {
    return *std::find_if(text.begin(), text.end(), [&](const std::string& line) { return line.starts_with(word); });
  };
  EXPECT_EQ(starting("gyroscope ").find("Q ["), std::string::npos);
  EXPECT_NE(starting("accelerometer ").find("Q [m/s]"), std::string::npos);
}

TEST(AllanText, AConstantAxisAndASeriesHaveNoInventedNumbers) {
  const std::string text = allan_text(odd_allan_result());
  EXPECT_NE(text.find("x          constant"), std::string::npos) << text;
  EXPECT_NE(text.find("series N"), std::string::npos) << text;
  EXPECT_NE(text.find("K of series: not observable in this record\n"), std::string::npos) << text;
  EXPECT_EQ(text.find("imu_utils"), std::string::npos) << text;
  EXPECT_EQ(text.find("0.00e+00"), std::string::npos) << text;
}

TEST(AllanCurveCsv, HasAColumnForEveryCurveAndUnitsInTheHeader) {
  const auto text = lines(allan_curve_csv(synthetic_allan_result()));
  ASSERT_EQ(text.size(), 91u);
  const auto header = cells(text[0]);
  ASSERT_EQ(header.size(), 31u);
  EXPECT_EQ(header[0], "tau_s");
  EXPECT_EQ(header[1], "gyroscope_x_oadev [rad/s]");
  EXPECT_EQ(header[4], "gyroscope_x_oadev_count");
  EXPECT_EQ(header[30], "accelerometer_z_oadev_fit [m/s^2]");
  const AllanResult result = synthetic_allan_result();
  for (std::size_t row = 1; row < text.size(); ++row) {
    const auto values = cells(text[row]);
    ASSERT_EQ(values.size(), header.size());
    EXPECT_EQ(std::stod(values[0]), result.signals[0].curves[0].tau_s[row - 1]);
    EXPECT_EQ(std::stod(values[28]), result.signals[5].curves[0].high[row - 1]);
    EXPECT_EQ(std::stod(values[30]), result.signals[5].terms.deviation(std::stod(values[0])));
  }
}

TEST(AllanCurveCsv, CurvesOfDifferentTausShareTheRowsTheyHave) {
  AllanResult result = empty_result(1.0, 8.0, 1);
  SignalAnalysis series = named_signal("series", "", "rad/s");
  const auto curve = [](Deviation kind, std::vector<double> tau_s) {
    AllanCurve c;
    c.deviation = kind;
    c.tau_s = tau_s;
    c.value = c.low = c.high = std::vector<double>(tau_s.size(), 0.5);
    c.count.assign(tau_s.size(), 7);
    return c;
  };
  series.curves = {curve(Deviation::kOadev, {1.0, 2.0}), curve(Deviation::kTdev, {2.0, 4.0})};
  series.curves[0].high[1] = std::nan("");
  result.signals = {series};
  EXPECT_EQ(allan_curve_csv(result),
            "tau_s,series_oadev [rad/s],series_oadev_low [rad/s],series_oadev_high [rad/s],series_oadev_count,"
            "series_oadev_fit [rad/s],series_tdev [rad],series_tdev_low [rad],series_tdev_high [rad],"
            "series_tdev_count\n"
            "1,0.5,0.5,0.5,7,,,,,\n"
            "2,0.5,0.5,,7,,0.5,0.5,0.5,7\n"
            "4,,,,,,0.5,0.5,0.5,7\n");
}

TEST(AllanKalibrYaml, WritesTheWorstAxisAndSaysWhatIsABound) {
  EXPECT_EQ(allan_kalibr_yaml(synthetic_allan_result()),
            "# m/s^2/sqrt(Hz), worst axis (z), mean 2.400e-03\n"
            "accelerometer_noise_density: 2.800e-03\n"
            "# m/s^3/sqrt(Hz), worst axis (y), mean 2.400e-05, not observable on x: 95 % bound 2.000e-05\n"
            "accelerometer_random_walk: 2.600e-05\n"
            "# rad/s/sqrt(Hz), worst axis (z), mean 1.800e-04\n"
            "gyroscope_noise_density: 1.900e-04\n"
            "# rad/s^2/sqrt(Hz), mean 2.250e-06, not observable on z: 95 % bound 3.100e-06\n"
            "gyroscope_random_walk: 3.100e-06\n"
            "update_rate: 200.0\n");
}

TEST(AllanKalibrYaml, InventsNoNumber) {
  AllanResult result = synthetic_allan_result();
  result.signals[2].terms[Term::kRandomWalk].upper_bound.reset();
  const std::string text = allan_kalibr_yaml(result);
  EXPECT_NE(text.find("\n# gyroscope_random_walk: not observable in this record, and no bound\n"), std::string::npos)
      << text;
  result.signals.erase(result.signals.begin(), result.signals.end());
  EXPECT_EQ(allan_kalibr_yaml(result), "");
}

}  // namespace
}  // namespace vispline
