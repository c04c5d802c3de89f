#include "vispline/allan/record_checks.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>

namespace vispline {
namespace {

constexpr std::size_t kMaxWindows = 8192;
constexpr std::size_t kSample = 20000;
constexpr double kSpike = 10.0;            ///< standard deviations of the window before
constexpr double kMotionSpread = 1.5;      ///< times the median spread of the windows, and
constexpr double kMotionDeviations = 8.0;  ///< that many median deviations above it
constexpr double kMotionJump = 10.0;       ///< median jumps between neighbouring windows
constexpr double kHeldShare = 0.02;
constexpr double kDriftShare = 0.9;  ///< of the variance of the means that a parabola explains
constexpr std::size_t kMaxIntervals = 5;

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double median_deviation(const std::vector<double>& values, double centre) {
  std::vector<double> off;
  for (const double value : values) off.push_back(std::abs(value - centre));
  return 1.4826 * median(off);
}

std::string text(double value, int digits = 3) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.*g", digits, value);
  return buffer;
}

Diagnostic warning(std::string code, std::string message, std::string effect, std::string next) {
  return {std::move(code), std::move(message), "", std::move(effect), std::move(next)};
}

/// Smallest step that all readings are multiples of, 0 if there is none.
double quantum_of(const std::vector<double>& sample) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < sample.size(); ++i) {
    if (sample[i] != sample[i - 1]) steps.push_back(std::abs(sample[i] - sample[i - 1]));
  }
  if (steps.size() < 100) return 0.0;
  const double quantum = *std::min_element(steps.begin(), steps.end());
  const auto whole = std::count_if(steps.begin(), steps.end(), [&](double step) {
    const double multiple = step / quantum;
    return multiple < 1e4 && std::abs(multiple - std::round(multiple)) < 0.02 * std::max(1.0, 0.01 * multiple);
  });
  return static_cast<double>(whole) > 0.99 * static_cast<double>(steps.size()) ? quantum : 0.0;
}

}  // namespace

RecordChecks::RecordChecks(std::vector<std::string> names) : names_(std::move(names)) {
  const std::size_t axes = names_.size();
  last_.assign(axes, NAN);
  spread_.assign(axes, 0.0);
  centre_.assign(axes, 0.0);
  spikes_.assign(axes, 0);
  first_spike_.assign(axes, 0);
  sample_.resize(axes);
  open_.mean.assign(axes, 0.0);
  open_.square.assign(axes, 0.0);
}

void RecordChecks::push(std::span<const std::span<const double>> axes) {
  const std::size_t n = axes.empty() ? 0 : axes[0].size();
  for (std::size_t begin = 0; begin < n;) {
    const auto room = static_cast<std::size_t>(window_length_ - open_.count);
    const std::size_t end = std::min(n, begin + room);
    add(begin, end, axes);
    if (open_.count == window_length_) close_window();
    begin = end;
  }
}

void RecordChecks::add(std::size_t begin, std::size_t end, std::span<const std::span<const double>> axes) {
  for (std::size_t i = begin; i < end; ++i) {
    bool same = true;
    for (std::size_t a = 0; a < axes.size(); ++a) same = same && axes[a][i] == last_[a];
    held_ += same;
    for (std::size_t a = 0; a < axes.size(); ++a) last_[a] = axes[a][i];
  }
  const double before = static_cast<double>(open_.count);
  const double count = static_cast<double>(end - begin);
  for (std::size_t a = 0; a < axes.size(); ++a) {
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i) sum += axes[a][i];
    const double mean = sum / count;
    double square = 0.0;
    for (std::size_t i = begin; i < end; ++i) square += (axes[a][i] - mean) * (axes[a][i] - mean);
    const double shift = mean - open_.mean[a];
    open_.square[a] += square + shift * shift * before * count / (before + count);
    open_.mean[a] += shift * count / (before + count);
    if (spread_[a] > 0.0) {
      for (std::size_t i = begin; i < end; ++i) {
        if (std::abs(axes[a][i] - centre_[a]) <= kSpike * spread_[a]) continue;
        if (spikes_[a]++ == 0) first_spike_[a] = readings_ + static_cast<std::int64_t>(i - begin);
      }
    }
    for (std::size_t i = begin; i < end && sample_[a].size() < kSample; ++i) sample_[a].push_back(axes[a][i]);
  }
  open_.count += static_cast<std::int64_t>(end - begin);
  readings_ += static_cast<std::int64_t>(end - begin);
}

