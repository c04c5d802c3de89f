// Reads every sensor_msgs/Imu of a recording, in the order of the file, and prints their number: what read_bags.py
// compares with readers that do no more. usage: bag_reader FILE
#include <iostream>

#include "vispline/bags/open_bag.h"
#include "vispline/bags/ros_messages.h"

int main(int argc, char** argv) {
  using namespace vispline;
  if (argc != 2) return 2;
  const auto reader = open_bag(argv[1]);
  std::int64_t count = 0;
  double sum = 0.0;
  reader->read([](const Topic& topic) { return topic.type.ends_with("/Imu"); },
               [&](const Message& message) {
                 const auto imu = ros::decode<ros::Imu>(message.data, reader->topics()[message.topic].wire);
                 if (!imu) return true;
                 sum += imu->angular_velocity.x;
                 ++count;
                 return true;
               });
  std::cout << count << ' ' << sum << '\n';
  return count > 0 ? 0 : 1;
}
