#include "allan_source.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "vispline/core/parallel.h"
#include "vispline/io/imu_stream.h"
#include "vispline/io/series.h"
#include "vispline/simulate/axis_noise.h"

namespace vispline::cli {
namespace {

constexpr std::size_t kFirstStamps = 4096;  ///< stamps that tell the usual step
constexpr double kBurstyShare = 0.2;        ///< steps off the median by more than half, above which stamps are bursty

using AxisBlocks = std::vector<std::vector<double>>;

void push(AllanAnalyzer& analyzer, AxisBlocks& blocks) {
  const std::vector<std::span<const double>> views(blocks.begin(), blocks.end());
  if (!blocks.empty()) analyzer.push(views);
  for (auto& block : blocks) block.clear();
}

/// IMU samples with stamps: where they are cut into segments, and at which rate they came.
class ImuFeeder {
 public:
  explicit ImuFeeder(AllanOptions options) : options_(std::move(options)) {}

  void push(std::span<const Time> time, std::span<const ImuSample> samples) {
    if (gap_ns_ > 0.0) return feed(time, samples);
    first_time_.insert(first_time_.end(), time.begin(), time.end());
    first_samples_.insert(first_samples_.end(), samples.begin(), samples.end());
    if (first_time_.size() >= kFirstStamps) start();
  }

  /// `known_rate_hz` as it was given, or 0: from the stamps.
  AllanResult finish(Session& session, double known_rate_hz) {
    if (gap_ns_ == 0.0) start();
    if (!analyzer_) {
      throw Error(ExitCode::kUnfit, {"E-TOO-SHORT", "the file holds no samples", "", "nothing identified", ""});
    }
    end_segment();
    if (bursty_) {
      session.add(
          Diagnostic{"W-RATE", "the stamps come in bursts: they are times of arrival, not of sampling", "",
                     "the samples are taken as evenly spaced between gaps of a second",
                     "let the driver stamp the samples, or give the rate with --columns (- for the times) and --rate"});
    }
    const double measured = span_s_ > 0.0 ? static_cast<double>(steps_) / span_s_ : 1.0;
    return analyzer_->finish(known_rate_hz > 0.0 ? known_rate_hz : measured);
  }

 private:
  void start() {
    std::vector<double> steps;
    for (std::size_t i = 1; i < first_time_.size(); ++i) {
      steps.push_back(static_cast<double>((first_time_[i] - first_time_[i - 1]).count()));
    }
    gap_ns_ = 1e9;
    if (!steps.empty()) {
      std::vector<double> sorted = steps;
      std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
      const double median = sorted[sorted.size() / 2];
      const auto off =
          std::count_if(steps.begin(), steps.end(), [&](double s) { return std::abs(s - median) > 0.5 * median; });
      bursty_ = static_cast<double>(off) > kBurstyShare * static_cast<double>(steps.size());
      gap_ns_ = bursty_ ? 1e9 : std::max(10.0 * median, 1e8);
    }
    const std::vector<Time> time = std::move(first_time_);
    const std::vector<ImuSample> samples = std::move(first_samples_);
    feed(time, samples);
  }

  void open(const ImuSample& sample) {
    std::vector<AllanAxis> axes;
    for (int c = 0; c < 6; ++c) {
      const double reading = c < 3 ? sample.gyro(c) : sample.accel(c - 3);
      if (std::isnan(reading)) continue;
      channels_.push_back(c);
      axes.push_back({c < 3 ? "gyroscope" : "accelerometer", std::string(1, "xyz"[c % 3]), c < 3 ? "rad/s" : "m/s^2"});
    }
    analyzer_ = std::make_unique<AllanAnalyzer>(axes, options_);
    blocks_.resize(axes.size());
  }

