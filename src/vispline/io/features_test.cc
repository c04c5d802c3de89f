/// Tracks, corner tables and points: read(write(x)) = x, counts, and what is refused where.
#include "vispline/io/features.h"

#include "vispline/io/feature_writers.h"
#include "vispline/io/io_testing.h"

namespace vispline {
namespace {

std::string data(const std::string& name) { return std::string(VISPLINE_SOURCE_DIR) + "/../shared/data/" + name; }

FeatureSignal random_features(std::size_t frames, std::size_t points, std::uint64_t seed) {
  Numbers numbers(seed);
  FeatureSignal signal;
  for (std::size_t k = 0; k < frames; ++k) {
    std::vector<Feature> features;
    for (std::uint64_t id = 0; id < points; ++id) {
      if (numbers.normal() > 0.5 || (id == 0 && k % 3 == 0))
        features.push_back({id, {320.0 + 100.0 * numbers.normal(), 240.0 + 80.0 * numbers.normal()}});
    }
    signal.push_back(time_from_ns(1520527958463478001 + 33'333'337 * static_cast<std::int64_t>(k)), features);
  }
  return signal;
}

void expect_same(const FeatureSignal& a, const FeatureSignal& b) {
  ASSERT_EQ(a.time, b.time);
  for (std::size_t k = 0; k < a.size(); ++k) {
    ASSERT_EQ(a.value[k].size(), b.value[k].size());
    for (std::size_t i = 0; i < a.value[k].size(); ++i) {
      EXPECT_EQ(a.value[k][i].id, b.value[k][i].id);
      EXPECT_EQ(a.value[k][i].px, b.value[k][i].px);
    }
  }
}

std::int64_t observations(const FeatureSignal& signal) {
  std::size_t count = 0;
  for (const auto& frame : signal.value) count += frame.size();
  return static_cast<std::int64_t>(count);
}

template <class Reader>
std::string code_of(const Reader& reader) {
  try {
    reader();
  } catch (const Error& error) {
    const std::string& where = error.diagnostic().where;
    return error.diagnostic().code + " " + where.substr(where.rfind('/') + 1);
  }
  return "";
}

TEST(Features, TracksReadBack) {
  const ScratchFolder folder;
  FeatureSignal features = random_features(60, 40, 3);
  for (auto& frame : features.value) {
    if (frame.empty()) frame.push_back({77, {1.5, 2.5}});
  }
  for (const char* name : {"tracks.csv", "tracks.csv.xz"}) {
    write_tracks(folder.path(name), features);
    const auto read = read_features(folder.path(name));
    EXPECT_EQ(read.format, "tracks");
    EXPECT_TRUE(read.diagnostics.empty());
    EXPECT_EQ(read.counts.read, observations(features));
    EXPECT_EQ(read.counts.kept, observations(features));
    expect_same(read.value, features);
  }
}

TEST(Features, CornersReadBack) {
  const ScratchFolder folder;
  const FeatureSignal features = random_features(60, 144, 4);
  CornerTableWriter writer(folder.path("corners.csv"), 144);
  for (std::size_t k = 0; k < features.size(); ++k) writer.write(features.time[k], features.value[k]);
  writer.publish();
  const auto read = read_features(folder.path("corners.csv"));
  EXPECT_EQ(read.format, "corners");
  EXPECT_EQ(read.counts.read, 60);
  EXPECT_EQ(read.counts.kept, 60);
  expect_same(read.value, features);
}

TEST(Features, PointsReadBack) {
  const ScratchFolder folder;
  const PointMap points = {{0, {0.1, -2.5, 3e-7}}, {12, {1.0 / 3.0, 0.0, 4.0}}, {9007199254740992, {1, 2, 3}}};
  write_points(folder.path("points.csv"), points);
  EXPECT_EQ(read_points(folder.path("points.csv")).value, points);
}

TEST(Features, TracksKeepTheirAccount) {
  const ScratchFolder folder;
  const std::string path = folder.write("t.csv",
                                        "#timestamp [ns],id,u [px],v [px]\n"
                                        "200000000,1,10.5,20\n200000000,2,11,21\n100000000,1,10,20\n"
                                        "200000000,1,99,99\n300000000,2,12,22\n");
  const auto read = read_tracks(path);
  EXPECT_EQ(read.counts.read, 5);
  EXPECT_EQ(read.counts.kept, 4);
  EXPECT_EQ(read.counts.dropped.at("W-DUPLICATE"), 1);
  EXPECT_EQ(read.diagnostics.counts().at("W-ORDER"), 1);
  ASSERT_EQ(read.value.size(), 3U);
  EXPECT_EQ(read.value.value[1].size(), 2U);
  EXPECT_EQ(read.value.value[1][0].px, Vector2d(10.5, 20));
}

TEST(Features, StampsAreExact) {
  const ScratchFolder folder;
  const std::string seconds = "1520527958.463478001,0,1,2\n1520527958.513478999,0,1,2\n";
  const auto read = read_tracks(folder.write("t.csv", seconds));
  EXPECT_EQ(to_ns(read.value.time[0]), 1520527958463478001);
  EXPECT_EQ(to_ns(read.value.time[1]), 1520527958513478999);
}

TEST(Features, WhatIsRefused) {
  const ScratchFolder folder;
  const auto tracks = [&](const std::string& text) {
    return code_of([&] { read_tracks(folder.write("t.csv", text)); });
  };
  EXPECT_EQ(tracks("0.1,0,1,2\n0.2,0.5,1,2\n0.3,0,1,2\n"), "E-CSV t.csv:2");
  EXPECT_EQ(tracks("0.1,0,1,2\n0.2,-1,1,2\n0.3,0,1,2\n"), "E-CSV t.csv:2");
  EXPECT_EQ(tracks("0.1,0,1,2\n0.2,0,x,2\n0.3,0,1,2\n"), "E-CSV t.csv:2");
  EXPECT_EQ(tracks("0.1,0,1,2\n0.2,0,nan,2\n0.3,0,1,2\n"), "E-NONFINITE t.csv:2");
  EXPECT_EQ(tracks("0.1,0,1\n0.2,0,1\n"), "E-COLUMNS t.csv:1");
  EXPECT_EQ(tracks(""), "E-EMPTY t.csv");
  const auto corners = [&](const std::string& text) {
    return code_of([&] { read_corner_table(folder.write("c.csv", text)); });
  };
  EXPECT_EQ(corners("0.1,1,2,3,4\n0.2,1,2,3,x\n0.3,1,2,3,4\n"), "E-CSV c.csv:2");
  EXPECT_EQ(corners("0.1,1,2,3,4\n0.2,1,nan,3,4\n0.3,1,2,3,4\n"), "E-CSV c.csv:2");
  EXPECT_EQ(corners("0.1,1,2,3,4\n0.2,1,2,3\n0.3,1,2,3,4\n"), "E-CSV c.csv:2");
  EXPECT_EQ(corners("0.1,1,2,3\n0.2,1,2,3\n"), "E-COLUMNS c.csv:1");
  const auto points = [&](const std::string& text) {
    return code_of([&] { read_points(folder.write("p.csv", text)); });
  };
  EXPECT_EQ(points("0,1,2,3\n0,1,2,4\n"), "E-DUPLICATE p.csv:2");
  EXPECT_EQ(points("0,1,2,3\n1,1,,4\n"), "E-NONFINITE p.csv:2");
}

TEST(Features, ACutLastImageIsLeftOut) {
  const ScratchFolder folder;
  const auto read = read_corner_table(folder.write("c.csv", "0.1,1.25,2.25\n0.2,1.25,2.25\n0.3,1.2"));
  EXPECT_EQ(read.counts.read, 3);
  EXPECT_EQ(read.counts.kept, 2);
  EXPECT_EQ(read.counts.dropped.at("W-TRUNCATED"), 1);
}

TEST(Features, RecordedCorners) {
  if (!std::filesystem::exists(data("README.md"))) GTEST_SKIP() << "no recorded data at hand";
  const std::string folder = "noncommercial/tumvi_calib_imu1_first31s/";
  const auto corners = read_features(data(folder + "corners2D_cam0.csv.xz"));
  EXPECT_EQ(corners.format, "corners");
  EXPECT_EQ(corners.counts.read, 620);
  EXPECT_EQ(corners.counts.kept, 620);
  EXPECT_TRUE(corners.diagnostics.empty());
  EXPECT_EQ(to_ns(corners.value.time[0]), 1520527958463478000);
  EXPECT_EQ(corners.value.value[0][1].px, Vector2d(206.3746796, 387.1936951));
  EXPECT_EQ(observations(corners.value), 620 * 144 - 4222 / 2);
  const auto points = read_points(data(folder + "corners3D.csv"));
  EXPECT_EQ(points.value.size(), 144U);
  EXPECT_EQ(points.value.at(2), Vector3d(0.088, 0.088, 0.0));
}

}  // namespace
}  // namespace vispline
