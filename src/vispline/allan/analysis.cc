#include "vispline/allan/analysis.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "vispline/allan/chi_square.h"
#include "vispline/allan/edf.h"
#include "vispline/allan/factors.h"
#include "vispline/allan/identify.h"
#include "vispline/allan/imu_utils.h"
#include "vispline/allan/noise_type.h"
#include "vispline/allan/overlapping.h"
#include "vispline/allan/record_checks.h"
#include "vispline/allan/spectrum.h"
#include "vispline/allan/stream_curve.h"
#include "vispline/core/parallel.h"

namespace vispline {
namespace {

constexpr int kAlphaOfTerm[kTerms] = {2, 0, -1, -2, -2};

/// One axis while the readings stream by.
struct AxisState {
  std::vector<double> readings;  ///< of all segments, while they are held
  SpectrumBuilder spectrum;
  std::optional<StreamCurve> stream;
  double first = 0.0, sum = 0.0, square = 0.0;  ///< sums about the first reading
  double least = INFINITY, most = -INFINITY;
};

struct Segment {
  std::size_t begin, end;
};

/// Sums of one curve at a rate of 1 Hz.
struct CurveSums {
  std::vector<std::int64_t> factors;
  std::vector<SquaredSum> sums;
};

/// Degrees of freedom of a sum pooled over segments: their variances add by share.
template <class EdfOfPoints>
double pooled_edf(Deviation kind, std::int64_t m, std::span<const std::int64_t> lengths, const EdfOfPoints& edf) {
  double total = 0.0, inverse = 0.0;
  for (const std::int64_t length : lengths) {
    if (length + 1 >= points_needed(kind, m)) total += static_cast<double>(length + 2 - points_needed(kind, m));
  }
  for (const std::int64_t length : lengths) {
    if (length + 1 < points_needed(kind, m)) continue;
    const double share = static_cast<double>(length + 2 - points_needed(kind, m)) / total;
    inverse += share * share / edf(length + 1);
  }
  return inverse > 0.0 ? 1.0 / inverse : 1.0;
}

std::vector<NoiseShare> shares(const NoiseTerms& terms, double tau_s) {
  std::vector<NoiseShare> parts;
  const double total = terms.deviation(tau_s);
  for (std::size_t i = 0; i < kTerms && total > 0.0; ++i) {
    const double part = deviation_of(static_cast<Term>(i), terms.term[i].value, tau_s) / total;
    if (part > 0.0) parts.push_back({kAlphaOfTerm[i], part * part});
  }
  if (parts.empty()) parts.push_back({0, 1.0});
  return parts;
}

[[noreturn]] void fail(ExitCode exit_code, std::string code, std::string message, std::string next) {
  throw Error(exit_code, {std::move(code), std::move(message), "", "nothing identified", std::move(next)});
}

}  // namespace

struct AllanAnalyzer::State {
  std::vector<AllanAxis> axes;
  AllanOptions options;
  std::vector<AxisState> state;
  RecordChecks checks;
  std::vector<Segment> segments;
  std::int64_t samples = 0, open = 0;  ///< `open`: readings of the segment that is not yet ended
  bool held = true;

  static std::vector<std::string> names(const std::vector<AllanAxis>& axes) {
    std::vector<std::string> names;
    for (const AllanAxis& axis : axes) {
      names.push_back(axis.sensor + (axis.axis.empty() ? "" : " " + axis.axis) +
                      (axis.unit.empty() ? "" : " [" + axis.unit + "]"));
    }
    return names;
  }

  State(std::vector<AllanAxis> the_axes, AllanOptions the_options)
      : axes(std::move(the_axes)), options(std::move(the_options)), state(axes.size()), checks(names(axes)) {}

  void push(std::span<const std::span<const double>> blocks) {
    const std::size_t n = blocks.empty() ? 0 : blocks[0].size();
    if (n == 0) return;
    if (samples == 0) {
      for (std::size_t a = 0; a < axes.size(); ++a) state[a].first = blocks[a][0];
    }
    if (!options.clock) checks.push(blocks);
    parallel_for(axes.size(), options.threads, [&](std::size_t a) { push_axis(state[a], blocks[a]); });
    samples += static_cast<std::int64_t>(n);
    open += static_cast<std::int64_t>(n);
    const bool too_long = options.memory == AllanMemory::kAuto && samples > kExactSamples;
    if (held && (too_long || options.memory == AllanMemory::kBounded)) let_go();
  }

