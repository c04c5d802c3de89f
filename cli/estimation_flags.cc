#include "estimation_flags.h"

#include <cstdio>
#include <iostream>
#include <map>

#include "validators.h"
#include "vispline/core/parallel.h"

namespace vispline::cli {
namespace {

/// Noise of a usual MEMS sensor, where nothing is known: the residuals then tell.
constexpr double kUsualGyroNoise = 2e-4, kUsualAccelNoise = 3e-3;

[[noreturn]] void usage(const std::string& message, const std::string& next) {
  throw Error(ExitCode::kUsage, {"E-ARGUMENT", message, "", "nothing estimated", next});
}

std::pair<std::string, std::string> split_at_equals(const std::string& text, const char* flag) {
  const std::size_t at = text.find('=');
  if (at == std::string::npos || at == 0 || at + 1 == text.size()) {
    usage(std::string(flag) + " " + vispline::quoted(text) + " has no NAME=VALUE", "write it as in the help");
  }
  return {text.substr(0, at), text.substr(at + 1)};
}

/// The names of results and of Kalibr: T_c_i and T_cam_imu are T_c_b, for the body is the first IMU.
std::string core_name(std::string name) {
  for (const std::string alias : {"T_cam_imu", "T_c_i"}) {
    const std::size_t at = name.find(alias);
    if (at != std::string::npos) name.replace(at, alias.size(), "T_c_b");
  }
  const std::map<std::string, std::string> words{{"gravity", "gravity.direction"}};
  const auto found = words.find(name);
  return found == words.end() ? name : found->second;
}

double number(const std::string& text, const char* flag) {
  std::size_t end = 0;
  double value = 0.0;
  try {
    value = std::stod(text, &end);
  } catch (const std::exception&) {
    end = 0;
  }
  if (end != text.size() || !(value > 0.0))
    usage(std::string(flag) + " needs a positive number, not " + vispline::quoted(text), "");
  return value;
}

}  // namespace

void EstimationFlags::add_to(CLI::App& verb) {
  verb.add_option("recording", recording, "bag, folder or table with the IMU")->required();
  verb.add_option("--rig", rig,
                  "start values: our rig file, or files of Kalibr, OpenVINS, VINS-Fusion, ORB-SLAM3, Basalt")
      ->delimiter(',');
  verb.add_option("--imu", imu, "NAME=FILE: recording of one more IMU of the rig");
  verb.add_option("--free", free, "parameters to estimate: cam0.intrinsics, cam*.time_offset, imu0, ...")
      ->delimiter(',');
  verb.add_option("--fix", fix, "parameters to hold")->delimiter(',');
  verb.add_option("--prior", prior, "NAME=SIGMA: estimated, but near the start value")->delimiter(',');
  verb.add_option("--spline", spline, "se3: joint; split: R3 x SO3")->check(CLI::IsMember({"se3", "split"}));
  verb.add_option("--order", order, "of the spline")->check(CLI::Range(4, 6));
  verb.add_option("--knot-spacing", spacing, "[s], or auto: from the spectrum of the IMU");
  verb.add_option("--bias-walk", bias_walk_s,
                  "[s] biases walk as the rig says, with a node every so many seconds; constant otherwise")
      ->check(positive());
  verb.add_option("--gravity", gravity, "[m/s^2]")->check(positive());
  verb.add_option("--huber", huber, "residuals beyond so many sigmas are weighed down; 0: least squares");
  verb.add_option("--noise", noise, "residuals: sizes of the noise found; rig: as the rig has them")
      ->check(CLI::IsMember({"residuals", "rig"}));
  verb.add_option("--max-iterations", max_iterations, "of the last stage")->check(CLI::Range(1, 10000));
  verb.add_option("--truth", truth, "poses of the body to compare the trajectory with");
  verb.add_option("--truth-rig", truth_rig, "rig to show beside the estimate");
  verb.add_option("--twin", twin, "simulate and estimate so many twins, and compare their scatter with the sigmas");
  verb.add_option("--jackknife", jackknife, "sigmas from how far so many blocks of time pull the result");
  verb.add_option("--threads", threads, "0: all of the machine");
  verb.add_option("--out", out, "folder for result.json, trajectory.tum, rig.yaml, report.html")
      ->required()
      ->check(not_empty());
  verb.add_flag("-v,--verbose", verbose, "one row for every iteration");
  read.add_to(verb);
  add_session_flags(verb, session);
}

RigDocument EstimationFlags::load_rig() {
  RigDocument document;
  if (rig.empty()) {
    document.rig.imus.resize(1);
    document.rig.imus[0].noise.gyro.white = kUsualGyroNoise;
    document.rig.imus[0].noise.accel.white = kUsualAccelNoise;
    return document;
  }
  ReadRig loaded = read_rig(rig);
  session.add(loaded.diagnostics);
  document = {std::move(loaded.rig), loaded.g_w, std::move(loaded.estimate), std::move(loaded.clocks)};
  if (document.rig.imus.empty()) {
    Imu usual;
    usual.noise.gyro.white = kUsualGyroNoise;
    usual.noise.accel.white = kUsualAccelNoise;
    document.rig.imus.push_back(usual);
  }
  return document;
}

void EstimationFlags::read_imus(const Rig& rig_of, Recording& recorded) {
  std::map<std::string, std::string> file;
  for (const std::string& argument : imu) {
    const auto [name, path] = split_at_equals(argument, "--imu");
    file[name] = path;
  }
  for (std::size_t i = 0; i < rig_of.imus.size(); ++i) {
    const std::string& name = rig_of.imus[i].name;
    ReadOptions options = read.options(0, session);
    if (options.topic.empty() && rig_of.imus.size() > 1) options.topic = name;
    const auto own = file.find(name);
    if (own != file.end()) options.topic.clear();
    auto samples = read_imu(own == file.end() ? recording : own->second, options);
    session.add_input(name, samples.counts, samples.diagnostics);
    recorded.imus[name] = std::move(samples.value);
  }
}

Treatments EstimationFlags::treatments(const RigDocument& document) const {
  Treatments list;
  for (const auto& [name, choice] : document.estimate) {
    const Role role = choice.kind == ParameterChoice::Kind::kFree    ? Role::kFree
                      : choice.kind == ParameterChoice::Kind::kFixed ? Role::kFixed
                                                                     : Role::kPrior;
    list.push_back({core_name(name), {role, choice.sigma}});
  }
  for (const std::string& name : free) list.push_back({core_name(name), {Role::kFree}});
  for (const std::string& name : fix) list.push_back({core_name(name), {Role::kFixed}});
  for (const std::string& argument : prior) {
    const auto [name, sigma] = split_at_equals(argument, "--prior");
    list.push_back({core_name(name), {Role::kPrior, number(sigma, "--prior")}});
  }
  return list;
}

CurveShape EstimationFlags::curve(double auto_spacing_s) const {
  return {spline == "se3" ? SplineKind::kJoint : SplineKind::kSplit, order,
          from_seconds(spacing == "auto" ? auto_spacing_s : number(spacing, "--knot-spacing"))};
}

double EstimationFlags::gravity_of(const RigDocument& document) const {
  return gravity ? *gravity : document.g_w.norm();
}

std::optional<Duration> EstimationFlags::bias_walk() const {
  return bias_walk_s ? std::optional(from_seconds(*bias_walk_s)) : std::nullopt;
}

SolveOptions EstimationFlags::solve_options() {
  SolveOptions options;
  options.max_iterations = max_iterations;
  options.threads = threads == 0 ? hardware_threads() : threads;
  options.progress = [this](const IterationRow& row) {
    if (verbose) {
      char text[160];
      std::snprintf(text, sizeof text, "%4d  cost %.6e  decrease %.3e  promised %.3e  lambda %.1e%s\n", row.iteration,
                    row.cost, row.decrease, row.predicted, row.lambda, row.accepted ? "" : "  refused");
      std::cerr << text;
    }
    try {
      poll_interrupt();
    } catch (const Interrupted&) {
      interrupted_ = true;
      return false;
    }
    return true;
  };
  return options;
}

std::pair<std::string, std::string> camera_and_file(const std::string& argument, const Rig& rig) {
  if (argument.find('=') != std::string::npos) {
    auto pair = split_at_equals(argument, "a file of features");
    if (find_camera(rig, pair.first) != nullptr) return pair;
    std::string names;
    for (const Camera& camera : rig.cameras) names += (names.empty() ? "" : ", ") + camera.name;
    usage("the rig has no camera " + vispline::quoted(pair.first), "its cameras: " + names);
  }
  if (rig.cameras.size() == 1) return {rig.cameras.front().name, argument};
  usage("which camera " + vispline::quoted(argument) + " belongs to is not said", "write CAM=FILE");
}

}  // namespace vispline::cli
