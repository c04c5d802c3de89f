/// What the numbers of an imu_utils file mean. The tool fits sigma^2(tau) = N^2/tau + B^2 + K^2 tau + ... to the Allan
/// deviation and prints two figures per axis:
///   n   standard deviation of one sample, N sqrt(rate). Its first versions printed N itself.
///   w   minimum of the fitted curve, often taken for the random walk K, which it is not.
/// Without flicker noise the minimum is w = sqrt(2 N K / sqrt 3) at tau* = sqrt(3) N / K, hence K = sqrt(3) w^2 / (2
/// N); with flicker noise K is smaller. docs/calibration-files.md.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "vispline/calibration/noise_files.h"
#include "vispline/core/error.h"

namespace vispline {

/// Where tau* lies in the record, whose Allan deviation ends at half of its length and is vague beyond a tenth.
enum class TauStarPlace { kUnknown, kInside, kVague, kOutside };

/// One way to read n. Units: u is rad/s or m/s^2.
struct ImuUtilsReading {
  double white = 0.0;            ///< N, u/sqrt(Hz)
  std::optional<double> walk{};  ///< K, u/s/sqrt(Hz), an upper bound if there is flicker noise
  std::optional<double> tau_star_s{};
  TauStarPlace place = TauStarPlace::kUnknown;  ///< kUnknown without a record length or without K
};

struct ImuUtilsAxisMeaning {
  std::string axis{};                         ///< "avg", "x", "y", "z"
  ImuUtilsFigure figure{};                    ///< as the file says; NaN is kept
  bool is_saturated = false;                  ///< w is where the search for the minimum began: nothing follows from it
  std::optional<ImuUtilsReading> as_sigma{};  ///< n is N sqrt(rate); empty if n is not a positive number
  std::optional<ImuUtilsReading> as_density{};  ///< n is N
};

struct ImuUtilsTriadMeaning {
  std::string unit{};       ///< of n and w
  std::string walk_unit{};  ///< of K
  std::array<ImuUtilsAxisMeaning, 4> axes{};
};

struct ImuUtilsExplanation {
  std::string name{};
  double rate_hz = 0.0;
  std::optional<double> record_s{};
  ImuUtilsTriadMeaning gyro{}, accel{};
  /// n as a sample's deviation puts every known tau* below 1 s, where no IMU has its minimum: the file is of a first
  /// version and n is N.
  bool density_is_likely = false;
  Diagnostics diagnostics{};
};

/// `record_s` is the length of the static record that the tool was given. Throws E-CONFIG for a rate or length that is
/// not positive.
ImuUtilsExplanation explain_imu_utils(const ImuUtilsTables& tables, double rate_hz,
                                      std::optional<double> record_s = std::nullopt);

/// Reads the file first: throws what parse_yaml throws, and E-CONFIG if it is not of imu_utils.
ImuUtilsExplanation explain_imu_utils_file(const std::string& path, double rate_hz,
                                           std::optional<double> record_s = std::nullopt);

/// Plain words and a table, for a terminal of 100 columns.
std::string to_text(const ImuUtilsExplanation& explanation);

}  // namespace vispline
