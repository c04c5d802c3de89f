#include "vispline/calibration/target_file.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace vispline {
namespace {

TargetCalibration aprilgrid() { return {.cols = 6, .rows = 5, .tag_size_m = 0.088, .tag_spacing = 0.3}; }

void expect_same(const TargetCalibration& a, const TargetCalibration& b) {
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.cols, b.cols);
  EXPECT_EQ(a.rows, b.rows);
  EXPECT_EQ(a.tag_size_m, b.tag_size_m);
  EXPECT_EQ(a.tag_spacing, b.tag_spacing);
  EXPECT_EQ(a.col_spacing_m, b.col_spacing_m);
  EXPECT_EQ(a.row_spacing_m, b.row_spacing_m);
  EXPECT_EQ(a.is_asymmetric, b.is_asymmetric);
}

TEST(TargetFile, ReadsBack) {
  const TargetCalibration board{
      .kind = TargetKind::kCheckerboard, .cols = 7, .rows = 6, .col_spacing_m = 0.06, .row_spacing_m = 0.05};
  const TargetCalibration circles{.kind = TargetKind::kCirclegrid,
                                  .cols = 4,
                                  .rows = 11,
                                  .col_spacing_m = 0.02,
                                  .row_spacing_m = 0.02,
                                  .is_asymmetric = true};
  for (const TargetCalibration& target : {aprilgrid(), board, circles}) {
    const TargetReading read = parse_target("f", target_file("kalibr", target).text);
    expect_same(read.target, target);
    EXPECT_TRUE(read.diagnostics.empty());
  }
  expect_same(parse_target("f", target_file("basalt", aprilgrid()).text).target, aprilgrid());
  EXPECT_THROW(target_file("basalt", board), Error);
  EXPECT_THROW(target_file("openvins", board), Error);
  EXPECT_THROW(target_file("kalibr", {}), Error);
}

TEST(TargetFile, RefusesImpossibleBoards) {
  const std::string text = target_file("kalibr", aprilgrid()).text;
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    return changed.replace(changed.find(from), from.size(), to);
  };
  EXPECT_THROW(parse_target("f", with("tagCols: 6", "tagCols: 0")), Error);
  EXPECT_THROW(parse_target("f", with("tagCols: 6", "tagCols: 6.5")), Error);
  EXPECT_THROW(parse_target("f", with("tagSize", "tagsize")), Error);
  EXPECT_THROW(parse_target("f", with("aprilgrid", "aprilboard")), Error);
  EXPECT_THROW(
      parse_target(
          "f", "target_type: circlegrid\ntargetCols: 3\ntargetRows: 3\nspacingMeters: 0.1\nasymmetricGrid: maybe\n"),
      Error);
}

TEST(TargetFile, RecordedFile) {
  const std::string path = std::string(VISPLINE_SOURCE_DIR) + "/../shared/data/kalibr_files/basalt_aprilgrid_6x6.json";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no recorded data at hand";
  const TargetCalibration target = read_target_file(path).target;
  EXPECT_EQ(target.rows, 6);
  EXPECT_EQ(target.tag_size_m, 0.088);
}

}  // namespace
}  // namespace vispline
