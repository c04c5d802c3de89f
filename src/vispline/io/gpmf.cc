#include "vispline/io/gpmf.h"

#include <bit>
#include <cctype>
#include <cmath>

namespace vispline::gpmf {
namespace {

constexpr int kMaxNesting = 4;  // DEVC, STRM and two to spare

std::uint64_t load_be(const std::byte* at, std::size_t width) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < width; ++i) value = (value << 8) | static_cast<std::uint64_t>(at[i]);
  return value;
}

std::string text_of(const Klv& klv) {
  std::string text(as_text(klv.value));
  return text.substr(0, text.find('\0'));
}

std::optional<std::uint64_t> count_of(const Klv& klv) {
  const std::size_t width = width_of(klv.type);
  if ((klv.type != 'L' && klv.type != 'J') || klv.value.size() < width) return std::nullopt;
  return load_be(klv.value.data(), width);
}

/// The divisor of each channel; false: there is none to use.
bool scale_of(const Klv& scal, Vector3d& divisor) {
  if (scal.key == 0) return true;
  const std::size_t width = width_of(scal.type);
  const bool each = width > 0 && scal.value.size() / width >= 3;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto value = number(scal, each ? i : 0);
    if (!value || *value == 0.0 || !std::isfinite(*value)) return false;
    divisor[static_cast<Eigen::Index>(i)] = *value;
  }
  return true;
}

bool read_samples(const Klv& klv, const Klv& scal, Triad& triad) {
  Vector3d divisor = Vector3d::Ones();
  const std::size_t width = width_of(klv.type);
  if (width == 0 || klv.size != 3 * width || !scale_of(scal, divisor)) return false;
  triad.samples.reserve(klv.repeat);
  for (std::size_t i = 0; i < klv.repeat; ++i) {
    const Vector3d raw(*number(klv, 3 * i), *number(klv, 3 * i + 1), *number(klv, 3 * i + 2));
    triad.samples.emplace_back(raw.cwiseQuotient(divisor));
  }
  return true;
}

std::optional<Matrix3d> matrix_of(const Klv& klv) {
  Matrix3d matrix;
  for (int i = 0; i < 9; ++i) {
    const auto value = number(klv, static_cast<std::size_t>(i));
    if (!value || !std::isfinite(*value)) return std::nullopt;
    matrix(i / 3, i % 3) = *value;
  }
  return matrix;
}

/// One STRM: what stands before the samples tells what they are.
bool read_stream(Bytes bytes, Device& device) {
  Triad triad;
  Klv klv, scal;
  KlvReader reader(bytes);
  bool good = true;
  while (reader.next(klv)) {
    switch (klv.key) {
      case key_of("TSMP"):
        triad.total = count_of(klv);
        break;
      case key_of("STMP"):
        triad.stamp_us = count_of(klv);
        break;
      case key_of("SCAL"):
        scal = klv;
        break;
      case key_of("ORIN"):
        triad.input = text_of(klv);
        break;
      case key_of("ORIO"):
        triad.output = text_of(klv);
        break;
      case key_of("MTRX"):
        triad.matrix = matrix_of(klv);
        break;
      case key_of("SROT"):
        device.readout_s = number(klv, 0).value_or(0.0) * 1e-3;
        break;
      case key_of("GYRO"):
      case key_of("ACCL"): {
        auto& place = klv.key == key_of("GYRO") ? device.gyro : device.accel;
        const bool read = !place && read_samples(klv, scal, triad);
        if (read) place = triad;
        good = good && (read || place);
        break;
      }
      default:
        break;
    }
  }
  return good && !reader.is_cut();
}

bool read_device(Bytes bytes, Device& device, int nesting) {
  Klv klv;
  KlvReader reader(bytes);
  bool good = true;
  while (reader.next(klv)) {
    if (klv.key == key_of("DVNM")) device.name = text_of(klv);
    if (klv.key == key_of("SROT")) device.readout_s = number(klv, 0).value_or(0.0) * 1e-3;
    if (klv.key == key_of("STRM") && klv.type == 0) good = read_stream(klv.value, device) && good;
    if (klv.key == key_of("DEVC") && klv.type == 0 && nesting < kMaxNesting) {
      good = read_device(klv.value, device, nesting + 1) && good;
    }
  }
  return good && !reader.is_cut();
}

}  // namespace

bool KlvReader::next(Klv& klv) {
  if (rest_.size() < 8) {
    cut_ = cut_ || !rest_.empty();
    return false;
  }
  klv.key = static_cast<std::uint32_t>(load_be(rest_.data(), 4));
  if (klv.key == 0) return false;
  klv.type = static_cast<char>(rest_[4]);
  klv.size = static_cast<std::size_t>(rest_[5]);
  klv.repeat = static_cast<std::size_t>(load_be(rest_.data() + 6, 2));
  const std::size_t length = klv.size * klv.repeat;
  rest_ = rest_.subspan(8);
  if (length > rest_.size()) {
    cut_ = true;
    return false;
  }
  klv.value = rest_.first(length);
  rest_ = rest_.subspan(std::min(rest_.size(), (length + 3) / 4 * 4));
  return true;
}

std::optional<std::uint64_t> bytes_of(Bytes head) {
  if (head.size() < 8 || load_be(head.data(), 4) == 0) return std::nullopt;
  return load_be(head.data() + 5, 1) * load_be(head.data() + 6, 2);
}

std::size_t width_of(char type) {
  switch (type) {
    case 'b':
    case 'B':
      return 1;
    case 's':
    case 'S':
      return 2;
    case 'l':
    case 'L':
    case 'f':
      return 4;
    case 'j':
    case 'J':
    case 'd':
      return 8;
    default:
      return 0;
  }
}

std::optional<double> number(const Klv& klv, std::size_t index) {
  const std::size_t width = width_of(klv.type);
  if (width == 0 || index >= klv.value.size() / width) return std::nullopt;
  const std::uint64_t bits = load_be(klv.value.data() + index * width, width);
  switch (klv.type) {
    case 'b':
      return static_cast<std::int8_t>(bits);
    case 's':
      return static_cast<std::int16_t>(bits);
    case 'l':
      return static_cast<std::int32_t>(bits);
    case 'j':
      return static_cast<double>(static_cast<std::int64_t>(bits));
    case 'f':
      return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    case 'd':
      return std::bit_cast<double>(bits);
    default:
      return static_cast<double>(bits);
  }
}

std::vector<Device> parse(Bytes bytes, bool& cut) {
  std::vector<Device> devices;
  Klv klv;
  KlvReader reader(bytes);
  while (reader.next(klv)) {
    if (klv.key != key_of("DEVC") || klv.type != 0) continue;
    Device device;
    cut = !read_device(klv.value, device, 0) || cut;
    devices.push_back(std::move(device));
  }
  cut = cut || reader.is_cut();
  return devices;
}

std::optional<Matrix3d> axes_from(const std::string& letters) {
  if (letters.size() != 3) return std::nullopt;
  Matrix3d axes = Matrix3d::Zero();
  for (int channel = 0; channel < 3; ++channel) {
    const char letter = letters[static_cast<std::size_t>(channel)];
    const char upper = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
    if (upper < 'X' || upper > 'Z') return std::nullopt;
    axes(upper - 'X', channel) = letter == upper ? 1.0 : -1.0;
  }
  for (int row = 0; row < 3; ++row) {
    if (axes.row(row).cwiseAbs().sum() != 1.0) return std::nullopt;
  }
  return axes;
}

}  // namespace vispline::gpmf
