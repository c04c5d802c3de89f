#include "vispline/report/calibration_section.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "vispline/core/error.h"
#include "vispline/report/markup_testing.h"
#include "vispline/results/calibration_result_testing.h"

namespace vispline::report {
namespace {

CalibrationCourse circle_course() {
  CalibrationCourse course;
  for (int i = 0; i < 50; ++i) {
    const double t = 0.1 * i;
    const Vector3d p(std::cos(t), std::sin(t), 0.1 * t);
    course.T_w_b.push_back(Time{} + from_seconds(t), {Matrix3d::Identity(), p});
    course.truth_T_w_b.push_back(Time{} + from_seconds(t), {Matrix3d::Identity(), p + Vector3d(0.001, 0.0, 0.0)});
  }
  return course;
}

std::string page(const CalibrationResult& result) {
  return calibration_page(result, circle_course(), "Calibration of phone", {"0.1.0", 7, "vispline calibrate"});
}

TEST(CalibrationSection, SaysWhatMatters) {
  const std::string text = page(vispline::testing::calibration_result());
  for (const char* expected : {"Class: converged-weak", "is not observable: sigma 0.041 m", "not observable",
                               "turn faster about x and z", "53.5 ± 0.29", "cam0.T_c_i.rotation x",
                               "What to record next", "passed", "From above", "NEES", "jack-knife", "W-CURVATURE"}) {
    EXPECT_NE(text.find(expected), std::string::npos) << expected;
  }
  EXPECT_EQ(text.find(">90.0<"), std::string::npos) << "a value that is not observable must not be shown";
}

TEST(CalibrationSection, WellFormedWithoutScript) {
  const MarkupReader read(page(vispline::testing::calibration_result()));
  for (const auto& e : read.elements) EXPECT_NE(e.name, "script");
}

TEST(CalibrationSection, AnEmptyResultIsAPage) {
  const std::string text = calibration_page({}, {}, "nothing", {});
  EXPECT_NE(text.find("Class: failed"), std::string::npos);
}

TEST(HeatMap, SkipsWhatIsNoNumberAndRefusesWhatDoesNotFit) {
  HeatMap map{.title = "m", .row_labels = {"a", "b"}, .values = {{1.0, -0.5}, {std::nan(""), 1.0}}};
  const std::string svg = render_svg(map);
  EXPECT_NE(svg.find("a · b: -0.500"), std::string::npos) << svg;
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  map.row_labels.pop_back();
  EXPECT_THROW(render_svg(map), Error);
  map.row_labels.clear();
  map.values[0].pop_back();
  EXPECT_THROW(render_svg(map), Error);
}

}  // namespace
}  // namespace vispline::report
