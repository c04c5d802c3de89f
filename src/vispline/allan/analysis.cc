#include "vispline/allan/analysis.h"

#include <algorithm>

#include "vispline/allan/confidence.h"
#include "vispline/allan/curve_sums.h"
#include "vispline/allan/factors.h"
#include "vispline/allan/identify.h"
#include "vispline/allan/imu_utils.h"
#include "vispline/allan/record.h"
#include "vispline/allan/record_checks.h"
#include "vispline/core/parallel.h"

namespace vispline {
namespace {

std::vector<std::string> names(const std::vector<AllanAxis>& axes) {
  std::vector<std::string> names;
  for (const AllanAxis& axis : axes) {
    names.push_back(axis.sensor + (axis.axis.empty() ? "" : " " + axis.axis) +
                    (axis.unit.empty() ? "" : " [" + axis.unit + "]"));
  }
  return names;
}

[[noreturn]] void fail(ExitCode exit_code, std::string code, std::string message, std::string next) {
  throw Error(exit_code, {std::move(code), std::move(message), "", "nothing identified", std::move(next)});
}

}  // namespace

struct AllanAnalyzer::State {
  std::vector<AllanAxis> axes;
  AllanOptions options;
  AllanRecord record;
  RecordChecks checks;

  State(std::vector<AllanAxis> the_axes, AllanOptions the_options)
      : axes(std::move(the_axes)), options(std::move(the_options)), record(axes.size(), options), checks(names(axes)) {}

  /// The grid of the curve and the clusters of imu_utils in one, so that the readings are passed over once.
  std::vector<std::int64_t> overlapping_factors() const {
    std::vector<std::int64_t> factors = averaging_factors(options.taus, record.longest(), Deviation::kOadev);
    if (options.identify) {
      for (const std::int64_t m : imu_utils_factors(record.longest())) factors.push_back(m);
    }
    std::sort(factors.begin(), factors.end());
    factors.erase(std::unique(factors.begin(), factors.end()), factors.end());
    return factors;
  }

  CurveSums sums_of(Deviation kind, std::size_t a, const CurveSums& overlapping) const {
    if (!record.held()) return overlapping;
    const auto grid = averaging_factors(options.taus, record.longest(), kind);
    return kind == Deviation::kOadev ? points_at(overlapping, grid) : curve_sums(record, a, kind, grid);
  }

  AllanCurve curve(Deviation kind, std::size_t a, const CurveSums& sums, double rate_hz,
                   const NoiseTerms& terms) const {
    const std::vector<std::int64_t>& lengths = record.lengths();
    const auto longest = static_cast<std::size_t>(std::max_element(lengths.begin(), lengths.end()) - lengths.begin());
    AllanCurve curve = options.clock && record.held()
                           ? curve_by_noise_type(kind, sums, lengths, rate_hz, record.phase(a, longest))
                           : curve_by_terms(kind, sums, lengths, rate_hz, terms);
    curve.exact = record.held();
    return curve;
  }

  void identify_terms(SignalAnalysis& signal, std::size_t a, const CurveSums& overlapping, double rate_hz) const {
    const double duration_s = static_cast<double>(record.samples()) / rate_hz;
    Identification found = identify(record.spectrum(a).cells(rate_hz), rate_hz, duration_s);
    signal.terms = found.terms;
    signal.misfits = std::move(found.misfits);
    const auto clusters = imu_utils_factors(record.longest());
    const auto values = deviations_at(overlapping, clusters);
    signal.imu_utils = imu_utils_numbers(std::span(clusters).first(values.size()), values, rate_hz, signal.unit);
  }

  SignalAnalysis analyze(std::size_t a, const CurveSums& overlapping, double rate_hz) const {
    const AxisMoments& moments = record.moments(a);
    SignalAnalysis signal;
    signal.sensor = axes[a].sensor;
    signal.axis = axes[a].axis;
    signal.unit = axes[a].unit;
    signal.mean = moments.mean(record.samples());
    signal.standard_deviation = moments.standard_deviation(record.samples());
    signal.constant = moments.constant();
    if (signal.constant) return signal;
    if (options.identify) identify_terms(signal, a, overlapping, rate_hz);
    for (const Deviation kind : options.deviations) {
      signal.curves.push_back(curve(kind, a, sums_of(kind, a, overlapping), rate_hz, signal.terms));
    }
    for (const AllanCurve& curve : signal.curves) {
      if (curve.deviation == Deviation::kOadev || &curve == &signal.curves.front()) signal.minimum = minimum_of(curve);
    }
    return signal;
  }

  void require_fit(std::int64_t fewest, double rate_hz) const {
    if (record.samples() < fewest || record.lengths().empty()) {
      fail(ExitCode::kUnfit, "E-TOO-SHORT",
           "the record holds " + std::to_string(record.samples()) + " samples; noise cannot be told from fewer than " +
               std::to_string(fewest) + " (" + std::to_string(static_cast<double>(fewest) / rate_hz) + " s)",
           "record longer: an hour shows white noise well, three to six show the random walk of most sensors");
    }
    bool changes = false;
    for (std::size_t a = 0; a < axes.size(); ++a) changes = changes || !record.moments(a).constant();
    if (!changes) fail(ExitCode::kUnfit, "E-CONSTANT", "no axis ever changes", "check the sensor and the columns");
    require(record.held() || options.taus == "log", "the log grid of taus for a record that is not held in memory");
    for (const Deviation kind : options.deviations) {
      require(record.held() || kind == Deviation::kOadev, "oadev alone for a record that is not held in memory");
    }
  }
};

AllanAnalyzer::AllanAnalyzer(std::vector<AllanAxis> axes, AllanOptions options)
    : state_(std::make_unique<State>(std::move(axes), std::move(options))) {}
AllanAnalyzer::~AllanAnalyzer() = default;

void AllanAnalyzer::push(std::span<const std::span<const double>> axes) {
  if (axes.empty() || axes[0].empty()) return;
  if (!state_->options.clock) state_->checks.push(axes);
  state_->record.push(axes);
}

void AllanAnalyzer::cut() {
  state_->record.cut();
  state_->checks.end_segment();
}

AllanResult AllanAnalyzer::finish(double rate_hz, std::int64_t fewest) {
  State& s = *state_;
  cut();
  s.require_fit(fewest, rate_hz);
  AllanResult result;
  result.rate_hz = rate_hz;
  result.samples = s.record.samples();
  result.duration_s = static_cast<double>(s.record.samples()) / rate_hz;
  result.segments = static_cast<std::int64_t>(s.record.lengths().size());
  const std::vector<CurveSums> curves = overlapping_curves(s.record, s.overlapping_factors(), s.options.threads);
  result.signals.resize(s.axes.size());
  parallel_for(s.axes.size(), s.options.threads,
               [&](std::size_t a) { result.signals[a] = s.analyze(a, curves[a], rate_hz); });
  result.diagnostics = s.checks.finish(rate_hz);
  return result;
}

}  // namespace vispline
