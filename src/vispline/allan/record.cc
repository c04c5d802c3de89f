#include "vispline/allan/record.h"

#include <algorithm>

#include "vispline/core/parallel.h"

namespace vispline {

void AxisMoments::add(std::span<const double> readings) {
  for (const double reading : readings) {
    const double off = reading - first;
    sum += off;
    square += off * off;
    least = std::min(least, reading);
    most = std::max(most, reading);
  }
}

double AxisMoments::mean(std::int64_t n) const { return first + sum / static_cast<double>(n); }

double AxisMoments::standard_deviation(std::int64_t n) const {
  const auto count = static_cast<double>(n);
  return std::sqrt(std::max(0.0, (square - sum * sum / count) / (count - 1.0)));
}

AllanRecord::AllanRecord(std::size_t axes, const AllanOptions& options)
    : axes_(axes), memory_(options.memory), threads_(options.threads), spectra_(options.identify) {}

void AllanRecord::push(std::span<const std::span<const double>> blocks) {
  const std::size_t n = blocks.empty() ? 0 : blocks[0].size();
  if (n == 0) return;
  if (samples_ == 0) {
    for (std::size_t a = 0; a < axes_.size(); ++a) axes_[a].moments.first = blocks[a][0];
  }
  parallel_for(axes_.size(), threads_, [&](std::size_t a) { push_axis(axes_[a], blocks[a]); });
  samples_ += static_cast<std::int64_t>(n);
  open_ += static_cast<std::int64_t>(n);
  const bool too_long = memory_ == AllanMemory::kAuto && samples_ > kExactSamples;
  if (held_ && (too_long || memory_ == AllanMemory::kBounded)) let_go();
}

void AllanRecord::push_axis(Axis& axis, std::span<const double> block) const {
  axis.moments.add(block);
  if (spectra_) axis.spectrum.push(block);
  if (held_) {
    axis.readings.insert(axis.readings.end(), block.begin(), block.end());
  } else {
    axis.stream->push(block);
  }
}

/// From here on the readings are not held; those so far go the way the next ones will.
void AllanRecord::let_go() {
  held_ = false;
  parallel_for(axes_.size(), threads_, [&](std::size_t a) {
    Axis& axis = axes_[a];
    axis.stream.emplace(axis.moments.first);
    const std::span<const double> all(axis.readings);
    std::size_t done = 0;
    for (const std::int64_t length : lengths_) {
      axis.stream->push(all.subspan(done, static_cast<std::size_t>(length)));
      axis.stream->end_segment();
      done += static_cast<std::size_t>(length);
    }
    axis.stream->push(all.subspan(done));
    std::vector<double>().swap(axis.readings);
  });
}

void AllanRecord::cut() {
  if (open_ == 0) return;
  begins_.push_back(samples_ - open_);
  lengths_.push_back(open_);
  open_ = 0;
  parallel_for(axes_.size(), threads_, [&](std::size_t a) {
    if (spectra_) axes_[a].spectrum.end_segment();
    if (axes_[a].stream) axes_[a].stream->end_segment();
  });
}

std::int64_t AllanRecord::longest() const {
  return lengths_.empty() ? 0 : *std::max_element(lengths_.begin(), lengths_.end());
}

Phase AllanRecord::phase(std::size_t axis, std::size_t segment) const {
  const auto begin = static_cast<std::size_t>(begins_[segment]), length = static_cast<std::size_t>(lengths_[segment]);
  const auto readings = std::span(axes_[axis].readings).subspan(begin, length);
  return phase_of(readings, 1.0, axes_[axis].moments.mean(samples_));
}

}  // namespace vispline