  void push_axis(AxisState& axis, std::span<const double> block) {
    for (const double reading : block) {
      const double off = reading - axis.first;
      axis.sum += off;
      axis.square += off * off;
      axis.least = std::min(axis.least, reading);
      axis.most = std::max(axis.most, reading);
    }
    if (options.identify) axis.spectrum.push(block);
    if (held) {
      axis.readings.insert(axis.readings.end(), block.begin(), block.end());
    } else {
      axis.stream->push(block);
    }
  }

  /// From here on the readings are not held; those so far go the way the next ones will.
  void let_go() {
    held = false;
    parallel_for(axes.size(), options.threads, [&](std::size_t a) {
      AxisState& axis = state[a];
      axis.stream.emplace(axis.first);
      const std::span<const double> all(axis.readings);
      std::size_t done = 0;
      for (const Segment& segment : segments) {
        axis.stream->push(all.subspan(segment.begin, segment.end - segment.begin));
        axis.stream->end_segment();
        done = segment.end;
      }
      axis.stream->push(all.subspan(done));
      std::vector<double>().swap(axis.readings);
    });
  }

  void cut() {
    if (open == 0) return;
    const auto end = static_cast<std::size_t>(samples);
    segments.push_back({end - static_cast<std::size_t>(open), end});
    open = 0;
    checks.end_segment();
    parallel_for(axes.size(), options.threads, [&](std::size_t a) {
      if (options.identify) state[a].spectrum.end_segment();
      if (state[a].stream) state[a].stream->end_segment();
    });
  }

  std::vector<std::int64_t> lengths() const {
    std::vector<std::int64_t> list;
    for (const Segment& segment : segments) list.push_back(static_cast<std::int64_t>(segment.end - segment.begin));
    return list;
  }

  std::vector<double> segment_phase(std::size_t a, const Segment& segment) const {
    const double mean = state[a].first + state[a].sum / static_cast<double>(samples);
    return phase_of(std::span(state[a].readings).subspan(segment.begin, segment.end - segment.begin), 1.0, mean);
  }

  /// Overlapping Allan sums of all axes at these factors.
  std::vector<std::vector<SquaredSum>> exact_overlapping(std::span<const std::int64_t> factors) const {
    std::vector<std::vector<SquaredSum>> pooled(axes.size(), std::vector<SquaredSum>(factors.size()));
    for (const Segment& segment : segments) {
      std::vector<std::vector<double>> phases(axes.size());
      parallel_for(axes.size(), options.threads, [&](std::size_t a) { phases[a] = segment_phase(a, segment); });
      const std::vector<std::span<const double>> views(phases.begin(), phases.end());
      const auto sums = overlapping_sums(views, factors, options.threads);
      for (std::size_t a = 0; a < axes.size(); ++a) {
        for (std::size_t i = 0; i < factors.size(); ++i) pooled[a][i] += sums[a][i];
      }
    }
    return pooled;
  }

  /// Any deviation of one axis.
  CurveSums exact_curve(Deviation kind, std::size_t a, std::int64_t longest) const {
    CurveSums curve{averaging_factors(options.taus, longest, kind), {}};
    curve.sums.resize(curve.factors.size());
    for (const Segment& segment : segments) {
      const std::vector<double> phase = segment_phase(a, segment);
      for (std::size_t i = 0; i < curve.factors.size(); ++i) {
        curve.sums[i] += squared_sum(kind, phase, curve.factors[i]);
      }
    }
    return curve;
  }

