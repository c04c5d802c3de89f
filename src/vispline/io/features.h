/// Features of cameras and points of targets, from text files. docs/formats.md, Features.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "vispline/core/types.h"
#include "vispline/io/read_options.h"
#include "vispline/io/read_result.h"
#include "vispline/sensors/recording.h"

namespace vispline {

/// Points by their id: landmarks in w, or the points of a target in t; m.
using PointMap = std::map<std::uint64_t, Vector3d>;

/// A table of tracks, one row an observation: `timestamp,id,u,v`. Rows that are not in the order of time are sorted
/// (W-ORDER); the second observation of an id in one frame (W-DUPLICATE) and pixels that are not finite (W-NONFINITE,
/// up to 1 %) are left out. counts.kept is the number of observations. Of `options`: time_unit, decimal,
/// skip_bad_rows, repair, strict.
ReadResult<FeatureSignal> read_tracks(const std::string& path, const ReadOptions& options = {});

/// A table of the corners of a target, one row an image: `t,u0,v0,u1,v1,...`; the id is the place in the row, and
/// -1,-1 (or nan,nan) is a corner that was not seen. counts.kept is the number of images. Stamps are screened as those
/// of an IMU.
ReadResult<FeatureSignal> read_corner_table(const std::string& path, const ReadOptions& options = {});

/// Either of them: four columns are tracks, an odd number are corners. Throws E-COLUMNS for another number.
ReadResult<FeatureSignal> read_features(const std::string& path, const ReadOptions& options = {});

/// `id,x,y,z`. An id that comes twice is E-DUPLICATE.
ReadResult<PointMap> read_points(const std::string& path, const ReadOptions& options = {});

}  // namespace vispline
