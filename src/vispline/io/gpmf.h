/// GPMF, the telemetry of GoPro cameras: nested keys, lengths and values, big-endian, in steps of four bytes.
/// https://github.com/gopro/gpmf-parser, README.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vispline/bags/bytes.h"
#include "vispline/core/types.h"

namespace vispline::gpmf {

/// Four letters as the number that stands in the file.
constexpr std::uint32_t key_of(const char (&letters)[5]) {
  std::uint32_t key = 0;
  for (int i = 0; i < 4; ++i) key = (key << 8) | static_cast<unsigned char>(letters[i]);
  return key;
}

struct Klv {
  std::uint32_t key = 0;
  char type = 0;                     ///< 0: the value is a list of Klv
  std::size_t size = 0, repeat = 0;  ///< bytes of one sample, and how many there are
  Bytes value{};                     ///< size * repeat bytes
};

class KlvReader {
 public:
  explicit KlvReader(Bytes bytes) : rest_(bytes) {}
  /// False at the end, at a key of zeros (padding), and where a length leaves the bytes, see is_cut().
  bool next(Klv& klv);
  bool is_cut() const { return cut_; }

 private:
  Bytes rest_;
  bool cut_ = false;
};

/// How long the value behind the eight bytes of a key is, without padding; empty for fewer bytes and a key of zeros.
std::optional<std::uint64_t> bytes_of(Bytes head);

/// Number `index` of a value of type b B s S l L j J f d; empty for others and beyond the end.
std::optional<double> number(const Klv& klv, std::size_t index);
/// Bytes of one number of `type`; 0: it is none.
std::size_t width_of(char type);

/// The samples of one triad in one payload.
struct Triad {
  std::vector<Vector3d> samples{};          ///< rad/s or m/s^2, in the order of the channels
  std::optional<std::uint64_t> total{};     ///< TSMP: samples since the start of the recording, these included
  std::optional<std::uint64_t> stamp_us{};  ///< STMP: time of the first sample
  std::string input, output;                ///< ORIN, ORIO: what the channels are before and after `matrix`
  std::optional<Matrix3d> matrix{};         ///< MTRX
};

/// What is read of one DEVC.
struct Device {
  std::string name{};  ///< DVNM
  std::optional<Triad> gyro{}, accel{};
  std::optional<double> readout_s{};  ///< SROT
};

/// The devices of `bytes`. `cut`: a length leaves the bytes, or a triad is not of three numbers with a usable SCAL.
std::vector<Device> parse(Bytes bytes, bool& cut);

/// Rows map the channels of a file to X Y Z of the camera: "ZXY" says that channel 0 is Z; a small letter turns the
/// sign. Empty unless the letters are X, Y and Z, once each.
std::optional<Matrix3d> axes_from(const std::string& letters);

}  // namespace vispline::gpmf
