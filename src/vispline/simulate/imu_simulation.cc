#include "vispline/simulate/imu_simulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ranges>
#include <string>

#include "vispline/core/error.h"
#include "vispline/core/parallel.h"
#include "vispline/simulate/axis_noise.h"

namespace vispline {
namespace {

constexpr std::size_t kChunk = 256;  // samples of one task
constexpr std::size_t kAxes = 6;     // gyroscope x y z, accelerometer x y z

/// Half-open range of indices into the stamps.
struct IndexRange {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t size() const { return end - begin; }
};

double& axis_of(ImuSample& sample, std::size_t axis) {
  const auto i = static_cast<Eigen::Index>(axis % 3);
  return axis < 3 ? sample.gyro[i] : sample.accel[i];
}

/// Appends `more`, which holds as many entries in every member.
void append(SimulatedImu& all, const SimulatedImu& more) {
  const auto join = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  join(all.measured.time, more.measured.time);
  join(all.measured.value, more.measured.value);
  join(all.exact, more.exact);
  join(all.bias, more.bias);
  join(all.body.time, more.body.time);
  join(all.body.value, more.body.value);
}

template <class Function>
void for_each_member(SimulatedImu& samples, const Function& function) {
  function(samples.measured.time);
  function(samples.measured.value);
  function(samples.exact);
  function(samples.bias);
  function(samples.body.time);
  function(samples.body.value);
}

class Simulator {
 public:
  Simulator(const Trajectory& trajectory, const ImuSimulation& simulation, const Stamps& stamps)
      : trajectory_(trajectory),
        simulation_(simulation),
        stamps_(stamps),
        gyro_offset_(from_seconds(simulation.imu.gyroscope.time_offset_s)),
        accel_offset_(from_seconds(simulation.imu.accelerometer.time_offset_s)) {
    const auto add_axes = [&](std::string_view triad, const NoiseModel& model) {
      for (const char* axis : {"/x", "/y", "/z"}) {
        noise_.emplace_back(model, simulation.seed, simulation.imu.name + "/" + std::string(triad) + axis);
      }
    };
    add_axes(Gyroscope::kName, simulation.imu.noise.gyro);
    add_axes(Accelerometer::kName, simulation.imu.noise.accel);
  }

  /// Stamps at which the trajectory is defined; it is defined on an interval, so they are consecutive.
  IndexRange inside() const {
    const Duration earliest = std::min(gyro_offset_, accel_offset_), latest = std::max(gyro_offset_, accel_offset_);
    const TimeSpan span = trajectory_.span();
    const auto index = std::views::iota(std::size_t{0}, stamps_.size());
    const auto begin = std::ranges::partition_point(
        index, [&](std::size_t i) { return body_time(stamps_[i]) + earliest < span.begin; });
    const auto end =
        std::ranges::partition_point(index, [&](std::size_t i) { return body_time(stamps_[i]) + latest <= span.end; });
    const auto first = static_cast<std::size_t>(begin - index.begin()),
               last = static_cast<std::size_t>(end - index.begin());
    return {first, std::max(first, last)};
  }

  /// Fills `block` with the samples of `range`; ranges come in order, because the bias moves on from one to the next.
  void simulate(IndexRange range, SimulatedImu& block) {
    for_each_member(block, [&](auto& member) { member.resize(range.size()); });
    normals_.resize(range.size());
    const std::size_t chunks = (range.size() + kChunk - 1) / kChunk;
    const auto for_each_sample = [&](auto&& work) {
      parallel_for(chunks, simulation_.threads, [&](std::size_t chunk) {
        const std::size_t end = std::min(range.size(), (chunk + 1) * kChunk);
        for (std::size_t i = chunk * kChunk; i < end; ++i) work(range.begin + i, i);
      });
    };
    for_each_sample([&](std::size_t index, std::size_t i) { measure(index, i, block); });
    parallel_for(kAxes, simulation_.threads, [&](std::size_t axis) { move_bias(axis, range, block); });
    for_each_sample([&](std::size_t index, std::size_t i) { add_noise(index, i, block); });
  }

 private:
  /// On the body's clock, but for the time offset.
  Time body_time(Time stamp) const {
    return stamp + from_seconds(simulation_.clock_drift * to_seconds(stamp - simulation_.clock_start));
  }

