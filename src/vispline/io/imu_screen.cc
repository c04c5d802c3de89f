#include "vispline/io/imu_screen.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "vispline/io/read_end.h"

namespace vispline {

ImuScreen::ImuScreen(ReadContext& context, ImuSink sink, const ImuAxes& axes, std::size_t window)
    : context_(context),
      sink_(std::move(sink)),
      axes_(axes),
      stamps_(
          context, [this](std::span<const SensorRow> rows) { take(rows); }, window),
      imu_(context, axes),
      rate_(context) {}

void ImuScreen::push(std::int64_t ns, const ImuSample& sample, std::int64_t where, bool scientific) {
  SensorRow row{.ns = ns, .where = where, .scientific = scientific};
  std::copy_n(sample.gyro.data(), 3, row.values.begin());
  std::copy_n(sample.accel.data(), 3, row.values.begin() + 3);
  stamps_.push(row);
}

void ImuScreen::flush() {
  stamps_.flush();
  release(true);
}

bool ImuScreen::is_finite(const SensorRow& row) const {
  for (std::size_t axis = 0; axis < kImuAxes; ++axis) {
    if (axes_.present[axis] && !std::isfinite(row.values[axis])) return false;
  }
  return true;
}

void ImuScreen::take(std::span<const SensorRow> rows) {
  for (const SensorRow& row : rows) {
    if (!is_finite(row)) {
      if (nonfinite_++ == 0) first_nonfinite_ = row.where;
      context_.drop("W-NONFINITE", "a value is nan or inf", context_.where_line(row.where));
      continue;
    }
    time_.push_back(time_from_ns(row.ns));
    sample_.push_back(
        {Vector3d(row.values[0], row.values[1], row.values[2]), Vector3d(row.values[3], row.values[4], row.values[5])});
    where_.push_back(row.where);
  }
  release(false);
}

/// Hands on all samples whose neighbours are known; two stay behind as the neighbours of the next ones.
void ImuScreen::release(bool last) {
  const std::size_t size = sample_.size();
  largest_ = std::max(largest_, size);
  hand_on_without_spikes(last ? size : size - std::min<std::size_t>(size, 1));
  const auto gone = static_cast<std::ptrdiff_t>(size - std::min<std::size_t>(size, 2));
  time_.erase(time_.begin(), time_.begin() + gone);
  sample_.erase(sample_.begin(), sample_.begin() + gone);
  where_.erase(where_.begin(), where_.begin() + gone);
  done_ = last ? sample_.size() : sample_.size() - std::min<std::size_t>(sample_.size(), 1);
}

void ImuScreen::hand_on_without_spikes(std::size_t stop) {
  std::size_t begin = done_;
  for (const std::size_t spike : find_spikes(sample_, axes_)) {
    if (spike < done_ || spike >= stop) continue;
    context_.drop("W-SPIKE", "one sample stands far off while its neighbours agree",
                  context_.where_line(where_[spike]));
    hand_on(begin, spike);
    begin = spike + 1;
  }
  hand_on(begin, stop);
}

void ImuScreen::hand_on(std::size_t begin, std::size_t end) {
  if (begin >= end) return;
  for (std::size_t i = begin; i < end; ++i) rate_.add(to_ns(time_[i]), where_[i]);
  const std::span<const ImuSample> samples = std::span<const ImuSample>(sample_).subspan(begin, end - begin);
  imu_.add(samples);
  context_.counts.kept += static_cast<std::int64_t>(samples.size());
  sink_(std::span<const Time>(time_).subspan(begin, end - begin), samples);
}

void ImuScreen::judge_nonfinite() const {
  if (!context_.too_many(nonfinite_)) return;
  context_.fail(ExitCode::kUnfit, "E-NONFINITE",
                percent(context_.share(nonfinite_)) + " of the " + context_.noun() + " are nan or inf",
                context_.where_line(first_nonfinite_), "pass --repair to leave these rows out");
}

void ImuScreen::finish(double unit_ns) {
  stamps_.judge(unit_ns);
  judge_nonfinite();
  if (context_.counts.kept == 0) fail_none_left(context_);
  imu_.judge();
  rate_.judge();
  check_strict(context_);
}

}  // namespace vispline
