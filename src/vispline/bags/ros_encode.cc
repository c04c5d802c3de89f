#include "vispline/bags/ros_encode.h"

#include <algorithm>
#include <array>
#include <bit>

#include "vispline/bags/ros_definitions.h"

namespace vispline::ros {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

/// The fields of one message, one behind the other.
class Fields {
 public:
  Fields(std::string& out, Wire wire) : out_(out), cdr_(wire == Wire::kCdr) {
    out_.clear();
    if (cdr_) out_.append("\0\1\0\0", 4);
  }
  bool is_cdr() const { return cdr_; }

  template <std::unsigned_integral T>
  void number(T value) {
    while (cdr_ && (out_.size() - 4) % sizeof(T) != 0) out_ += '\0';
    store_le(out_, value);
  }
  void number(double value) { number(std::bit_cast<std::uint64_t>(value)); }
  template <std::size_t n>
  void numbers(const double (&values)[n]) {
    for (const double value : values) number(value);
  }
  void text(std::string_view value) {
    number(static_cast<std::uint32_t>(value.size() + (cdr_ ? 1 : 0)));
    out_ += value;
    if (cdr_) out_ += '\0';
  }
  void blob(Bytes bytes) {
    number(static_cast<std::uint32_t>(bytes.size()));
    out_ += as_text(bytes);
  }

 private:
  std::string& out_;
  bool cdr_;
};

void write(Fields& out, const Header& header) {
  if (!out.is_cdr()) out.number(std::uint32_t{0});  // seq
  out.number(static_cast<std::uint32_t>(header.stamp_ns / kSecond));
  out.number(static_cast<std::uint32_t>(header.stamp_ns % kSecond));
  out.text(header.frame_id);
}

void write(Fields& out, const Vector3& v) {
  for (const double value : {v.x, v.y, v.z}) out.number(value);
}

void write(Fields& out, const Pose& pose) {
  write(out, pose.position);
  const Quaternion& q = pose.orientation;
  for (const double value : {q.x, q.y, q.z, q.w}) out.number(value);
}

void write(Fields& out, const Imu& imu) {
  write(out, imu.header);
  const Quaternion& q = imu.orientation;
  for (const double value : {q.x, q.y, q.z, q.w}) out.number(value);
  out.numbers(imu.orientation_covariance);
  write(out, imu.angular_velocity);
  out.numbers(imu.angular_velocity_covariance);
  write(out, imu.linear_acceleration);
  out.numbers(imu.linear_acceleration_covariance);
}

void write(Fields& out, const PoseStamped& message) {
  write(out, message.header);
  write(out, message.pose);
}

void write(Fields& out, const PoseWithCovarianceStamped& message) {
  write(out, message.header);
  write(out, message.pose);
  out.numbers(message.covariance);
}

void write(Fields& out, const TransformStamped& message) {
  write(out, message.header);
  out.text(message.child_frame_id);
  write(out, message.transform);
}

void write(Fields& out, const PointStamped& message) {
  write(out, message.header);
  write(out, message.point);
}

void write(Fields& out, const Odometry& message) {
  write(out, message.header);
  out.text(message.child_frame_id);
  write(out, message.pose);
  out.numbers(message.pose_covariance);
  write(out, message.linear);
  write(out, message.angular);
  out.numbers(message.twist_covariance);
}

void write(Fields& out, const Image& image) {
  write(out, image.header);
  out.number(image.height);
  out.number(image.width);
  out.text(image.encoding);
  out.number(static_cast<std::uint8_t>(image.big_endian));
  out.number(image.step);
  out.blob(image.pixels);
}

void write(Fields& out, const CompressedImage& image) {
  write(out, image.header);
  out.text(image.format);
  out.blob(image.bytes);
}

template <class T>
bool transcode_as(Bytes data, Wire from, Wire to, std::string& out) {
  const auto message = decode<T>(data, from);
  if (!message || !message->header.stamp_valid || !stamp_fits(message->header.stamp_ns, to)) return false;
  encode(*message, to, out);
  return true;
}

struct Transcoder {
  std::string_view type;
  bool (*run)(Bytes, Wire, Wire, std::string&);
};

constexpr std::array kTranscoders = {
    Transcoder{"sensor_msgs/Imu", transcode_as<Imu>},
    Transcoder{"geometry_msgs/PoseStamped", transcode_as<PoseStamped>},
    Transcoder{"geometry_msgs/PoseWithCovarianceStamped", transcode_as<PoseWithCovarianceStamped>},
    Transcoder{"geometry_msgs/TransformStamped", transcode_as<TransformStamped>},
    Transcoder{"geometry_msgs/PointStamped", transcode_as<PointStamped>},
    Transcoder{"nav_msgs/Odometry", transcode_as<Odometry>},
    Transcoder{"sensor_msgs/Image", transcode_as<Image>},
    Transcoder{"sensor_msgs/CompressedImage", transcode_as<CompressedImage>},
};

const Transcoder* transcoder_of(std::string_view type) {
  const auto found = std::ranges::find(kTranscoders, plain_type(type), &Transcoder::type);
  return found == kTranscoders.end() ? nullptr : &*found;
}

}  // namespace

template <class T>
void encode(const T& message, Wire wire, std::string& out) {
  Fields fields(out, wire);
  write(fields, message);
}

template void encode(const Imu&, Wire, std::string&);
template void encode(const PoseStamped&, Wire, std::string&);
template void encode(const PoseWithCovarianceStamped&, Wire, std::string&);
template void encode(const TransformStamped&, Wire, std::string&);
template void encode(const PointStamped&, Wire, std::string&);
template void encode(const Odometry&, Wire, std::string&);
template void encode(const Image&, Wire, std::string&);
template void encode(const CompressedImage&, Wire, std::string&);

bool stamp_fits(std::int64_t stamp_ns, Wire wire) {
  const std::int64_t seconds = stamp_ns / kSecond;
  return stamp_ns >= 0 && seconds <= (wire == Wire::kCdr ? INT32_MAX : std::int64_t{UINT32_MAX});
}

Topic make_topic(std::string name, std::string_view type, Wire wire) {
  const bool cdr = wire == Wire::kCdr;
  const std::size_t slash = type.find('/');
  return {
      .name = std::move(name),
      .type = cdr ? std::string(type.substr(0, slash)) + "/msg" + std::string(type.substr(slash)) : std::string(type),
      .md5 = cdr ? "" : known_md5(type),
      .definition = definition_of(type, wire),
      .wire = wire,
      .encoding = cdr ? "cdr" : "ros1"};
}

bool transcode(std::string_view type, Bytes data, Wire from, Wire to, std::string& out) {
  const Transcoder* transcoder = transcoder_of(type);
  return transcoder != nullptr && transcoder->run(data, from, to, out);
}

bool can_transcode(std::string_view type) { return transcoder_of(type) != nullptr; }

}  // namespace vispline::ros
