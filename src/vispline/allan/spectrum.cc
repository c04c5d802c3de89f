#include "vispline/allan/spectrum.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/FFT>

namespace vispline {
namespace {

constexpr std::int64_t kDecimation = 8;
constexpr std::int64_t kBlock = 1024;                  ///< readings per transform of a level
constexpr std::int64_t kKept = std::int64_t{1} << 16;  ///< a series up to this long is transformed whole
constexpr std::int64_t kSingle = 32;                   ///< indices that stay cells of their own
constexpr double kBinWidth = 1.04;                     ///< ratio of frequencies pooled into one cell

/// First and last index of the band a transform of `length` values answers for. The level below covers what lies under
/// it (`upper` levels only), the level above what is over half its Nyquist frequency.
struct Band {
  std::int64_t first, last;
};
Band band_of(std::int64_t length, bool lowest_level, bool highest_level) {
  return {highest_level ? 1 : length / (2 * kDecimation) + 1, lowest_level ? length - 1 : length / 2};
}

/// z^2 summed over transforms of one kind.
struct PooledTransform {
  DifferencedSeries series;
  Band band{};
  double transforms = 0.0;
  std::vector<double> power;  ///< by index from 0, summed
};

SpectralCell cell_of(const PooledTransform& pooled, std::int64_t first, std::int64_t last, double first_value) {
  SpectralCell cell;
  const auto indices = static_cast<double>(last - first + 1);
  for (std::int64_t j = first; j <= last; ++j) {
    const TermPowers powers = term_powers(pooled.series, j);
    for (std::size_t i = 0; i < kVariances; ++i) cell.expected[i] += powers[i] / indices;
    if (!pooled.power.empty()) cell.power += pooled.power[static_cast<std::size_t>(j)];
  }
  cell.count = indices * pooled.transforms;
  cell.power /= cell.count;
  cell.frequency_hz =
      0.25 * static_cast<double>(first + last) / static_cast<double>(pooled.series.length) / pooled.series.step_s;
  if (cell.count == 1.0) {
    cell.value = first_value;
    cell.ramp = ramp_mean(pooled.series, first);
  }
  return cell;
}

/// `values`: the transform itself if there was one only, for the sign of its lowest indices.
void append_cells(const PooledTransform& pooled, std::span<const double> values, std::vector<SpectralCell>& cells) {
  for (std::int64_t j = pooled.band.first; j <= pooled.band.last;) {
    const auto wide = static_cast<std::int64_t>(static_cast<double>(j) * kBinWidth);
    const std::int64_t last = j <= kSingle ? j : std::min(std::max(j, wide), pooled.band.last);
    cells.push_back(cell_of(pooled, j, last, values.empty() ? 0.0 : values[static_cast<std::size_t>(j - 1)]));
    j = last + 1;
  }
}

}  // namespace

std::int64_t smooth_length(std::int64_t n) {
  for (std::int64_t candidate = n; candidate > 1; --candidate) {
    std::int64_t rest = candidate;
    for (const std::int64_t p : {2, 3, 5}) {
      while (rest % p == 0) rest /= p;
    }
    if (rest == 1) return candidate;
  }
  return 1;
}

std::vector<double> difference_transform(std::span<const double> series) {
  const std::size_t n = series.size();
  std::vector<double> odd(2 * n, 0.0);  // odd around 0 and n: its Fourier transform is the sine transform
  for (std::size_t k = 1; k < n; ++k) {
    odd[k] = series[k] - series[k - 1];
    odd[2 * n - k] = -odd[k];
  }
  thread_local Eigen::FFT<double> fft;
  fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  std::vector<std::complex<double>> spectrum;
  fft.fwd(spectrum, odd);
  std::vector<double> z(n - 1);
  const double scale = -0.5 * std::sqrt(2.0 / static_cast<double>(n));
  for (std::size_t j = 1; j < n; ++j) z[j - 1] = scale * spectrum[j].imag();
  return z;
}

struct SpectrumBuilder::State {
  struct Level {
    DifferencedSeries series;  ///< of one block
    std::vector<double> kept;  ///< of the current segment: whole until it overflows, then the rest of a block
    bool overflowed = false;
    double sum = 0.0;  ///< towards the next mean of the level above
    std::int64_t summed = 0;
    PooledTransform blocks;  ///< of all segments
  };

  std::vector<Level> levels;
  std::vector<SpectralCell> whole;  ///< of the ended segments, as if the rate were 1 Hz

  State() { add_level(); }

