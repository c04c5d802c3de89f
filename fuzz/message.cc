#include "check_bag.h"
#include "vispline/bags/ros_messages.h"

namespace {

using namespace vispline;

void inside(std::string_view view, Bytes whole) {
  const std::string_view all = as_text(whole);
  fuzz::must(view.empty() || (view.data() >= all.data() && view.data() + view.size() <= all.data() + all.size()));
}

template <class T>
void check(Bytes data, Wire wire) {
  const auto message = ros::decode<T>(data, wire);
  if (!message) return;
  inside(message->header.frame_id, data);
  if constexpr (requires { message->child_frame_id; }) inside(message->child_frame_id, data);
  if constexpr (requires { message->encoding; }) inside(message->encoding, data);
  if constexpr (requires { message->pixels; }) inside(as_text(message->pixels), data);
  if constexpr (requires { message->bytes; }) inside(as_text(message->bytes), data);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const Wire wire = data[0] % 2 == 0 ? Wire::kRos1 : Wire::kCdr;
  const std::vector<std::uint8_t> copy(data + 1, data + size);  // of its own, so that a read too far is seen
  const Bytes bytes = std::as_bytes(std::span(copy));
  check<ros::Imu>(bytes, wire);
  check<ros::PoseStamped>(bytes, wire);
  check<ros::PoseWithCovarianceStamped>(bytes, wire);
  check<ros::TransformStamped>(bytes, wire);
  check<ros::PointStamped>(bytes, wire);
  check<ros::Odometry>(bytes, wire);
  check<ros::Image>(bytes, wire);
  check<ros::CompressedImage>(bytes, wire);
  check<ros::CameraInfo>(bytes, wire);
  return 0;
}