void RecordChecks::close_window() {
  const auto count = static_cast<double>(open_.count);
  for (std::size_t a = 0; a < names_.size(); ++a) {
    spread_[a] = std::sqrt(open_.square[a] / count);
    centre_[a] = open_.mean[a];
  }
  windows_.push_back(open_);
  const std::size_t axes = names_.size();
  open_ = {readings_, 0, std::vector<double>(axes, 0.0), std::vector<double>(axes, 0.0)};
  if (windows_.size() >= kMaxWindows) merge_pairs();
}

void RecordChecks::merge_pairs() {
  std::vector<Window> merged;
  for (std::size_t i = 0; i + 1 < windows_.size(); i += 2) {
    Window both = windows_[i];
    const Window& next = windows_[i + 1];
    const auto n = static_cast<double>(both.count), m = static_cast<double>(next.count);
    for (std::size_t a = 0; a < names_.size(); ++a) {
      const double shift = next.mean[a] - both.mean[a];
      both.square[a] += next.square[a] + shift * shift * n * m / (n + m);
      both.mean[a] += shift * m / (n + m);
    }
    both.count += next.count;
    merged.push_back(std::move(both));
  }
  windows_ = std::move(merged);
  window_length_ *= 2;
}

void RecordChecks::end_segment() {
  open_ = {readings_, 0, std::vector<double>(names_.size(), 0.0), std::vector<double>(names_.size(), 0.0)};
  std::fill(spread_.begin(), spread_.end(), 0.0);
  std::fill(last_.begin(), last_.end(), NAN);
}

void RecordChecks::check_motion(Diagnostics& found, double rate_hz) const {
  std::vector<bool> moving(windows_.size(), false);
  for (std::size_t a = 0; a < names_.size(); ++a) {
    std::vector<double> spread, jump;
    for (std::size_t i = 0; i < windows_.size(); ++i) {
      spread.push_back(std::sqrt(windows_[i].square[a] / static_cast<double>(windows_[i].count)));
      if (i > 0) jump.push_back(std::abs(windows_[i].mean[a] - windows_[i - 1].mean[a]));
    }
    const double usual = median(spread), deviation = median_deviation(spread, usual), usual_jump = median(jump);
    if (usual == 0.0) continue;
    const double limit = std::max(kMotionSpread * usual, usual + kMotionDeviations * deviation);
    for (std::size_t i = 0; i < windows_.size(); ++i) {
      const bool jumps = i > 0 && usual_jump > 0.0 && jump[i - 1] > kMotionJump * usual_jump && jump[i - 1] > usual;
      if (spread[i] > limit || jumps) moving[i] = true;
    }
  }
  const auto count = std::count(moving.begin(), moving.end(), true);
  if (count == 0) return;
  std::string intervals;
  std::size_t listed = 0, all = 0;
  for (std::size_t i = 0; i < moving.size();) {
    if (!moving[i]) {
      ++i;
      continue;
    }
    std::size_t last = i;
    while (last + 1 < moving.size() && moving[last + 1]) ++last;
    if (listed < kMaxIntervals) {
      const double begin = static_cast<double>(windows_[i].first) / rate_hz;
      const double end = static_cast<double>(windows_[last].first + windows_[last].count) / rate_hz;
      intervals += (listed++ ? ", " : "") + text(begin, 6) + " - " + text(end, 6) + " s";
    }
    ++all;
    i = last + 1;
  }
  if (all > listed) intervals += " and " + std::to_string(all - listed) + " more";
  const double share = 100.0 * static_cast<double>(count) / static_cast<double>(moving.size());
  found.add(warning("W-MOTION", "the sensor moved or shook in " + text(share) + " % of the record: " + intervals,
                    "all samples are used; motion raises the curves",
                    "cut those parts out, or record on a still table"));
}