  /// Exact reading of sample `index`, and the numbers that its noise will need.
  void measure(std::size_t index, std::size_t i, SimulatedImu& block) {
    const Imu& imu = simulation_.imu;
    const Time stamp = stamps_[index], time = body_time(stamp);
    const BodyState body = trajectory_.at(time + gyro_offset_).value();
    block.measured.time[i] = stamp;
    block.body.time[i] = time + gyro_offset_;
    block.body.value[i] = body;
    block.exact[i].gyro = Gyroscope::predict(body, imu.gyroscope, simulation_.g_w);
    block.exact[i].accel =
        Accelerometer::predict(accel_offset_ == gyro_offset_ ? body : trajectory_.at(time + accel_offset_).value(),
                               imu.accelerometer, simulation_.g_w);
    for (std::size_t axis = 0; axis < kAxes; ++axis) normals_[i][axis] = noise_[axis].normals(index);
  }

  void move_bias(std::size_t axis, IndexRange range, SimulatedImu& block) {
    AxisNoise& noise = noise_[axis];
    for (std::size_t i = 0; i < range.size(); ++i) {
      axis_of(block.bias[i], axis) = noise.bias();
      noise.advance(range.begin + i, normals_[i][axis].walk, stamps_.step(range.begin + i));
    }
  }

  void add_noise(std::size_t index, std::size_t i, SimulatedImu& block) const {
    ImuSample& bias = block.bias[i];
    ImuSample& measured = block.measured.value[i];
    measured = block.exact[i];
    const double inverse_sqrt_time = 1.0 / std::sqrt(stamps_.averaging_time(index));
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
      double& value = axis_of(measured, axis);
      value = noise_[axis].read(value, axis_of(bias, axis), normals_[i][axis].white, inverse_sqrt_time);
    }
    bias.gyro += simulation_.imu.gyroscope.bias;
    bias.accel += simulation_.imu.accelerometer.bias;
  }

  const Trajectory& trajectory_;
  const ImuSimulation& simulation_;
  const Stamps& stamps_;
  Duration gyro_offset_, accel_offset_;
  std::vector<AxisNoise> noise_;
  std::vector<std::array<AxisNormals, kAxes>> normals_;
};

void check_inside(const ImuSimulation& simulation, const Stamps& stamps, IndexRange inside, TimeSpan span) {
  const std::size_t outside = stamps.size() - inside.size();
  if (inside.size() > 0 && (outside == 0 || simulation.outside == OutsideSpan::kSkip)) return;
  throw Error(
      ExitCode::kUnfit,
      {.code = "E-SPAN",
       .message = std::to_string(outside) + " of " + std::to_string(stamps.size()) + " samples of IMU " +
                  quoted(simulation.imu.name) + ", stamped " + std::to_string(to_ns(stamps[0])) + " to " +
                  std::to_string(to_ns(stamps[stamps.size() - 1])) + " ns, lie outside the trajectory, which spans " +
                  std::to_string(to_ns(span.begin)) + " to " + std::to_string(to_ns(span.end)) + " ns",
       .where = "",
       .effect = "nothing simulated",
       .next = "choose a start and a duration inside the trajectory, or let samples outside be skipped"});
}

}  // namespace

std::size_t simulate_imu(const Trajectory& trajectory, const ImuSimulation& simulation, const Stamps& stamps,
                         const SimulationSink& sink) {
  require_valid(simulation.imu);
  require(simulation.g_w.allFinite(), "a finite gravity vector");
  require(std::abs(simulation.clock_drift) < 0.01, "a clock drift below 0.01 s/s");
  require(simulation.block_size > 0, "a block size of at least 1 sample");
  Simulator simulator(trajectory, simulation, stamps);
  const IndexRange inside = simulator.inside();
  check_inside(simulation, stamps, inside, trajectory.span());
  SimulatedImu block;
  for (std::size_t begin = inside.begin; begin < inside.end; begin += simulation.block_size) {
    simulator.simulate({begin, std::min(inside.end, begin + simulation.block_size)}, block);
    sink(block);
  }
  return stamps.size() - inside.size();
}

SimulatedImu simulate_imu(const Trajectory& trajectory, const ImuSimulation& simulation, const Stamps& stamps) {
  SimulatedImu all;
  for_each_member(all, [&](auto& member) { member.reserve(stamps.size()); });
  all.outside = simulate_imu(trajectory, simulation, stamps, [&](const SimulatedImu& block) { append(all, block); });
  return all;
}

}  // namespace vispline
