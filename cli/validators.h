/// What a number on the command line may be. CLI11's own ranges let nan pass; these do not.
#pragma once

#include <CLI/CLI.hpp>

namespace vispline::cli {

inline constexpr double kMaxRate_hz = 1e8;
inline constexpr double kMaxSeed = 9e18;  ///< integers in JSON are signed

/// Above 0, up to `most`.
CLI::Validator positive(double most = 1e9);
/// From 0 to `most`.
CLI::Validator not_negative(double most = 1e9);
/// From `least` to `most`.
CLI::Validator between(double least, double most);
/// The name of a file or folder to write.
CLI::Validator not_empty();

}  // namespace vispline::cli
