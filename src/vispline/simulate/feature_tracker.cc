#include "vispline/simulate/feature_tracker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "vispline/core/error.h"
#include "vispline/simulate/pixel_grid.h"

namespace vispline {
namespace {

std::vector<TrackedLandmark> all_of(std::span<const VisibleLandmark> visible) {
  std::vector<TrackedLandmark> tracked;
  for (std::size_t i = 0; i < visible.size(); ++i) tracked.push_back({i, visible[i].id});
  return tracked;
}

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

std::uint64_t FeatureTracker::id_of(std::size_t index) {
  if (!options_.keep_ids) return next_id_++;
  const auto [known, is_new] = id_.try_emplace(index, next_id_);
  if (is_new) ++next_id_;
  return known->second;
}

std::uint64_t FeatureTracker::take(std::size_t index) {
  const auto [held, is_new] = held_.try_emplace(index);
  if (is_new) held->second.id = id_of(index);
  ++held->second.cameras;
  return held->second.id;
}

void FeatureTracker::release(std::size_t index) {
  const auto held = held_.find(index);
  if (--held->second.cameras == 0) held_.erase(held);
}

FeatureTracker::Candidates FeatureTracker::candidates(std::size_t camera, std::uint64_t frame,
                                                      std::span<const VisibleLandmark> visible) const {
  Candidates found;
  for (std::size_t i = 0; i < visible.size(); ++i) {
    const std::size_t index = visible[i].index;
    const auto track = tracks_[camera].find(index);
    if (track == tracks_[camera].end()) {
      found.fresh.push_back({.visible = i, .strength = strength_.uniform_pair(index)[0]});
    } else if (survives(camera, frame, track->second, index)) {
      found.old.push_back({.visible = i, .first_frame = track->second.first_frame});
    }
  }
  std::ranges::stable_sort(found.old, {}, &Candidate::first_frame);
  std::ranges::stable_sort(found.fresh, std::ranges::greater{}, &Candidate::strength);
  return found;
}

std::vector<TrackedLandmark> FeatureTracker::track(std::size_t camera, std::uint64_t frame,
                                                   std::span<const VisibleLandmark> visible) {
  if (options_.is_target) return all_of(visible);
  const Candidates found = candidates(camera, frame, visible);
  const Tracks before = std::exchange(tracks_[camera], {});
  Tracks& now = tracks_[camera];
  PixelGrid grid(options_.min_distance_px);
  std::vector<TrackedLandmark> tracked;
  const auto follow = [&](const Candidate& candidate, const Track& track) {
    now[visible[candidate.visible].index] = track;
    tracked.push_back({candidate.visible, track.id});
  };
  for (const Candidate& old : found.old) {
    const VisibleLandmark& landmark = visible[old.visible];
    if (grid.add(landmark.px)) follow(old, before.at(landmark.index));
  }
  for (const auto& [index, track] : before) {
    if (!now.contains(index)) release(index);
  }
  for (const Candidate& fresh : found.fresh) {
    if (tracked.size() >= options_.max_features) break;
    const VisibleLandmark& landmark = visible[fresh.visible];
    if (grid.add(landmark.px)) follow(fresh, {take(landmark.index), frame});
  }
  std::ranges::sort(tracked, {}, &TrackedLandmark::id);
  return tracked;
}

}  // namespace vispline
