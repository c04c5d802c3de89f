#include "flags.h"

#include <algorithm>
#include <filesystem>

#include "validators.h"
#include "vispline/core/parallel.h"
#include "vispline/io/number_text.h"
#include "vispline/results/table.h"
#include "vispline/trajectory/analytic.h"

namespace vispline::cli {
namespace {

constexpr double kDefaultDuration_s = 20.0;
/// Start + duration stays within the 292 years of int64 nanoseconds.
constexpr double kMaxStart_s = 8e9;

std::string nth(const std::vector<std::string>& values, std::size_t index) {
  if (values.empty()) return "";
  const std::string& value = values[std::min(index, values.size() - 1)];
  return value == "auto" ? "" : value;
}

/// 0 for none.
double rate_of(const std::string& text) {
  double rate_hz = 0.0;
  const bool is_number = text.empty() || parse_double(text, rate_hz) == NumberStatus::kOk;
  require(is_number && (text.empty() || (rate_hz > 0.0 && rate_hz <= kMaxRate_hz)),
          "--rate above 0 Hz, at most 1e8 Hz");
  return rate_hz;
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

void add_triad(CLI::App& verb, const std::string& name, const std::string& unit, ImuFlags::Triad& triad) {
  const auto flag = [&](const std::string& what, std::optional<double>& value, const std::string& help) {
    verb.add_option("--" + name + "-" + what, value, help)->check(not_negative())->group("Noise");
  };
  flag("white", triad.white, "white-noise density [" + unit + "/sqrt(Hz)]");
  flag("walk", triad.walk, "bias random walk [" + unit + "/s/sqrt(Hz)]");
  flag("bias-instability", triad.bias_instability, "flicker coefficient B [" + unit + "]");
  flag("turn-on-bias", triad.turn_on_bias, "standard deviation of the first bias [" + unit + "]");
  flag("quantum", triad.quantum, "least significant bit [" + unit + "]");
  flag("range", triad.range, "saturation at +- this value [" + unit + "]");
}

NoiseModel with(NoiseModel model, const ImuFlags::Triad& triad) {
  return {triad.white.value_or(model.white),
          triad.walk.value_or(model.walk),
          triad.bias_instability.value_or(model.bias_instability),
          triad.turn_on_bias.value_or(model.turn_on_bias),
          triad.quantum.value_or(model.quantum),
          triad.range.value_or(model.range)};
}

/// The densities of the course's simulator.
ImuNoise preset(const std::string& name) {
  if (name == "none") return {};
  return {.gyro = {.white = 0.015, .walk = 1e-5}, .accel = {.white = 0.019, .walk = 1e-4}};
}

}  // namespace

void add_session_flags(CLI::App& verb, Session& session) {
  verb.add_flag("--json", session.json, "write the result as JSON to stdout");
  verb.add_flag("--strict", session.strict, "the first warning is an error");
  verb.add_flag("-f,--force", session.force, "replace files that exist");
}

OutputOptions output_options(const Session& session) { return {.force = session.force}; }

void ReadFlags::add_to(CLI::App& verb) {
  const auto flag = [&](const char* name, std::vector<std::string>& values, const char* help) {
    verb.add_option(name, values, std::string(help) + "; once for all inputs or once for each")
        ->take_all()
        ->expected(1)
        ->group("Reading");
  };
  flag("--topic", topic, "topic of a recording, or sensor of an EuRoC folder; the only one that fits otherwise");
  flag("--gyro-topic", gyro_topic, "topic of a gyroscope that stands alone, goes with --accel-topic");
  flag("--accel-topic", accel_topic, "topic of the accelerometer that goes with --gyro-topic");
  flag("--time", time, "header: stamps of the messages (the default), or receive: when the recorder got them");
  flag("--input-format", format, "format of the input, found from its content otherwise");
  flag("--columns", columns, "names of the columns, such as t,gx,gy,gz,ax,ay,az");
  flag("--time-unit", time_unit, "s, ms, us, ns or index@RATE with RATE in Hz, such as 200 or 2000/7");
  flag("--rate", rate, "[Hz] of a file without times: its rows are samples from t = 0");
  flag("--gyro-unit", gyro_unit, "rad/s, deg/s or deg/h");
  flag("--accel-unit", accel_unit, "m/s^2, g or mg");
  flag("--imu-axes", imu_axes, "axis of each channel of a GoPro, small for a turned sign, such as YxZ");
  flag("--decimal", decimal, "decimal sign, . or ,");
  verb.add_flag("--skip-bad-rows", skip_bad_rows, "leave out up to 0.1 % of malformed rows")->group("Reading");
  verb.add_flag("--repair", repair, "leave out or sort more rows than the usual 1 %")->group("Reading");
}

ReadOptions ReadFlags::options(std::size_t index, const Session& session) const {
  const std::string sign = nth(decimal, index);
  require(sign.empty() || sign == "." || sign == ",", "--decimal . or ,");
  const std::string clock = nth(time, index);
  require(clock.empty() || clock == "header" || clock == "receive", "--time header or receive");
  return {.format = nth(format, index),
          .columns = nth(columns, index),
          .time_unit = nth(time_unit, index),
          .rate_hz = rate_of(nth(rate, index)),
          .gyro_unit = nth(gyro_unit, index),
          .accel_unit = nth(accel_unit, index),
          .imu_axes = nth(imu_axes, index),
          .decimal = sign.empty() ? '.' : sign[0],
          .topic = nth(topic, index),
          .gyro_topic = nth(gyro_topic, index),
          .accel_topic = nth(accel_topic, index),
          .clock = clock == "receive" ? StampClock::kReceive : StampClock::kHeader,
          .skip_bad_rows = skip_bad_rows,
          .repair = repair,
          .strict = session.strict};
}

void TrajectoryFlags::add_to(CLI::App& verb) {
  verb.add_option("--trajectory", source, joined(analytic_names()) + ", or a file of poses")->required();
  verb.add_option("--start", start_s, "time of the first sample [s], by default 0 or the first pose of the file")
      ->check(between(-kMaxStart_s, kMaxStart_s));
  verb.add_option("--duration", duration_s, "length [s], by default 20 or the length of the file")->check(positive());
  verb.add_option("--spline", spline, "kind of spline fitted to a file")
      ->check(CLI::IsMember({"joint", "split"}))
      ->capture_default_str()
      ->group("Spline fit");
  verb.add_option("--order", fit.order, "order of the spline, 4 is cubic")
      ->check(between(4, 6))
      ->capture_default_str()
      ->group("Spline fit");
  verb.add_option("--knot-spacing", fit.spacing_s, "[s], chosen from the spectrum of the poses otherwise")
      ->check(positive())
      ->group("Spline fit");
  verb.add_option("--quality", fit.quality, "share of the motion's energy the chosen knots carry")
      ->check(between(0.5, 0.9999999))
      ->group("Spline fit");
}

TrajectorySource load_trajectory(const TrajectoryFlags& flags, const ReadFlags& read, Session& session) {
  const Time start = Time{} + from_seconds(flags.start_s.value_or(0.0));
  const Duration duration = from_seconds(flags.duration_s.value_or(kDefaultDuration_s));
  if (auto analytic = analytic_trajectory(flags.source, start, duration)) return {*analytic, std::nullopt};
  if (!std::filesystem::exists(flags.source)) {
    throw Error(ExitCode::kInput, {.code = "E-OPEN",
                                   .message = "no trajectory " + vispline::quoted(flags.source),
                                   .where = "--trajectory",
                                   .effect = "nothing written",
                                   .next = "give a file of poses or one of " + joined(analytic_names())});
  }
  auto poses = read_trajectory(flags.source, read.options(0, session));
  session.add_input("trajectory", poses.counts, poses.diagnostics);
  TrajectoryFitOptions options = flags.fit;
  options.kind = flags.spline == "joint" ? SplineKind::kJoint : SplineKind::kSplit;
  options.poll = poll_interrupt;
  TrajectoryFit fit = fit_trajectory(poses.value, options);
  if (!fit.converged) {
    session.add({.code = "W-FIT",
                 .message = "the spline fit stopped after " + std::to_string(fit.iterations) + " iterations",
                 .where = flags.source,
                 .effect = "the last iterate was used",
                 .next = "look at the residuals; choose another --knot-spacing"});
  }
  return {fit.trajectory, std::move(fit)};
}

std::string fit_text(const TrajectoryFit& fit) {
  std::string text = "spline: " + std::to_string(fit.knots) + " knots every " + number_text(1e3 * fit.spacing_s, 4) +
                     " ms, residual rms " + number_text(1e3 * fit.position_m.rms, 3) + " mm, " +
                     number_text(1e3 * fit.rotation_rad.rms, 3) + " mrad per axis (max " +
                     number_text(1e3 * fit.position_m.max, 3) + " mm, " + number_text(1e3 * fit.rotation_rad.max, 3) +
                     " mrad)\n";
  if (fit.spectrum) {
    text += "spectrum: motion up to " + number_text(fit.spectrum->translation.bandwidth_hz, 3) +
            " Hz in translation and " + number_text(fit.spectrum->rotation.bandwidth_hz, 3) +
            " Hz in rotation, above the noise of the poses; " + std::to_string(fit.gaps.size()) + " gaps, " +
            std::to_string(fit.outliers) + " outliers left out\n";
  }
  return text;
}

JsonObject fit_json(const TrajectoryFit& fit) {
  const auto residual = [](const FitResidual& r, const char* unit) {
    return JsonObject().set("rms_" + std::string(unit), r.rms).set("max_" + std::string(unit), r.max);
  };
  JsonObject object;
  object.set("knots", static_cast<std::int64_t>(fit.knots))
      .set("knot_spacing_s", fit.spacing_s)
      .set("position", residual(fit.position_m, "m"))
      .set("rotation", residual(fit.rotation_rad, "rad"))
      .set("iterations", fit.iterations)
      .set("converged", fit.converged)
      .set("gaps", static_cast<std::int64_t>(fit.gaps.size()))
      .set("outliers", static_cast<std::int64_t>(fit.outliers));
  if (!fit.spectrum) return object;
  const auto spectrum = [](const MotionSpectrum& s, const std::string& unit) {
    return JsonObject()
        .set("bandwidth_hz", s.bandwidth_hz)
        .set("noise_sigma_" + unit, s.noise_sigma)
        .set("jerk_density_" + unit + "_per_s3_sqrt_hz", s.jerk_density)
        .set("knot_spacing_s", s.spacing_s);
  };
  object.set("translation_spectrum", spectrum(fit.spectrum->translation, "m"));
  object.set("rotation_spectrum", spectrum(fit.spectrum->rotation, "rad"));
  return object;
}

void ImuFlags::add_to(CLI::App& verb) {
  verb.add_option("--noise", noise, "none, or course: 0.015, 1e-5 (gyroscope), 0.019, 1e-4 (accelerometer)")
      ->check(CLI::IsMember({"none", "course"}))
      ->capture_default_str()
      ->group("Noise");
  add_triad(verb, "gyro", "rad/s", gyro);
  add_triad(verb, "accel", "m/s^2", accel);
  verb.add_option("--gravity", gravity, "[m/s^2], pointing down")
      ->check(between(-1000.0, 1000.0))
      ->capture_default_str()
      ->group("Instrument");
  verb.add_option("--imu-position", position_m, "x,y,z of the IMU in the body [m]")
      ->delimiter(',')
      ->expected(3)
      ->check(between(-1e6, 1e6))
      ->group("Instrument");
  verb.add_option("--time-offset", time_offset_s, "t_body = t_imu + this [s]")
      ->check(between(-1e6, 1e6))
      ->group("Instrument");
  verb.add_option("--seed", seed, "of all random numbers")->check(not_negative(kMaxSeed))->capture_default_str();
  verb.add_option("--threads", threads, "0: all; does not change a byte of the result")
      ->check(not_negative(1024))
      ->capture_default_str();
}

ImuSimulation ImuFlags::simulation(const std::string& name, double rate_hz) const {
  ImuSimulation simulation;
  simulation.imu.name = name;
  simulation.imu.rate_hz = rate_hz;
  simulation.imu.noise = preset(noise);
  simulation.imu.noise.gyro = with(simulation.imu.noise.gyro, gyro);
  simulation.imu.noise.accel = with(simulation.imu.noise.accel, accel);
  const Vector3d p_b_i(position_m[0], position_m[1], position_m[2]);
  simulation.imu.gyroscope.T_b_i.p = simulation.imu.accelerometer.T_b_i.p = p_b_i;
  simulation.imu.gyroscope.time_offset_s = simulation.imu.accelerometer.time_offset_s = time_offset_s;
  simulation.g_w = Vector3d(0.0, 0.0, -gravity);
  simulation.seed = seed;
  simulation.threads = threads == 0 ? hardware_threads() : threads;
  return simulation;
}

}  // namespace vispline::cli
