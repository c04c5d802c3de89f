#include "vispline/calibration/config_map.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vispline {
namespace {

const char* const kText =
    "imu0:\n"
    "  rate: 200\n"
    "  gyroscope_noise_densty: 1.5e-4\n"
    "  text: abc\n"
    "  quoted: \"1\"\n"
    "  nothing: ~\n"
    "  nan: .nan\n"
    "  zero: 0.0\n"
    "  half: 2.5\n"
    "  row: [1, 2.5, -3]\n"
    "  bad_row: [1, x]\n"
    "  square: [[1, 2], [3, 4]]\n"
    "  flat: [1, 2, 3, 4]\n"
    "  ragged: [[1, 2], [3]]\n"
    "  list: [{a: 1}, {a: 2}]\n";

class Config : public ::testing::Test {
 protected:
  template <class Get>
  std::string failure_of(const Get& get) {
    try {
      get();
    } catch (const Error& error) {
      EXPECT_EQ(error.exit_code(), ExitCode::kUsage);
      EXPECT_EQ(error.diagnostic().code, "E-CONFIG");
      return error.diagnostic().where + " " + error.diagnostic().message +
             (error.diagnostic().next.empty() ? "" : "; " + error.diagnostic().next);
    }
    return "";
  }
  Diagnostics diagnostics_;
  YamlFile file_ = parse_yaml("f", kText);
  ConfigMap root_{file_, file_.root, "", diagnostics_};
  ConfigMap imu_ = root_.map("imu0");
};

TEST_F(Config, ValuesOfEachKind) {
  EXPECT_EQ(imu_.positive("rate", "Hz"), 200.0);
  EXPECT_EQ(imu_.integer("rate", "", 1, 1000), 200);
  EXPECT_EQ(imu_.number("zero", ""), 0.0);
  EXPECT_EQ(imu_.text("text"), "abc");
  EXPECT_EQ(imu_.text("quoted"), "1");
  EXPECT_EQ(imu_.text_or("absent", "x"), "x");
  EXPECT_FALSE(imu_.number_if("absent", "").has_value());
  EXPECT_EQ(imu_.numbers("row", 3, ""), (std::vector<double>{1, 2.5, -3}));
  EXPECT_EQ(imu_.numbers("row", 0, "").size(), 3u);
  EXPECT_EQ(imu_.matrix("square", 2, 2, ""), (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(imu_.matrix("flat", 2, 2, ""), (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(imu_.maps("list").at(1).integer("a", "", 0, 9), 2);
}

TEST_F(Config, OpencvMatricesKeepTheirShape) {
  const YamlFile file =
      parse_yaml("f", "%YAML:1.0\nT: !!opencv-matrix\n  rows: 1\n  cols: 2\n  dt: d\n  data: [1., 2.]\n");
  ConfigMap root(file, file.root, "", diagnostics_);
  EXPECT_EQ(root.matrix("T", 1, 2, "m"), (std::vector<double>{1, 2}));
  EXPECT_EQ(failure_of([&] { root.matrix("T", 2, 1, "m"); }), "f:2:4 T is a map, expected a matrix of 2 x 1");
}

TEST_F(Config, WrongValuesNameKeyPlaceAndUnit) {
  EXPECT_EQ(failure_of([&] { imu_.positive("text", "Hz"); }), "f:4:9 imu0.text is 'abc', expected a number in Hz");
  EXPECT_EQ(failure_of([&] { imu_.number("quoted", ""); }), "f:5:11 imu0.quoted is '1' in quotes, expected a number");
  EXPECT_EQ(failure_of([&] { imu_.number("nothing", "s"); }), "f:6:3 imu0.nothing is nothing, expected a number in s");
  EXPECT_EQ(failure_of([&] { imu_.number("nan", "s"); }), "f:7:8 imu0.nan is '.nan', expected a number in s");
  EXPECT_EQ(failure_of([&] { imu_.positive("zero", "m"); }),
            "f:8:9 imu0.zero is '0.0', expected a positive number in m");
  EXPECT_EQ(failure_of([&] { imu_.integer("half", "", 1, 9); }),
            "f:9:9 imu0.half is '2.5', expected a whole number from 1 to 9");
  EXPECT_EQ(failure_of([&] { imu_.numbers("row", 4, "px"); }),
            "f:10:8 imu0.row is a list of 3, expected a list of 4 numbers in px");
  EXPECT_EQ(failure_of([&] { imu_.numbers("bad_row", 2, ""); }), "f:11:16 imu0.bad_row is 'x', expected a number");
  EXPECT_EQ(failure_of([&] { imu_.matrix("ragged", 2, 2, ""); }),
            "f:14:20 imu0.ragged is a list of 1, expected rows of 2 x 2");
  EXPECT_EQ(failure_of([&] { imu_.map("text"); }), "f:4:9 imu0.text is 'abc', expected keys with values");
  EXPECT_EQ(failure_of([&] { imu_.number("square", ""); }), "f:12:11 imu0.square is a list of 2, expected a number");
}

TEST_F(Config, AMissingKeyPointsAtItsMisspelling) {
  EXPECT_EQ(failure_of([&] { imu_.positive("gyroscope_noise_density", "rad/s/sqrt(Hz)"); }),
            "f:2:3 key imu0.gyroscope_noise_density (rad/s/sqrt(Hz)) is missing; line 3 has "
            "'gyroscope_noise_densty': if it is meant, rename it");
  EXPECT_EQ(failure_of([&] { imu_.positive("update_frequency", "Hz"); }),
            "f:2:3 key imu0.update_frequency (Hz) is missing");
}

TEST_F(Config, OptionalValuesAndNan) {
  EXPECT_FALSE(imu_.positive_or_warn("walk", "m/s").has_value());
  EXPECT_EQ(diagnostics_.examples().at(0).message, "imu0.walk (m/s) is missing");
  EXPECT_EQ(imu_.positive_or_warn("half", "m/s"), 2.5);
  EXPECT_NE(failure_of([&] { imu_.positive_or_warn("quotd", "m/s"); }).find("line 5 has 'quoted'"), std::string::npos);
  EXPECT_TRUE(std::isnan(imu_.number_or_nan("nan", "")));
  EXPECT_EQ(imu_.number_or_nan("half", ""), 2.5);
  EXPECT_NE(failure_of([&] { imu_.number_or_nan("text", ""); }), "");
}

TEST_F(Config, UnknownKeysAreWarnings) {
  imu_.accept("text");
  imu_.number("rate", "");
  imu_.warn_unknown();
  EXPECT_EQ(diagnostics_.counts().at("W-CONFIG"), 12);
  EXPECT_EQ(diagnostics_.examples().front().message, "unknown key 'imu0.gyroscope_noise_densty'");
  EXPECT_EQ(diagnostics_.examples().front().where, "f:3:3");
}

}  // namespace
}  // namespace vispline