  void feed(std::span<const Time> time, std::span<const ImuSample> samples) {
    for (std::size_t i = 0; i < time.size(); ++i) {
      if (!analyzer_) open(samples[i]);
      if (in_segment_ && static_cast<double>((time[i] - last_).count()) > gap_ns_) end_segment();
      if (!in_segment_) begin_ = time[i];
      steps_ += in_segment_;
      in_segment_ = true;
      last_ = time[i];
      for (std::size_t a = 0; a < channels_.size(); ++a) {
        const int c = channels_[a];
        blocks_[a].push_back(c < 3 ? samples[i].gyro(c) : samples[i].accel(c - 3));
      }
    }
    if (analyzer_) cli::push(*analyzer_, blocks_);
    poll_interrupt();
  }

  void end_segment() {
    if (!in_segment_) return;
    cli::push(*analyzer_, blocks_);
    analyzer_->cut();
    span_s_ += to_seconds(last_ - begin_);
    in_segment_ = false;
  }

  AllanOptions options_;
  std::vector<Time> first_time_;
  std::vector<ImuSample> first_samples_;
  std::vector<int> channels_;
  AxisBlocks blocks_;
  std::unique_ptr<AllanAnalyzer> analyzer_;
  Time begin_{}, last_{};
  double gap_ns_ = 0.0, span_s_ = 0.0;
  std::int64_t steps_ = 0;
  bool in_segment_ = false, bursty_ = false;
};

}  // namespace

AllanResult analyze_imu(const std::string& path, const ReadOptions& read, const AllanOptions& options,
                        Session& session) {
  ImuFeeder feeder(options);
  const ImuStreamResult file = stream_imu(
      path, read, [&](std::span<const Time> time, std::span<const ImuSample> samples) { feeder.push(time, samples); });
  session.add_input("imu", file.counts, file.diagnostics);
  return feeder.finish(session, read.rate_hz);
}

AllanResult analyze_series(const std::string& path, const ReadOptions& read, bool phase, double rate_hz,
                           const AllanOptions& options, Session& session) {
  const auto series = read_series(path, read);
  session.add_input("series", series.counts, series.diagnostics);
  AllanAnalyzer analyzer({{"series", "", ""}}, options);
  AxisBlocks block(1);
  const auto cut = [&] {
    push(analyzer, block);
    analyzer.cut();
  };
  for (std::size_t i = 0; i < series.value.size(); ++i) {
    const bool first_phase = phase && (i == 0 || std::isnan(series.value[i - 1]));
    if (std::isnan(series.value[i])) {
      cut();
    } else if (!first_phase) {
      block[0].push_back(phase ? (series.value[i] - series.value[i - 1]) * rate_hz : series.value[i]);
    }
  }
  cut();
  constexpr std::int64_t kFewestOfSeries = 3;
  return analyzer.finish(rate_hz, kFewestOfSeries);
}

AllanResult analyze_simulated(const ImuNoise& noise, double rate_hz, double duration_s, std::uint64_t seed,
                              const AllanOptions& options) {
  constexpr std::uint64_t kBlock = 65536;
  AllanAnalyzer analyzer({{"gyroscope", "x", "rad/s"}, {"accelerometer", "x", "m/s^2"}}, options);
  std::array<AxisNoise, 2> axes{AxisNoise(noise.gyro, seed, "imu0/gyroscope/x"),
                                AxisNoise(noise.accel, seed, "imu0/accelerometer/x")};
  const auto count = static_cast<std::uint64_t>(duration_s * rate_hz);
  AxisBlocks blocks(2);
  for (std::uint64_t begin = 0; begin < count; begin += kBlock) {
    parallel_for(2, options.threads, [&](std::size_t a) {
      for (std::uint64_t i = begin; i < std::min(begin + kBlock, count); ++i) {
        const AxisNormals normals = axes[a].normals(i);
        blocks[a].push_back(axes[a].read(0.0, axes[a].bias(), normals.white, std::sqrt(rate_hz)));
        axes[a].advance(i, normals.walk, 1.0 / rate_hz);
      }
    });
    push(analyzer, blocks);
    poll_interrupt();
  }
  return analyzer.finish(rate_hz);
}

}  // namespace vispline::cli