  void add_level() {
    Level level;
    const auto averaged = static_cast<std::int64_t>(std::llround(std::pow(kDecimation, levels.size())));
    level.series = {kBlock, averaged, static_cast<double>(averaged)};
    level.blocks.series = level.series;
    level.blocks.band = band_of(kBlock, levels.empty(), false);
    levels.push_back(std::move(level));
  }

  void transform_blocks(Level& level) {
    const auto block = static_cast<std::size_t>(kBlock);
    std::size_t start = 0;
    for (; start + block <= level.kept.size(); start += block - 1) {
      const auto z = difference_transform(std::span(level.kept).subspan(start, block));
      level.blocks.power.resize(block, 0.0);
      for (std::size_t j = 1; j < block; ++j) level.blocks.power[j] += z[j - 1] * z[j - 1];
      level.blocks.transforms += 1.0;
    }
    level.kept.erase(level.kept.begin(), level.kept.begin() + static_cast<std::ptrdiff_t>(start));
  }

  void push(std::size_t index, std::span<const double> values) {
    if (index == levels.size()) add_level();
    std::vector<double> means;
    {
      Level& level = levels[index];
      level.kept.insert(level.kept.end(), values.begin(), values.end());
      for (const double value : values) {
        level.sum += value;
        if (++level.summed < kDecimation) continue;
        means.push_back(level.sum / static_cast<double>(kDecimation));
        level.sum = 0.0;
        level.summed = 0;
      }
      level.overflowed = level.overflowed || static_cast<std::int64_t>(level.kept.size()) > kKept;
      if (level.overflowed) transform_blocks(level);
    }
    if (!means.empty()) push(index + 1, means);
  }

  void end_segment() {
    std::size_t top = 0;
    while (top + 1 < levels.size() && levels[top].overflowed) ++top;
    const Level& level = levels[top];
    const auto length = static_cast<std::int64_t>(level.kept.size());
    if (length >= kShortestSegment) {
      const auto n = smooth_length(length);
      const auto z = difference_transform(std::span(level.kept).last(static_cast<std::size_t>(n)));
      PooledTransform once{{n, level.series.averaged, level.series.step_s}, band_of(n, top == 0, true), 1.0, {0.0}};
      for (const double value : z) once.power.push_back(value * value);
      append_cells(once, z, whole);
    }
    for (Level& each : levels) {
      each.kept.clear();
      each.overflowed = false;
      each.sum = 0.0;
      each.summed = 0;
    }
  }
};

SpectrumBuilder::SpectrumBuilder() : state_(std::make_unique<State>()) {}
SpectrumBuilder::~SpectrumBuilder() = default;
SpectrumBuilder::SpectrumBuilder(SpectrumBuilder&&) noexcept = default;
SpectrumBuilder& SpectrumBuilder::operator=(SpectrumBuilder&&) noexcept = default;

void SpectrumBuilder::push(std::span<const double> readings) {
  if (!readings.empty()) state_->push(0, readings);
}

void SpectrumBuilder::end_segment() { state_->end_segment(); }

std::vector<SpectralCell> SpectrumBuilder::cells(double rate_hz) const {
  std::vector<SpectralCell> all;
  for (const State::Level& level : state_->levels) {
    if (level.blocks.transforms > 0.0) append_cells(level.blocks, {}, all);
  }
  all.insert(all.end(), state_->whole.begin(), state_->whole.end());
  for (SpectralCell& cell : all) {
    cell.frequency_hz *= rate_hz;
    cell.ramp /= rate_hz;
    cell.expected[0] *= rate_hz * rate_hz;
    cell.expected[1] *= rate_hz;
    cell.expected[3] /= rate_hz;
  }
  return all;
}

std::vector<SpectralCell> empty_cells(double rate_hz, double duration_s) {
  std::vector<SpectralCell> cells;
  double samples = duration_s * rate_hz;
  std::int64_t averaged = 1;
  for (; samples > static_cast<double>(kKept); samples /= kDecimation, averaged *= kDecimation) {
    const PooledTransform blocks{{kBlock, averaged, static_cast<double>(averaged) / rate_hz},
                                 band_of(kBlock, averaged == 1, false),
                                 std::floor(samples / static_cast<double>(kBlock - 1)),
                                 {}};
    append_cells(blocks, {}, cells);
  }
  const auto n = static_cast<std::int64_t>(samples);
  const PooledTransform once{
      {n, averaged, static_cast<double>(averaged) / rate_hz}, band_of(n, averaged == 1, true), 1.0, {}};
  append_cells(once, {}, cells);
  return cells;
}

}  // namespace vispline
