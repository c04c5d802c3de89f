#include "vispline/bags/ros_messages.h"

#include "vispline/bags/ros_definitions.h"

namespace vispline::ros {
namespace {

constexpr std::size_t kMaxPadding = 3;

void read(RosFields& in, Header& header) {
  if (!in.is_cdr()) in.u32();  // seq
  const std::int64_t seconds = in.is_cdr() ? std::int64_t{in.i32()} : std::int64_t{in.u32()};
  const std::int64_t nanoseconds = in.u32();
  header.stamp_ns = seconds * 1'000'000'000 + nanoseconds;
  header.stamp_valid = seconds >= 0 && nanoseconds < 1'000'000'000;
  header.frame_id = in.text();
}

void read(RosFields& in, Vector3& v) {
  v.x = in.f64();
  v.y = in.f64();
  v.z = in.f64();
}

void read(RosFields& in, Quaternion& q) {
  q.x = in.f64();
  q.y = in.f64();
  q.z = in.f64();
  q.w = in.f64();
}

void read(RosFields& in, Pose& pose) {
  read(in, pose.position);
  read(in, pose.orientation);
}

void read(RosFields& in, Imu& imu) {
  read(in, imu.header);
  read(in, imu.orientation);
  in.f64(imu.orientation_covariance);
  read(in, imu.angular_velocity);
  in.f64(imu.angular_velocity_covariance);
  read(in, imu.linear_acceleration);
  in.f64(imu.linear_acceleration_covariance);
}

void read(RosFields& in, PoseStamped& message) {
  read(in, message.header);
  read(in, message.pose);
}

void read(RosFields& in, PoseWithCovarianceStamped& message) {
  read(in, message.header);
  read(in, message.pose);
  in.f64(message.covariance);
}

void read(RosFields& in, TransformStamped& message) {
  read(in, message.header);
  message.child_frame_id = in.text();
  read(in, message.transform);
}

void read(RosFields& in, PointStamped& message) {
  read(in, message.header);
  read(in, message.point);
}

void read(RosFields& in, Odometry& message) {
  read(in, message.header);
  message.child_frame_id = in.text();
  read(in, message.pose);
  in.f64(message.pose_covariance);
  read(in, message.linear);
  read(in, message.angular);
  in.f64(message.twist_covariance);
}

void read(RosFields& in, Image& image) {
  read(in, image.header);
  image.height = in.u32();
  image.width = in.u32();
  image.encoding = in.text();
  image.big_endian = in.u8() != 0;
  image.step = in.u32();
  image.pixels = in.blob();
  if (std::uint64_t{image.step} * image.height > image.pixels.size()) in.fail();
}

void read(RosFields& in, CompressedImage& image) {
  read(in, image.header);
  image.format = in.text();
  image.bytes = in.blob();
}

void read(RosFields& in, CameraInfo& info) {
  read(in, info.header);
  info.height = in.u32();
  info.width = in.u32();
  info.distortion_model = in.text();
}

}  // namespace

template <class T>
std::optional<T> decode(Bytes data, Wire wire) {
  RosFields in(data, wire);
  T message;
  read(in, message);
  if (!in.good()) return std::nullopt;
  const bool whole = !std::is_same_v<T, CameraInfo>;
  if (whole && in.rest() > (in.is_cdr() ? kMaxPadding : 0)) return std::nullopt;
  return message;
}

template std::optional<Imu> decode<Imu>(Bytes, Wire);
template std::optional<PoseStamped> decode<PoseStamped>(Bytes, Wire);
template std::optional<PoseWithCovarianceStamped> decode<PoseWithCovarianceStamped>(Bytes, Wire);
template std::optional<TransformStamped> decode<TransformStamped>(Bytes, Wire);
template std::optional<PointStamped> decode<PointStamped>(Bytes, Wire);
template std::optional<Odometry> decode<Odometry>(Bytes, Wire);
template std::optional<Image> decode<Image>(Bytes, Wire);
template std::optional<CompressedImage> decode<CompressedImage>(Bytes, Wire);
template std::optional<CameraInfo> decode<CameraInfo>(Bytes, Wire);

std::string plain_type(std::string_view type) {
  std::string plain(type);
  if (const std::size_t at = plain.find("/msg/"); at != std::string::npos) plain.erase(at, 4);
  return plain;
}

Match match(const Topic& topic, std::string_view type) {
  if (plain_type(topic.type) != plain_type(type) || topic.wire == Wire::kOther) return Match::kOtherType;
  if (topic.wire == Wire::kCdr || topic.md5.empty() || topic.md5 == "*") return Match::kSame;
  const std::string known = known_md5(plain_type(type));
  if (known.empty()) return Match::kOtherType;
  return topic.md5 == known ? Match::kSame : Match::kOtherDefinition;
}

}  // namespace vispline::ros
