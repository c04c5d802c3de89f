#include "vispline/bags/bag_writer.h"

#include "vispline/bags/mcap_writer.h"
#include "vispline/bags/rosbag2_writer.h"
#include "vispline/bags/rosbag_writer.h"

namespace vispline {

std::unique_ptr<BagWriter> make_bag_writer(Container container, const std::string& path,
                                           const BagWriterOptions& options) {
  if (container == Container::kMcap) return make_mcap_writer(path, options);
  if (container == Container::kRosbag2) return make_rosbag2_writer(path, options);
  return make_rosbag_writer(path, options);
}

}  // namespace vispline