  AllanCurve finish_curve(Deviation kind, const CurveSums& sums, std::size_t a, double rate_hz,
                          const NoiseTerms& terms) const {
    AllanCurve curve;
    curve.deviation = kind;
    curve.exact = held;
    const std::vector<std::int64_t> all_lengths = lengths();
    const auto longest = std::max_element(segments.begin(), segments.end(), [](const Segment& x, const Segment& y) {
      return x.end - x.begin < y.end - y.begin;
    });
    const std::vector<double> phase = options.clock && held ? segment_phase(a, *longest) : std::vector<double>{};
    int alpha = 2;  // a steeper noise fades for good: it never rules again at a longer time
    for (std::size_t i = 0; i < sums.factors.size(); ++i) {
      const std::int64_t m = sums.factors[i];
      const double value = deviation(kind, sums.sums[i], m, 1.0) * (kind == Deviation::kTdev ? 1.0 / rate_hz : 1.0);
      if (!std::isfinite(value)) continue;
      const double tau_s = static_cast<double>(m) / rate_hz;
      if (options.clock) alpha = std::min(alpha, noise_alpha(phase, m).value_or(alpha));
      const std::vector<NoiseShare> parts =
          options.clock ? std::vector<NoiseShare>{{alpha, 1.0}} : shares(terms, tau_s);
      const double edf = pooled_edf(kind, m, all_lengths, [&](std::int64_t points) {
        return kind == Deviation::kTotdev ? edf_of(kind, parts[0].alpha, m, points) : edf_of(kind, parts, m, points);
      });
      const IntervalFactors interval = deviation_interval(edf, kCurveConfidence);
      curve.tau_s.push_back(tau_s);
      curve.value.push_back(value);
      curve.low.push_back(value * interval.low);
      curve.high.push_back(value * interval.high);
      curve.edf.push_back(edf);
      curve.count.push_back(sums.sums[i].count);
    }
    return curve;
  }

  static MinimumDeviation minimum_of(const AllanCurve& curve) {
    MinimumDeviation minimum;
    for (std::size_t i = 0; i < curve.tau_s.size(); ++i) {
      if (i == 0 || curve.value[i] < minimum.deviation) minimum = {curve.tau_s[i], curve.value[i]};
    }
    return minimum;
  }

  /// The deviation at imu_utils' own clusters: exact where the readings are held, else read off the curve.
  std::vector<double> at_clusters(std::span<const std::int64_t> clusters, const CurveSums& curve) const {
    std::vector<double> values;
    for (const std::int64_t m : clusters) {
      const auto at = std::lower_bound(curve.factors.begin(), curve.factors.end(), m);
      if (at == curve.factors.end()) break;
      const auto i = static_cast<std::size_t>(at - curve.factors.begin());
      const double right = std::log(deviation(Deviation::kOadev, curve.sums[i], curve.factors[i], 1.0));
      if (*at == m || i == 0) {
        values.push_back(std::exp(right));
        continue;
      }
      const double left = std::log(deviation(Deviation::kOadev, curve.sums[i - 1], curve.factors[i - 1], 1.0));
      const double share = std::log(static_cast<double>(m) / static_cast<double>(curve.factors[i - 1])) /
                           std::log(static_cast<double>(*at) / static_cast<double>(curve.factors[i - 1]));
      values.push_back(std::exp(left + share * (right - left)));
    }
    return values;
  }

  /// One set of sums holds the grid and the clusters of imu_utils, so the readings are passed over once.
  std::vector<CurveSums> overlapping_curves(std::int64_t longest) const {
    std::vector<CurveSums> curves(axes.size());
    if (!held) {
      for (std::size_t a = 0; a < axes.size(); ++a) {
        for (const StreamCurve::Point& point : state[a].stream->points()) {
          curves[a].factors.push_back(point.m);
          curves[a].sums.push_back(point.sum);
        }
      }
      return curves;
    }
    std::vector<std::int64_t> factors = averaging_factors(options.taus, longest, Deviation::kOadev);
    if (options.identify) {
      for (const std::int64_t m : imu_utils_factors(longest)) factors.push_back(m);
    }
    std::sort(factors.begin(), factors.end());
    factors.erase(std::unique(factors.begin(), factors.end()), factors.end());
    auto sums = exact_overlapping(factors);
    for (std::size_t a = 0; a < axes.size(); ++a) curves[a] = {factors, std::move(sums[a])};
    return curves;
  }

  CurveSums on_grid(const CurveSums& curve, std::int64_t longest) const {
    if (!held) return curve;
    const auto grid = averaging_factors(options.taus, longest, Deviation::kOadev);
    CurveSums kept;
    for (std::size_t i = 0; i < curve.factors.size(); ++i) {
      if (!std::binary_search(grid.begin(), grid.end(), curve.factors[i])) continue;
      kept.factors.push_back(curve.factors[i]);
      kept.sums.push_back(curve.sums[i]);
    }
    return kept;
  }

