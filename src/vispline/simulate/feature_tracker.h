/// Which of the visible landmarks a front end follows, and under which id. docs/math/features.md, Tracks.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "vispline/core/random.h"
#include "vispline/core/types.h"

namespace vispline {

struct TrackOptions {
  /// A detector of a known target finds all points that it sees, under the ids of the scene. The other members are for
  /// tracks only.
  bool is_target = false;
  std::size_t max_features = 150;  ///< in an image
  double min_distance_px = 20.0;   ///< between two features of an image; of two that are nearer the younger one ends
  double loss = 0.02;              ///< probability that a track ends before the next image, though still in sight
  std::size_t max_frames = 0;      ///< a track ends after so many images; 0: never
  bool keep_ids = false;           ///< a landmark that comes back is recognised: its track goes on under the old id
};

/// A landmark in sight, by its place in the scene; the id is its own.
struct VisibleLandmark {
  std::size_t index = 0;
  std::uint64_t id = 0;
  Vector2d px = Vector2d::Zero();
};

/// What is followed: a place among the visible ones, and the id of the track.
struct TrackedLandmark {
  std::size_t visible = 0;
  std::uint64_t id = 0;
};

/// Follows landmarks from image to image of each camera. A track that ended comes back under a new id unless ids are
/// kept; a landmark that
/// another camera follows at the moment is taken up under the same id. Deterministic: strength of corners and losses
/// are functions of (seed, camera, image, landmark).
class FeatureTracker {
 public:
  /// `landmarks`: how many the scene has.
  FeatureTracker(const TrackOptions& options, std::uint64_t seed, std::vector<std::string> cameras,
                 std::size_t landmarks);

  /// The next image of a camera, `frame` counting its images; `visible` in the order of the indices. The result is in
  /// the order of the ids.
  std::vector<TrackedLandmark> track(std::size_t camera, std::uint64_t frame, std::span<const VisibleLandmark> visible);

 private:
  struct Track {
    std::uint64_t id = 0;
    std::uint64_t first_frame = 0;
  };
  struct Shared {
    std::uint64_t id = 0;
    int cameras = 0;  ///< that follow the landmark
  };
  /// A landmark that may be followed: its place among the visible ones, and what decides who goes first.
  struct Candidate {
    std::size_t visible = 0;
    std::uint64_t first_frame = 0;  ///< of a track
    double strength = 0.0;          ///< of a corner
  };
  struct Candidates {
    std::vector<Candidate> old;    ///< tracks that go on, the oldest first
    std::vector<Candidate> fresh;  ///< not followed yet, the strongest first
  };
  using Tracks = std::map<std::size_t, Track>;  ///< by the index of the landmark

  Candidates candidates(std::size_t camera, std::uint64_t frame, std::span<const VisibleLandmark> visible) const;
  bool survives(std::size_t camera, std::uint64_t frame, const Track& track, std::size_t index) const;
  std::uint64_t id_of(std::size_t index);
  std::uint64_t take(std::size_t index);
  void release(std::size_t index);

  TrackOptions options_;
  std::size_t landmarks_;
  RandomStream strength_;
  std::vector<RandomStream> loss_;      ///< by camera
  std::vector<Tracks> tracks_;          ///< by camera
  std::map<std::size_t, Shared> held_;  ///< by the index of the landmark
  std::map<std::size_t, std::uint64_t> id_;  ///< of every landmark that was ever followed, if ids are kept
  std::uint64_t next_id_ = 0;
};

/// Throws E-ARGUMENT for probabilities outside 0 to 1 and distances that are negative or not finite.
void require_valid(const TrackOptions& options);

}  // namespace vispline
