/// Small recordings of devices, made here: GPMF, MP4 and ULog bytes.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "vispline/bags/bytes.h"
#include "vispline/core/types.h"
#include "vispline/io/imu_screen.h"

namespace vispline::recorders_testing {

/// Samples are counted only.
inline const auto kNoSink = [](std::span<const Time>, std::span<const ImuSample>) {};

inline std::string be(std::uint64_t value, int bytes) {
  std::string out;
  for (int i = bytes - 1; i >= 0; --i) out += static_cast<char>(static_cast<unsigned char>(value >> (8 * i)));
  return out;
}

/// One key with `repeat` samples of `size` bytes, padded to four.
inline std::string klv(const std::string& key, char type, std::size_t size, std::size_t repeat, std::string value) {
  value.resize((value.size() + 3) / 4 * 4);
  return key + std::string(1, type) + be(size, 1) + be(repeat, 2) + value;
}
inline std::string nest(const std::string& key, const std::string& inside) {
  return klv(key, '\0', 4, inside.size() / 4, inside);
}
inline std::string text_klv(const std::string& key, const std::string& text) {
  return klv(key, 'c', 1, text.size(), text);
}
inline std::string float_klv(const std::string& key, const std::vector<float>& values) {
  std::string bytes;
  for (const float value : values) bytes += be(std::bit_cast<std::uint32_t>(value), 4);
  return klv(key, 'f', 4 * values.size(), 1, bytes);
}

/// What stands before the samples of a stream.
struct StreamHead {
  std::string text{};  ///< ready bytes: STMP, TSMP, ORIN, ...
  int scale = 100;
};

/// Samples as 16-bit integers, channel values times the scale.
inline std::string stream(const std::string& key, const StreamHead& head, const std::vector<Vector3d>& channels) {
  std::string bytes;
  for (const Vector3d& sample : channels) {
    for (int i = 0; i < 3; ++i) bytes += be(static_cast<std::uint64_t>(std::llround(sample[i] * head.scale)), 2);
  }
  return nest("STRM", head.text + klv("SCAL", 's', 2, 1, be(static_cast<std::uint64_t>(head.scale), 2)) +
                          klv(key, 's', 6, channels.size(), bytes));
}

inline std::string box(const std::string& key, const std::string& content) {
  return be(content.size() + 8, 4) + key + content;
}

/// An MP4 with one telemetry track, each payload a chunk of `ticks` thousandths of a second.
inline std::string mp4(const std::vector<std::string>& payloads, const std::vector<std::uint32_t>& ticks,
                       const std::string& settings) {
  const std::string ftyp = box("ftyp", "mp41" + std::string(4, '\0'));
  std::string media, sizes, offsets, times;
  for (std::size_t i = 0; i < payloads.size(); ++i) {
    sizes += be(payloads[i].size(), 4);
    offsets += be(ftyp.size() + 8 + media.size(), 4);
    times += be(1, 4) + be(ticks[i], 4);
    media += payloads[i];
  }
  const std::string count = be(payloads.size(), 4), zero(4, '\0');
  const std::string table = box("stsd", zero + be(1, 4) + be(20, 4) + "gpmd" + std::string(8, '\0')) +
                            box("stts", zero + count + times) +
                            box("stsc", zero + be(1, 4) + be(1, 4) + be(1, 4) + be(1, 4)) +
                            box("stsz", zero + zero + count + sizes) + box("stco", zero + count + offsets);
  const std::string track =
      box("trak", box("mdia", box("mdhd", std::string(12, '\0') + be(1000, 4) + std::string(8, '\0')) +
                                  box("minf", box("stbl", table))));
  return ftyp + box("mdat", media) + box("moov", box("udta", box("GPMF", settings)) + track);
}

/// A ULog under construction.
struct UlogBytes {
  std::string bytes = std::string("ULog\x01\x12\x35\x01", 8) + std::string(8, '\0');

  void message(char type, const std::string& body) {
    store_le(bytes, static_cast<std::uint16_t>(body.size()));
    bytes += type + body;
  }
  void format(const std::string& text) { message('F', text); }
  void subscribe(int id, const std::string& name, int instance = 0) {
    std::string body(1, static_cast<char>(instance));
    store_le(body, static_cast<std::uint16_t>(id));
    message('A', body + name);
  }
  void data(int id, const std::string& fields) {
    std::string body;
    store_le(body, static_cast<std::uint16_t>(id));
    message('D', body + fields);
  }
};

inline std::string u64(std::uint64_t value) {
  std::string out;
  store_le(out, value);
  return out;
}
inline std::string u32(std::uint32_t value) {
  std::string out;
  store_le(out, value);
  return out;
}
inline std::string floats(const Vector3d& value) {
  std::string out;
  for (int i = 0; i < 3; ++i) store_le(out, std::bit_cast<std::uint32_t>(static_cast<float>(value[i])));
  return out;
}

/// 20 samples at 250 Hz from 1 s; the accelerometer is 1 ms behind each.
inline std::string combined_ulog(int samples = 20) {
  UlogBytes log;
  log.format(
      "sensor_combined:uint64_t timestamp;float[3] gyro_rad;uint32_t gyro_integral_dt;"
      "int32_t accelerometer_timestamp_relative;float[3] accelerometer_m_s2;uint8_t accelerometer_clipping;");
  log.subscribe(7, "sensor_combined");
  for (int i = 0; i < samples; ++i) {
    const double t = 0.004 * i;
    log.data(7, u64(1'000'000 + 4000 * static_cast<std::uint64_t>(i)) + floats({0.5, -t, 2 * t}) + u32(4000) +
                    u32(static_cast<std::uint32_t>(-1000)) + floats({t, 1.0 + t, -9.75}) + std::string(1, '\0'));
  }
  return log.bytes;
}

/// Two payloads of 20 samples, HERO5 order Z X Y turned: channels X -Z Y; clock of 1/200.5 s from 0.25 s.
inline std::string small_gopro_payload(int number, bool stamps) {
  constexpr int kSamples = 20;
  std::vector<Vector3d> gyro, accel;
  for (int i = 0; i < kSamples; ++i) {
    const int k = number * kSamples + i;
    gyro.emplace_back(0.01 * k, -0.02 * k, 0.5);
    accel.emplace_back(1.0, -9.81, 0.03 * k);
  }
  StreamHead head;
  const auto stamp = static_cast<std::uint64_t>(std::llround(250000.0 + 1e6 / 200.5 * number * kSamples));
  if (stamps) head.text += klv("STMP", 'J', 8, 1, be(stamp, 8));
  head.text += klv("TSMP", 'L', 4, 1, be(static_cast<std::uint64_t>((number + 1) * kSamples), 4));
  head.text += text_klv("ORIN", "XzY") + text_klv("ORIO", "ZXY");
  head.text += float_klv("MTRX", {0, -1, 0, 1, 0, 0, 0, 0, 1});
  return nest("DEVC", klv("DVID", 'L', 4, 1, be(1, 4)) + text_klv("DVNM", "GoPro Test") + stream("ACCL", head, accel) +
                          stream("GYRO", head, gyro));
}

inline std::string small_gopro_mp4(bool stamps = true, int payloads = 3) {
  std::vector<std::string> parts;
  for (int i = 0; i < payloads; ++i) parts.push_back(small_gopro_payload(i, stamps));
  return mp4(parts, std::vector<std::uint32_t>(parts.size(), 100),
             nest("DEVC", text_klv("DVNM", "Global Settings") + float_klv("SROT", {20.6f})));
}

}  // namespace vispline::recorders_testing