void RecordChecks::check_drift(Diagnostics& found, double rate_hz) const {
  const auto n = static_cast<Eigen::Index>(windows_.size());
  if (n < 32) return;
  Eigen::MatrixXd basis(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double t = 2.0 * static_cast<double>(i) / static_cast<double>(n - 1) - 1.0;
    basis.row(i) << 1.0, t, t * t;
  }
  const auto solver = basis.colPivHouseholderQr();
  std::string axes;
  for (std::size_t a = 0; a < names_.size(); ++a) {
    Eigen::VectorXd mean(n);
    for (Eigen::Index i = 0; i < n; ++i) mean(i) = windows_[static_cast<std::size_t>(i)].mean[a];
    const Eigen::VectorXd fit = basis * solver.solve(mean);
    const double total = (mean.array() - mean.mean()).square().sum();
    if (total <= 0.0 || (mean - fit).squaredNorm() > (1.0 - kDriftShare) * total) continue;
    axes += (axes.empty() ? "" : ", ") + names_[a] + " by " + text(fit.maxCoeff() - fit.minCoeff());
  }
  if (axes.empty()) return;
  const double minutes = static_cast<double>(readings_) / rate_hz / 60.0;
  found.add(warning("W-DRIFT", "slow drift over " + text(minutes) + " min, as a warming sensor has: " + axes,
                    "the drift is in the curves and terms at long times",
                    "let the sensor warm up for half an hour before recording, and keep the room's temperature"));
}

void RecordChecks::check_spikes(Diagnostics& found, double rate_hz) const {
  std::string axes;
  std::int64_t all = 0, first = readings_;
  for (std::size_t a = 0; a < names_.size(); ++a) {
    if (spikes_[a] == 0) continue;
    axes += (axes.empty() ? "" : ", ") + std::to_string(spikes_[a]) + " of " + names_[a];
    all += spikes_[a];
    first = std::min(first, first_spike_[a]);
  }
  if (all == 0) return;
  found.add(warning("W-SPIKE",
                    std::to_string(all) + " readings lie over " + text(kSpike) + " standard deviations off: " + axes +
                        "; the first at " + text(static_cast<double>(first) / rate_hz, 6) + " s",
                    "they are used", "look for knocks, electrical faults or lost bytes"));
}

void RecordChecks::check_quantum(Diagnostics& found) const {
  std::string axes;
  double worst = 0.0;  ///< step over noise
  for (std::size_t a = 0; a < names_.size(); ++a) {
    const double quantum = quantum_of(sample_[a]);
    std::vector<double> spread;
    for (const Window& window : windows_) {
      spread.push_back(std::sqrt(window.square[a] / static_cast<double>(window.count)));
    }
    const double noise = median(spread);
    if (quantum == 0.0 || quantum < 0.5 * noise) continue;
    axes += (axes.empty() ? "" : "; ") + names_[a] + " " + text(quantum) + ", noise " + text(noise);
    worst = std::max(worst, noise > 0.0 ? quantum / noise : HUGE_VAL);
  }
  if (axes.empty()) return;
  found.add(warning("W-QUANTUM", "readings come in steps that are coarse beside their noise: " + axes,
                    worst > 2.0 ? "the steps hide the noise: the white noise printed is mostly theirs"
                                : "rounding adds step / sqrt(12) to the noise",
                    "choose a finer range of the sensor or more digits in the log"));
}

void RecordChecks::check_held(Diagnostics& found) const {
  const double share = static_cast<double>(held_) / static_cast<double>(std::max<std::int64_t>(readings_, 1));
  if (share < kHeldShare) return;
  found.add(warning("W-HELD", text(100.0 * share) + " % of the readings repeat the one before on every axis",
                    "a held reading is no new noise: N comes out too large by up to sqrt(1 / (1 - that share))",
                    "log at the sensor's own rate; if a faster log is needed, average instead of holding"));
}

Diagnostics RecordChecks::finish(double rate_hz) const {
  Diagnostics found;
  if (windows_.empty()) return found;
  check_motion(found, rate_hz);
  check_drift(found, rate_hz);
  check_spikes(found, rate_hz);
  check_quantum(found);
  check_held(found);
  return found;
}

}  // namespace vispline
