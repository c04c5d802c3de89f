#include "vispline/allan/deviation.h"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace vispline {
namespace {

constexpr std::array<std::pair<Deviation, std::string_view>, 7> kNames{{{Deviation::kOadev, "oadev"},
                                                                        {Deviation::kAdev, "adev"},
                                                                        {Deviation::kMdev, "mdev"},
                                                                        {Deviation::kTdev, "tdev"},
                                                                        {Deviation::kHdev, "hdev"},
                                                                        {Deviation::kOhdev, "ohdev"},
                                                                        {Deviation::kTotdev, "totdev"}}};

double square(double x) { return x * x; }

/// docs/math/allan.md (2): second differences at lag m, every `stride`-th.
SquaredSum second_differences(std::span<const double> phase, std::size_t m, std::size_t stride) {
  SquaredSum total;
  for (std::size_t k = 0; k + 2 * m < phase.size(); k += stride) {
    total.sum += square((phase[k + 2 * m] - phase[k + m]) - (phase[k + m] - phase[k]));
    ++total.count;
  }
  return total;
}

/// docs/math/allan.md (5): third differences.
SquaredSum third_differences(std::span<const double> phase, std::size_t m, std::size_t stride) {
  SquaredSum total;
  for (std::size_t k = 0; k + 3 * m < phase.size(); k += stride) {
    total.sum += square((phase[k + 3 * m] - phase[k]) - 3.0 * (phase[k + 2 * m] - phase[k + m]));
    ++total.count;
  }
  return total;
}

/// docs/math/allan.md (4): second differences averaged over m starts, by a running sum.
SquaredSum averaged_differences(std::span<const double> phase, std::size_t m) {
  SquaredSum total;
  if (phase.size() < 3 * m) return total;
  const auto second = [&](std::size_t k) { return (phase[k + 2 * m] - phase[k + m]) - (phase[k + m] - phase[k]); };
  double window = 0.0;
  for (std::size_t k = 0; k < m; ++k) window += second(k);
  const auto m_double = static_cast<double>(m);
  total.sum = square(window / m_double);
  total.count = 1;
  for (std::size_t k = 0; k + 3 * m < phase.size(); ++k) {
    window += second(k + m) - second(k);
    total.sum += square(window / m_double);
    ++total.count;
  }
  return total;
}

/// docs/math/allan.md (6): second differences around every inner point of the phase reflected at both ends.
SquaredSum total_differences(std::span<const double> phase, std::size_t m) {
  SquaredSum total;
  const std::size_t n = phase.size();
  if (n < 3 || m >= n) return total;
  const auto before = [&](std::size_t i) { return i >= m ? phase[i - m] : 2.0 * phase[0] - phase[m - i]; };
  const auto after = [&](std::size_t i) {
    return i + m < n ? phase[i + m] : 2.0 * phase[n - 1] - phase[2 * (n - 1) - (i + m)];
  };
  for (std::size_t i = 1; i + 1 < n; ++i) total.sum += square((after(i) - phase[i]) - (phase[i] - before(i)));
  total.count = static_cast<std::int64_t>(n - 2);
  return total;
}

/// What a mean square of differences is divided by besides tau^2.
double divisor(Deviation kind) { return kind == Deviation::kHdev || kind == Deviation::kOhdev ? 6.0 : 2.0; }

}  // namespace

std::string_view name_of(Deviation kind) {
  for (const auto& [value, name] : kNames) {
    if (value == kind) return name;
  }
  return "";
}

std::optional<Deviation> deviation_named(std::string_view name) {
  for (const auto& [value, known] : kNames) {
    if (known == name) return value;
  }
  return std::nullopt;
}

std::vector<std::string> deviation_names() {
  std::vector<std::string> names;
  for (const auto& entry : kNames) names.emplace_back(entry.second);
  return names;
}

Phase phase_of(std::span<const double> readings, double rate_hz, double mean) {
  Phase phase(readings.size() + 1);
  const double step_s = 1.0 / rate_hz;
  double sum = 0.0;
  for (std::size_t k = 0; k < readings.size(); ++k) {
    sum += (readings[k] - mean) * step_s;
    phase[k + 1] = sum;
  }
  return phase;
}

SquaredSum squared_sum(Deviation kind, std::span<const double> phase, std::int64_t factor) {
  const auto m = static_cast<std::size_t>(factor);
  switch (kind) {
    case Deviation::kOadev:
      return second_differences(phase, m, 1);
    case Deviation::kAdev:
      return second_differences(phase, m, m);
    case Deviation::kMdev:
    case Deviation::kTdev:
      return averaged_differences(phase, m);
    case Deviation::kHdev:
      return third_differences(phase, m, m);
    case Deviation::kOhdev:
      return third_differences(phase, m, 1);
    case Deviation::kTotdev:
      return total_differences(phase, m);
  }
  return {};
}

double deviation(Deviation kind, const SquaredSum& pooled, std::int64_t m, double rate_hz) {
  if (pooled.count == 0) return std::numeric_limits<double>::quiet_NaN();
  const double tau_s = static_cast<double>(m) / rate_hz;
  const double value = std::sqrt(pooled.sum / static_cast<double>(pooled.count) / divisor(kind)) / tau_s;
  return kind == Deviation::kTdev ? value * tau_s / std::sqrt(3.0) : value;
}

std::int64_t points_needed(Deviation kind, std::int64_t m) {
  switch (kind) {
    case Deviation::kOadev:
    case Deviation::kAdev:
      return 2 * m + 1;
    case Deviation::kMdev:
    case Deviation::kTdev:
      return 3 * m;
    case Deviation::kHdev:
    case Deviation::kOhdev:
      return 3 * m + 1;
    case Deviation::kTotdev:
      return m + 1;
  }
  return 0;
}

}  // namespace vispline
