#include "vispline/estimate/problem.h"

#include <algorithm>
#include <tuple>

#include "vispline/core/parallel.h"

namespace vispline {
namespace {

constexpr std::size_t kWhitenChunk = 64;

void in_chunks(std::size_t count, std::size_t threads, const std::function<void(std::size_t)>& work) {
  parallel_for((count + kWhitenChunk - 1) / kWhitenChunk, threads, [&](std::size_t chunk) {
    for (std::size_t i = chunk * kWhitenChunk; i < std::min(count, (chunk + 1) * kWhitenChunk); ++i) work(i);
  });
}

}  // namespace

void whiten_measurements(Problem& problem, const State& state, std::size_t threads) {
  in_chunks(problem.measurements.size(), threads, [&](std::size_t m) { problem.measurements[m]->whiten(state); });
}

void whiten(Problem& problem, const State& state, std::size_t threads) {
  whiten_measurements(problem, state, threads);
  in_chunks(problem.tracks.size(), threads, [&](std::size_t t) { whiten(state, problem.tracks[t]); });
}

Columns assign_columns(const State& state, std::vector<Parameter>& parameters) {
  Columns columns;
  Layout& layout = columns.layout;
  std::vector<std::tuple<Time, int*>> in_time;
  layout.knot.resize(state.curve->knots());
  for (std::size_t k = 0; k < layout.knot.size(); ++k) in_time.emplace_back(state.curve->knot_time(k), &layout.knot[k]);
  layout.bias.resize(state.bias_walks.size());
  for (std::size_t i = 0; i < state.bias_walks.size(); ++i) {
    const BiasWalk& walk = state.bias_walks[i];
    layout.bias[i].resize(walk.node.size());
    for (std::size_t n = 0; n < walk.node.size(); ++n) {
      in_time.emplace_back(walk.begin + static_cast<std::int64_t>(n) * walk.spacing, &layout.bias[i][n]);
    }
  }
  std::stable_sort(in_time.begin(), in_time.end(),
                   [](const auto& a, const auto& b) { return std::get<0>(a) < std::get<0>(b); });
  for (const auto& [time, column] : in_time) {
    *column = layout.columns;
    layout.columns += 6;
  }
  layout.first_parameter = layout.columns;
  for (Parameter& parameter : parameters) {
    const bool fixed = parameter.treatment.role == Role::kFixed;
    parameter.column = fixed ? -1 : layout.columns;
    if (!fixed) layout.columns += parameter.size;
  }
  columns.parameters = columns_of(state, parameters);
  return columns;
}

State moved(const State& state, const Columns& columns, const std::vector<Parameter>& parameters,
            const Eigen::VectorXd& delta, const Problem& problem, const std::vector<Vector3d>& delta_landmark) {
  State next = state;
  std::vector<Vector6d> knots(columns.layout.knot.size());
  for (std::size_t k = 0; k < knots.size(); ++k) knots[k] = delta.segment<6>(columns.layout.knot[k]);
  next.curve->retract(knots);
  for (std::size_t i = 0; i < columns.layout.bias.size(); ++i) {
    for (std::size_t n = 0; n < columns.layout.bias[i].size(); ++n) {
      next.bias_walks[i].node[n] += delta.segment<6>(columns.layout.bias[i][n]);
    }
  }
  for (const Parameter& parameter : parameters) {
    if (parameter.column >= 0) parameter.move(next, delta.segment(parameter.column, parameter.size));
  }
  for (std::size_t t = 0; t < problem.tracks.size(); ++t) {
    InverseDepthLandmark& landmark = next.landmarks[problem.tracks[t].landmark];
    landmark = moved(landmark, problem.track_model, delta_landmark[t]);
    if (problem.track_model.unknowns == LandmarkUnknowns::kPoint) continue;
    const Sighting& reference = problem.tracks[t].sightings.front();
    const auto ray = next.rig.cameras[reference.camera].lens.unproject(reference.px);
    if (ray) landmark.bearing_c = *ray;
  }
  return next;
}

}  // namespace vispline