  SignalAnalysis analyze(std::size_t a, const CurveSums& overlapping, std::int64_t longest, double rate_hz) const {
    SignalAnalysis signal;
    const AxisState& axis = state[a];
    const auto n = static_cast<double>(samples);
    signal.sensor = axes[a].sensor;
    signal.axis = axes[a].axis;
    signal.unit = axes[a].unit;
    signal.mean = axis.first + axis.sum / n;
    signal.standard_deviation = std::sqrt(std::max(0.0, (axis.square - axis.sum * axis.sum / n) / (n - 1.0)));
    signal.constant = axis.least == axis.most;
    if (signal.constant) return signal;
    if (options.identify) {
      Identification found = identify(axis.spectrum.cells(rate_hz), rate_hz, n / rate_hz);
      signal.terms = found.terms;
      signal.misfits = std::move(found.misfits);
      const auto clusters = imu_utils_factors(longest);
      const auto values = at_clusters(clusters, overlapping);
      signal.imu_utils = imu_utils_numbers(std::span(clusters).first(values.size()), values, rate_hz, axes[a].unit);
    }
    for (const Deviation kind : options.deviations) {
      const CurveSums sums = kind == Deviation::kOadev ? on_grid(overlapping, longest) : exact_curve(kind, a, longest);
      signal.curves.push_back(finish_curve(kind, sums, a, rate_hz, signal.terms));
    }
    for (const AllanCurve& curve : signal.curves) {
      if (curve.deviation == Deviation::kOadev || &curve == &signal.curves.front()) signal.minimum = minimum_of(curve);
    }
    return signal;
  }

  void require_fit(std::int64_t fewest, double rate_hz) const {
    if (samples < fewest || segments.empty()) {
      fail(ExitCode::kUnfit, "E-TOO-SHORT",
           "the record holds " + std::to_string(samples) + " samples; noise cannot be told from fewer than " +
               std::to_string(fewest) + " (" + std::to_string(static_cast<double>(fewest) / rate_hz) + " s)",
           "record longer: an hour shows white noise well, three to six show the random walk of most sensors");
    }
    const bool changes = std::any_of(state.begin(), state.end(), [](const AxisState& s) { return s.least != s.most; });
    if (!changes) fail(ExitCode::kUnfit, "E-CONSTANT", "no axis ever changes", "check the sensor and the columns");
    require(held || options.taus == "log", "the log grid of taus for a record that is not held in memory");
    for (const Deviation kind : options.deviations) {
      require(held || kind == Deviation::kOadev, "oadev alone for a record that is not held in memory");
    }
  }
};

AllanAnalyzer::AllanAnalyzer(std::vector<AllanAxis> axes, AllanOptions options)
    : state_(std::make_unique<State>(std::move(axes), std::move(options))) {}
AllanAnalyzer::~AllanAnalyzer() = default;

void AllanAnalyzer::push(std::span<const std::span<const double>> axes) { state_->push(axes); }
void AllanAnalyzer::cut() { state_->cut(); }

AllanResult AllanAnalyzer::finish(double rate_hz, std::int64_t fewest) {
  State& s = *state_;
  s.cut();
  s.require_fit(fewest, rate_hz);
  AllanResult result;
  result.rate_hz = rate_hz;
  result.samples = s.samples;
  result.duration_s = static_cast<double>(s.samples) / rate_hz;
  result.segments = static_cast<std::int64_t>(s.segments.size());
  const std::vector<std::int64_t> lengths = s.lengths();
  const std::int64_t longest = *std::max_element(lengths.begin(), lengths.end());
  std::vector<CurveSums> curves = s.overlapping_curves(longest);
  result.signals.resize(s.axes.size());
  parallel_for(s.axes.size(), s.options.threads,
               [&](std::size_t a) { result.signals[a] = s.analyze(a, curves[a], longest, rate_hz); });
  result.diagnostics = s.checks.finish(rate_hz);
  return result;
}

}  // namespace vispline
