/// A simulated rig as recorded messages: rosbag v1, MCAP or rosbag2.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "vispline/bags/bag_writer.h"
#include "vispline/sensors/image.h"
#include "vispline/sensors/rig.h"
#include "vispline/simulate/imu_simulation.h"

namespace vispline::cli {

/// Topics /IMU, /CAMERA/image_raw (if images are rendered) and /ground_truth/pose, T_w_b at the samples of the first
/// IMU on the body's clock. Sensor after sensor: every container is read back by time.
class BagOutput {
 public:
  /// `name`: bag, mcap or rosbag2; written to FOLDER/recording.bag, recording.mcap or rosbag2.
  BagOutput(const std::string& name, const std::string& folder, const Rig& rig, bool images, bool force);
  /// Throws E-ARGUMENT for stamps that ROS cannot hold, such as negative ones.
  void write(std::size_t imu, const SimulatedImu& block);
  void write(std::size_t camera, Time stamp, const GreyImage& image);
  void publish() { writer_->publish(); }

 private:
  template <class Message>
  void send(std::size_t topic, const Message& message);

  Wire wire_;
  std::unique_ptr<BagWriter> writer_;
  std::vector<std::string> imu_names_, camera_names_;
  std::vector<std::size_t> imu_topics_, camera_topics_;
  std::size_t truth_topic_ = 0;
  std::string bytes_;
};

/// The name of the recording, for the proof that it can be written.
std::string bag_path(const std::string& name, const std::string& folder);

}  // namespace vispline::cli
