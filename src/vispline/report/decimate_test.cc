#include "vispline/report/decimate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <utility>

namespace vispline::report {
namespace {

std::vector<Point> noise(int n, double width, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal(150.0, 30.0);
  std::vector<Point> points;
  for (int i = 0; i < n; ++i) points.push_back({width * i / n, normal(generator)});
  return points;
}

std::map<int, std::pair<double, double>> extremes(const std::vector<Point>& points) {
  std::map<int, std::pair<double, double>> columns;
  for (const Point p : points) {
    const auto [it, fresh] = columns.try_emplace(static_cast<int>(std::floor(p.x)), p.y, p.y);
    it->second = {std::min(it->second.first, p.y), std::max(it->second.second, p.y)};
  }
  return columns;
}

bool is_subsequence(const std::vector<Point>& part, const std::vector<Point>& whole) {
  auto at = whole.begin();
  for (const Point p : part) {
    at = std::find(at, whole.end(), p);
    if (at == whole.end()) return false;
    ++at;
  }
  return true;
}

TEST(DecimateColumns, KeepsLowestAndHighestOfEveryColumn) {
  const auto points = noise(100000, 700.0, 11);
  const auto thin = decimate_columns(points);
  EXPECT_LE(thin.size(), 4U * 700U);
  EXPECT_EQ(extremes(thin), extremes(points));
  EXPECT_TRUE(is_subsequence(thin, points));
  EXPECT_EQ(thin.front(), points.front());
  EXPECT_EQ(thin.back(), points.back());
}

TEST(DecimateColumns, ASpikeStays) {
  auto points = noise(100000, 700.0, 12);
  points[54321].y = 999.0;
  const auto thin = decimate_columns(points);
  EXPECT_NE(std::find(thin.begin(), thin.end(), points[54321]), thin.end());
}

TEST(DecimateColumns, ShortCurvesAreUnchanged) {
  EXPECT_TRUE(decimate_columns({}).empty());
  const std::vector<Point> points{{0.0, 5.0}, {0.2, 9.0}, {0.4, 1.0}, {0.9, 5.0}, {7.0, 3.0}, {3.0, 3.0}};
  EXPECT_EQ(decimate_columns(points), points);
}

std::vector<Point> circles(int n) {
  std::vector<Point> points;
  for (int i = 0; i < n; ++i)
    points.push_back({200.0 + 150.0 * std::cos(0.01 * i), 200.0 + 150.0 * std::sin(0.01 * i)});
  return points;
}

TEST(DecimateInked, GoingRoundAgainCostsNothing) {
  std::size_t once = 0;
  std::size_t often = 0;
  for (const auto& piece : decimate_inked(circles(5000))) once += piece.size();
  const auto pieces = decimate_inked(circles(500000));
  for (const auto& piece : pieces) {
    often += piece.size();
    EXPECT_GE(piece.size(), 2U);
  }
  EXPECT_GE(once, 600U);  // the circumference is 942 px
  EXPECT_LE(often, 4 * once);
}

TEST(DecimateInked, EveryInkedCellStaysInked) {
  const auto points = circles(500000);
  const auto cells = [](const std::vector<Point>& some) {
    std::set<std::pair<int, int>> out;
    for (const Point p : some) out.insert({static_cast<int>(p.x / 2.0), static_cast<int>(p.y / 2.0)});
    return out;
  };
  std::vector<Point> kept;
  for (const auto& piece : decimate_inked(points)) kept.insert(kept.end(), piece.begin(), piece.end());
  EXPECT_EQ(cells(kept), cells(points));
}

TEST(DecimatePixels, OnePointAPixel) {
  const std::vector<Point> points{{1.1, 1.1}, {1.9, 1.9}, {2.1, 1.9}, {-0.5, 1.0}, {1.5, 1.5}};
  EXPECT_EQ(decimate_pixels(points), (std::vector<Point>{{1.1, 1.1}, {2.1, 1.9}, {-0.5, 1.0}}));
}

}  // namespace
}  // namespace vispline::report
