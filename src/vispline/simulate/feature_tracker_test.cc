/// Laws of a front end: budget, distance, ids that live as long as a track and are shared by cameras.
#include "vispline/simulate/feature_tracker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "vispline/core/error.h"

namespace vispline {
namespace {

constexpr std::size_t kLandmarks = 400;

/// Landmarks that drift to the right at their own height, in an image of 640 x 480.
std::vector<VisibleLandmark> drifting(double frame) {
  const RandomStream places(3, "places");
  std::vector<VisibleLandmark> visible;
  for (std::size_t i = 0; i < kLandmarks; ++i) {
    const auto [u, v] = places.uniform_pair(i);
    const Vector2d px(1000.0 * u - 360.0 + 2.0 * frame, 480.0 * v);
    if (px.x() >= 0.0 && px.x() < 640.0) visible.push_back({i, 7000 + i, px});
  }
  return visible;
}

struct Followed {
  std::vector<std::vector<VisibleLandmark>> visible;
  std::vector<std::vector<TrackedLandmark>> tracked;
  const VisibleLandmark& of(std::size_t frame, const TrackedLandmark& t) const { return visible[frame][t.visible]; }
};

Followed follow(const TrackOptions& options, std::size_t frames = 120) {
  FeatureTracker tracker(options, 5, {"cam0"}, kLandmarks);
  Followed result;
  for (std::size_t k = 0; k < frames; ++k) {
    result.visible.push_back(drifting(static_cast<double>(k)));
    result.tracked.push_back(tracker.track(0, k, result.visible.back()));
  }
  return result;
}

TEST(FeatureTracker, BudgetAndDistanceHold) {
  const Followed result = follow({.max_features = 60, .min_distance_px = 30.0});
  for (std::size_t k = 0; k < result.tracked.size(); ++k) {
    const auto& tracked = result.tracked[k];
    EXPECT_LE(tracked.size(), 60U);
    EXPECT_GE(tracked.size(), 50U);
    for (std::size_t i = 0; i < tracked.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_GE((result.of(k, tracked[i]).px - result.of(k, tracked[j]).px).norm(), 30.0);
      }
    }
  }
}

TEST(FeatureTracker, AnIdIsOneLandmarkWithoutAGap) {
  const Followed result = follow({.max_features = 80, .min_distance_px = 15.0, .loss = 0.05});
  std::map<std::uint64_t, std::size_t> landmark, last;
  std::set<std::size_t> seen;
  std::size_t returned = 0;
  for (std::size_t k = 0; k < result.tracked.size(); ++k) {
    for (const TrackedLandmark& t : result.tracked[k]) {
      const std::size_t index = result.of(k, t).index;
      if (last.contains(t.id)) {
        EXPECT_EQ(landmark[t.id], index);
        EXPECT_EQ(last[t.id] + 1, k);
      } else {
        returned += !seen.insert(index).second;
      }
      landmark[t.id] = index;
      last[t.id] = k;
    }
  }
  EXPECT_GT(returned, 0U) << "a landmark that was lost comes back under a new id";
}

TEST(FeatureTracker, WithKeptIdsALandmarkHasOneId) {
  const Followed result = follow({.max_features = 80, .min_distance_px = 15.0, .loss = 0.05, .keep_ids = true});
  std::map<std::size_t, std::set<std::uint64_t>> ids;
  std::map<std::uint64_t, std::size_t> last;
  std::size_t returned = 0;
  for (std::size_t k = 0; k < result.tracked.size(); ++k) {
    for (const TrackedLandmark& t : result.tracked[k]) {
      ids[result.of(k, t).index].insert(t.id);
      returned += last.contains(t.id) && last[t.id] + 1 < k;
      last[t.id] = k;
    }
  }
  for (const auto& [index, own] : ids) EXPECT_EQ(own.size(), 1U) << "landmark " << index;
  EXPECT_EQ(last.size(), ids.size());
  EXPECT_GT(returned, 0U);
}

TEST(FeatureTracker, TracksEndAtTheRateThatIsAsked) {
  const double loss = 0.1;
  const Followed result = follow({.max_features = kLandmarks, .min_distance_px = 0.0, .loss = loss}, 200);
  std::size_t chances = 0, ends = 0;
  for (std::size_t k = 1; k < result.tracked.size(); ++k) {
    std::map<std::size_t, std::uint64_t> now;
    std::set<std::size_t> visible;
    for (const auto& v : result.visible[k]) visible.insert(v.index);
    for (const TrackedLandmark& t : result.tracked[k]) now[result.of(k, t).index] = t.id;
    for (const TrackedLandmark& t : result.tracked[k - 1]) {
      const std::size_t index = result.of(k - 1, t).index;
      if (!visible.contains(index)) continue;
      ++chances;
      ends += !now.contains(index) || now[index] != t.id;
    }
  }
  const double sigma = std::sqrt(loss * (1.0 - loss) / static_cast<double>(chances));
  EXPECT_NEAR(static_cast<double>(ends) / static_cast<double>(chances), loss, 5.0 * sigma);
}

TEST(FeatureTracker, NoTrackIsLongerThanAllowed) {
  const Followed result = follow({.max_features = 50, .loss = 0.0, .max_frames = 7});
  std::map<std::uint64_t, int> length;
  for (const auto& tracked : result.tracked) {
    for (const TrackedLandmark& t : tracked) EXPECT_LE(++length[t.id], 7);
  }
}

TEST(FeatureTracker, CamerasShareTheIdsOfWhatBothFollow) {
  FeatureTracker tracker({.max_features = 100, .min_distance_px = 0.0, .loss = 0.03}, 5, {"a", "b"}, kLandmarks);
  for (std::uint64_t k = 0; k < 40; ++k) {
    const auto left = drifting(static_cast<double>(k)), right = drifting(static_cast<double>(k) + 20.0);
    std::map<std::size_t, std::uint64_t> ids;
    for (const TrackedLandmark& t : tracker.track(0, k, left)) ids[left[t.visible].index] = t.id;
    std::size_t shared = 0;
    for (const TrackedLandmark& t : tracker.track(1, k, right)) {
      const auto found = ids.find(right[t.visible].index);
      if (found == ids.end()) continue;
      EXPECT_EQ(found->second, t.id);
      ++shared;
    }
    EXPECT_GT(shared, 20U);
  }
}

TEST(FeatureTracker, OfATargetEveryPointUnderItsOwnId) {
  FeatureTracker tracker({.is_target = true, .max_features = 3}, 5, {"cam0"}, kLandmarks);
  const auto visible = drifting(0.0);
  const auto tracked = tracker.track(0, 0, visible);
  ASSERT_EQ(tracked.size(), visible.size());
  for (const TrackedLandmark& t : tracked) EXPECT_EQ(t.id, visible[t.visible].id);
}

TEST(FeatureTracker, WhatCannotBe) {
  EXPECT_THROW(FeatureTracker({.loss = 1.5}, 0, {"a"}, 1), Error);
  EXPECT_THROW(FeatureTracker({.min_distance_px = -1.0}, 0, {"a"}, 1), Error);
}

}  // namespace
}  // namespace vispline
