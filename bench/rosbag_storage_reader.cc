// Reads every sensor_msgs/Imu of a rosbag with ROS's own library and prints their number: the other side of
// read_bags.py. usage: rosbag_storage_reader FILE
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/Imu.h>

#include <iostream>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  rosbag::Bag bag(argv[1], rosbag::bagmode::Read);
  long count = 0;
  double sum = 0.0;
  for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TypeQuery("sensor_msgs/Imu"))) {
    const auto imu = message.instantiate<sensor_msgs::Imu>();
    sum += imu->angular_velocity.x;
    ++count;
  }
  std::cout << count << ' ' << sum << '\n';
  return count > 0 ? 0 : 1;
}
