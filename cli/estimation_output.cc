#include "estimation_output.h"

#include <filesystem>
#include <iostream>

#include "result_folder.h"
#include "vispline/estimate/assess.h"
#include "vispline/estimate/jackknife.h"
#include "vispline/estimate/twin.h"
#include "vispline/report/calibration_section.h"
#include "vispline/results/calibration_documents.h"

namespace vispline::cli {
namespace {

constexpr double kCourseRate_hz = 100.0;

Signal<Pose> poses_of(const Signal<GroundTruth>& course) {
  Signal<Pose> poses;
  for (std::size_t i = 0; i < course.size(); ++i) poses.push_back(course.time[i], course.value[i].T_w_b);
  return poses;
}

std::string stem(const std::string& path) {
  const std::string name = std::filesystem::path(path).filename().string();
  const std::string part = name.substr(0, name.find('.'));
  return part.empty() ? "result" : part;
}

/// The truth's rig in place of the estimate's, as far as somebody knows it.
std::optional<State> truth_of(EstimationFlags& flags, const Solution& solution) {
  if (flags.truth_rig.empty()) return std::nullopt;
  ReadRig truth = read_rig({flags.truth_rig});
  flags.session.add(truth.diagnostics);
  State state = solution.state;
  state.rig = std::move(truth.rig);
  return state;
}

void add_stages(const Estimation& estimation, CalibrationResult& result) {
  for (const Stage& stage : estimation.stages) {
    result.stages.push_back({stage.name, stage.value, stage.limit, stage.unit, stage.passed, stage.measure});
  }
}

void compare(EstimationFlags& flags, const Signal<Pose>& poses, CalibrationResult& result,
             report::CalibrationCourse& course) {
  course.T_w_b = poses;
  if (flags.truth.empty() || flags.interrupted()) return;
  auto truth = read_trajectory(flags.truth, flags.read.options(1, flags.session));
  flags.session.add_input("truth", truth.counts, truth.diagnostics);
  result.trajectory = compare_trajectories(poses, truth.value);
  const Alignment& alignment = result.trajectory->alignment;
  for (std::size_t i = 0; i < truth.value.size(); ++i) {
    const Pose& T_r_b = truth.value.value[i];
    const Matrix3d R_e_r = alignment.R_r_e.transpose();
    course.truth_T_w_b.push_back(truth.value.time[i], {R_e_r * T_r_b.R, R_e_r * (T_r_b.p - alignment.p_r_e)});
  }
}

}  // namespace

void finish_estimation(EstimationFlags& flags, const Estimation& estimation, const RigDocument& start,
                       const std::string& spacing_reason) {
  const Solution& solution = estimation.solution;
  const std::optional<State> truth = truth_of(flags, solution);
  State first = estimation.problem.start;
  first.rig = start.rig;
  AssessOptions options;
  options.threads = flags.solve_options().threads;
  options.start = &first;
  options.truth = truth ? &*truth : nullptr;
  CalibrationResult result = assess(estimation.problem, solution, options);
  result.diagnostics.merge(estimation.diagnostics);
  add_stages(estimation, result);
  result.cpu_s = estimation.cpu_s;
  result.knots = {to_seconds(solution.state.curve->spacing()), solution.state.curve->order(),
                  solution.state.curve->kind() == SplineKind::kJoint ? "se3" : "split", spacing_reason};
  if (solution.covariance.size() > 0 && !flags.interrupted()) {
    if (flags.jackknife > 1)
      result.jackknife = jackknife(estimation.problem, solution, {flags.jackknife, options.threads});
    if (flags.twin > 0) result.twin = twin(estimation.problem, solution, {flags.twin, 1, options.threads});
  }
  ResultFolder folder;
  folder.folder = flags.out;
  folder.name = stem(flags.recording);
  folder.rig = {solution.state.rig, solution.state.g_w, start.estimate, start.clocks};
  folder.course = course_of(solution.state, kCourseRate_hz);
  report::CalibrationCourse course;
  compare(flags, poses_of(folder.course), result, course);
  folder.json = calibration_json(result, flags.session.context);
  folder.page = report::calibration_page(result, course, "Estimation from " + stem(flags.recording),
                                         {.version = flags.session.context.version});
  flags.session.finish(result.diagnostics);
  for (const std::string& note : write_result_folder(folder, result, output_options(flags.session))) {
    std::cerr << "note: " << note << '\n';
  }
  std::cout << (flags.session.json ? folder.json : calibration_text(result));
  std::cerr << "report: " << flags.out << "/report.html\n";
  if (const int code = exit_code_of(result.result_class); code != 0) throw ExitWith{code};
}

}  // namespace vispline::cli
