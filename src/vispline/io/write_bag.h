/// Signals to recordings of messages: sensor_msgs/Imu and geometry_msgs/PoseStamped, received when they were stamped.
/// docs/formats.md, Conversions.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>

#include "vispline/bags/bag_writer.h"
#include "vispline/core/pose.h"
#include "vispline/core/signal.h"
#include "vispline/sensors/recording.h"

namespace vispline {

class SignalBagWriter {
 public:
  /// Messages of ROS 1 in a rosbag, else of ROS 2. Throws as make_bag_writer does.
  SignalBagWriter(Container container, const std::string& path, const BagWriterOptions& options = {});

  /// Throws E-TIME-RANGE (exit 4) for a stamp that the messages cannot hold: negative, or beyond 2106 (ROS 1) or 2038.
  /// What is not measured (nan in all of a triad) is zero with a covariance of -1.
  void write_imu(const std::string& topic, std::span<const Time> time, std::span<const ImuSample> samples);
  void write_poses(const std::string& topic, const Signal<Pose>& T_w_b);
  void publish() { writer_->publish(); }

 private:
  std::size_t topic_number(const std::string& topic, const char* type);
  std::int64_t stamp(Time time) const;

  std::unique_ptr<BagWriter> writer_;
  Wire wire_;
  std::map<std::string, std::size_t> numbers_;
  std::string bytes_;
};

}  // namespace vispline
