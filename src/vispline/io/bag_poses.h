/// Poses of a recording of messages. docs/formats.md, Recordings.
#pragma once

#include "vispline/io/pose_rows.h"

namespace vispline {

/// Of the recording of `context`, whose noun is "poses": topics of PoseStamped, PoseWithCovarianceStamped,
/// TransformStamped and Odometry; the pose of the body in the frame of the header. Throws as BagReader, choose_topic
/// and StampScreen do.
PoseRows load_bag_poses(ReadContext& context);

}  // namespace vispline
