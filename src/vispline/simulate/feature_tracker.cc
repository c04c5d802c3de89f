#include "vispline/simulate/feature_tracker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "vispline/core/error.h"
#include "vispline/simulate/pixel_grid.h"

namespace vispline {
namespace {

/// A landmark that may be followed: its place among the visible ones, and what decides who goes first.
struct Candidate {
  std::size_t visible = 0;
  std::uint64_t first_frame = 0;  ///< of a track
  double strength = 0.0;          ///< of a corner
};

std::vector<TrackedLandmark> all_of(std::span<const VisibleLandmark> visible) {
  std::vector<TrackedLandmark> tracked;
  for (std::size_t i = 0; i < visible.size(); ++i) tracked.push_back({i, visible[i].id});
  return tracked;
}

void sort_by_id(std::vector<TrackedLandmark>& tracked) { std::ranges::sort(tracked, {}, &TrackedLandmark::id); }

}  // namespace

void require_valid(const TrackOptions& options) {
  require(options.loss >= 0.0 && options.loss <= 1.0, "a probability from 0 to 1 that a track ends");
  require(std::isfinite(options.min_distance_px) && options.min_distance_px >= 0.0,
          "a distance between features that is finite and not negative");
}

FeatureTracker::FeatureTracker(const TrackOptions& options, std::uint64_t seed, std::vector<std::string> cameras,
                               std::size_t landmarks)
    : options_(options), landmarks_(landmarks), strength_(seed, "scene/strength"), tracks_(cameras.size()) {
  require_valid(options);
  for (const std::string& camera : cameras) loss_.emplace_back(seed, camera + "/loss");
}

bool FeatureTracker::survives(std::size_t camera, std::uint64_t frame, const Track& track, std::size_t index) const {
  if (options_.max_frames > 0 && frame - track.first_frame >= options_.max_frames) return false;
  return loss_[camera].uniform_pair(frame * landmarks_ + index)[0] > options_.loss;
}

std::uint64_t FeatureTracker::take(std::size_t index) {
  const auto [held, is_new] = held_.try_emplace(index);
  if (is_new) held->second.id = next_id_++;
  ++held->second.cameras;
  return held->second.id;
}

void FeatureTracker::release(std::size_t index) {
  const auto held = held_.find(index);
  if (--held->second.cameras == 0) held_.erase(held);
}

std::vector<TrackedLandmark> FeatureTracker::track(std::size_t camera, std::uint64_t frame,
                                                   std::span<const VisibleLandmark> visible) {
  if (options_.is_target) return all_of(visible);
  const Tracks before = std::exchange(tracks_[camera], {});
  std::vector<Candidate> old, fresh;
  for (std::size_t i = 0; i < visible.size(); ++i) {
    const std::size_t index = visible[i].index;
    const auto found = before.find(index);
    if (found == before.end()) {
      fresh.push_back({.visible = i, .strength = strength_.uniform_pair(index)[0]});
    } else if (survives(camera, frame, found->second, index)) {
      old.push_back({.visible = i, .first_frame = found->second.first_frame});
    }
  }
  std::ranges::stable_sort(old, {}, &Candidate::first_frame);
  std::ranges::stable_sort(fresh, std::ranges::greater{}, &Candidate::strength);

  PixelGrid grid(options_.min_distance_px);
  Tracks& now = tracks_[camera];
  std::vector<TrackedLandmark> tracked;
  for (const Candidate& candidate : old) {
    const VisibleLandmark& landmark = visible[candidate.visible];
    if (!grid.add(landmark.px)) continue;
    now[landmark.index] = before.at(landmark.index);
    tracked.push_back({candidate.visible, now[landmark.index].id});
  }
  for (const auto& [index, track] : before) {
    if (!now.contains(index)) release(index);
  }
  for (const Candidate& candidate : fresh) {
    if (tracked.size() >= options_.max_features) break;
    const VisibleLandmark& landmark = visible[candidate.visible];
    if (!grid.add(landmark.px)) continue;
    now[landmark.index] = {take(landmark.index), frame};
    tracked.push_back({candidate.visible, now[landmark.index].id});
  }
  sort_by_id(tracked);
  return tracked;
}

}  // namespace vispline
