// The keys of every JSON document, in their order, and their row in docs/json.md.
#include <nlohmann/json.hpp>
#include <set>

#include "cli_inputs.h"
#include "vispline/io/write.h"

namespace vispline {
namespace {

using Json = nlohmann::ordered_json;
using Names = std::vector<std::string>;

const Names kReadKeys{"samples_read", "samples_kept", "samples_dropped", "inputs"};
const Names kDiagnosticKeys{"diagnostics", "diagnostic_counts"};

Names operator+(Names a, const Names& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Names keys(const Json& object) {
  Names names;
  for (const auto& item : object.items()) names.push_back(item.key());
  return names;
}

/// Keys at any depth; those of samples_dropped and diagnostic_counts are codes, not keys.
void collect(const Json& value, std::set<std::string>& names) {
  if (value.is_array()) {
    for (const Json& entry : value) collect(entry, names);
  }
  if (!value.is_object()) return;
  for (const auto& item : value.items()) {
    names.insert(item.key());
    if (item.key() != "samples_dropped" && item.key() != "diagnostic_counts") collect(item.value(), names);
  }
}

/// The names `in backquotes` in the first column of the tables of a section of docs/json.md, `; ` in the last
/// section of every document.
std::set<std::string> documented(const std::string& section) {
  const std::string page = file_bytes(std::string(VISPLINE_SOURCE_DIR) + "/docs/json.md");
  const std::size_t begin = page.find("\n## " + section + "\n");
  EXPECT_NE(begin, std::string::npos) << section;
  std::set<std::string> names;
  for (const std::string& line : lines(page.substr(begin, page.find("\n## ", begin + 4) - begin))) {
    if (!line.starts_with("| `")) continue;
    const std::string cell = line.substr(2, line.find(" |", 2) - 2);
    for (std::size_t open = cell.find('`'); open != std::string::npos; open = cell.find('`', open + 1)) {
      const std::size_t close = cell.find('`', open + 1);
      names.insert(cell.substr(open + 1, close - open - 1));
      open = close;
    }
  }
  return names;
}

/// Every key has its row, and every row its key.
void expect_documented(const Json& document) {
  std::set<std::string> used;
  collect(document, used);
  for (const char* of_a_diagnostic : {"code", "message", "where", "effect", "next", "name"})
    used.erase(of_a_diagnostic);
  std::set<std::string> known = documented(document["schema"]);
  known.merge(documented("Keys of every document"));
  if (!document.contains("inputs")) {
    for (const char* of_inputs : {"inputs", "samples_read", "samples_kept", "samples_dropped"}) known.erase(of_inputs);
  }
  EXPECT_EQ(used, known) << document["schema"];
}

Json document(const Program& program, const std::string& arguments) {
  const ProgramRun run = program.run(arguments + " --json");
  EXPECT_EQ(run.exit, 0) << run.err;
  const Json parsed = Json::parse(run.out, nullptr, false);
  EXPECT_FALSE(parsed.is_discarded()) << run.out;
  EXPECT_EQ(keys(parsed)[0], "schema");
  EXPECT_EQ("vispline " + parsed["version"].get<std::string>() + "\n", program.run("--version").out);
  return parsed;
}

void expect_account(const Json& document, const Names& roles) {
  std::int64_t read = 0;
  ASSERT_EQ(document["inputs"].size(), roles.size());
  for (std::size_t i = 0; i < roles.size(); ++i) {
    const Json& input = document["inputs"][i];
    EXPECT_EQ(keys(input), (Names{"name", "samples_read", "samples_kept", "samples_dropped"}));
    EXPECT_EQ(input["name"], roles[i]);
    read += input["samples_read"].get<std::int64_t>();
  }
  EXPECT_EQ(document["samples_read"], read);
  std::int64_t kept = document["samples_kept"];
  for (const auto& dropped : document["samples_dropped"].items()) kept += dropped.value().get<std::int64_t>();
  EXPECT_EQ(kept, read);
}

TEST(CliSchema, Integrate) {
  const Program program;
  const Json made = document(program, "integrate --trajectory ellipse --imu-rate 50,100 --method all");
  EXPECT_EQ(made["schema"], "vispline.integrate/1");
  EXPECT_EQ(keys(made), (Names{"schema", "version", "rows"}) + kDiagnosticKeys);
  std::set<std::string> methods;
  for (const Json& row : made["rows"]) {
    EXPECT_EQ(keys(row), (Names{"method", "rate_hz", "final_error_m", "max_error_m", "rmse_m", "attitude_error_deg",
                                "order", "samples", "outside"}));
    methods.insert(row["method"]);
    EXPECT_EQ(row["order"].is_null(), row["rate_hz"] == 50.0);
  }
  for (const char* wanted :
       {"euler_course_2018", "euler_course", "euler", "midpoint_course_report", "midpoint", "rk4", "rk4_cubic"}) {
    EXPECT_TRUE(methods.count(wanted)) << wanted;
  }
  EXPECT_EQ(made["rows"].size(), 2 * methods.size());
  ASSERT_EQ(program.run("simulate --trajectory ellipse --out imu.csv").exit, 0);
  const Json measured = document(program, "integrate --trajectory ellipse --imu imu.csv --method midpoint");
  EXPECT_EQ(keys(measured), (Names{"schema", "version", "rows"}) + kReadKeys + kDiagnosticKeys);
  expect_account(measured, {"imu"});
  expect_documented(measured);
}

TEST(CliSchema, SimulateRig) {
  const Program program;
  const Json made = document(program, "simulate --trajectory dance --duration 1 --rig phone --scene room --out a");
  EXPECT_EQ(made["schema"], "vispline.simulate_rig/1");
  EXPECT_EQ(keys(made), (Names{"schema", "version", "imus", "samples", "cameras", "frames", "images", "features",
                               "displaced_features", "landmarks", "begin_s", "end_s", "seed"}) +
                            kDiagnosticKeys);
  EXPECT_EQ(made["samples"], 200);
  EXPECT_EQ(made["frames"], 30);
  expect_documented(made);
}

TEST(CliSchema, EvaluateImu) {
  const Program program;
  make_imu_pair(program);
  const Json made = document(program, "evaluate first.csv second.csv");
  EXPECT_EQ(made["schema"], "vispline.evaluate_imu/1");
  EXPECT_EQ(keys(made),
            (Names{"schema", "version", "aligned", "time_offset_s", "offset_correlation", "offset_confidence",
                   "rotation_deg", "rotation_vector_rad", "rotation_matrix", "gyroscope", "accelerometer",
                   "samples_compared", "samples_outside", "samples_in_gaps"}) +
                kReadKeys + kDiagnosticKeys);
  ASSERT_EQ(made["gyroscope"].size(), 3u);
  ASSERT_EQ(made["accelerometer"].size(), 3u);
  EXPECT_EQ(keys(made["gyroscope"][0]),
            (Names{"axis", "rms_rad_per_s", "correlation", "mean_rad_per_s", "std_rad_per_s"}));
  EXPECT_EQ(keys(made["accelerometer"][2]),
            (Names{"axis", "rms_m_per_s2", "correlation", "mean_m_per_s2", "std_m_per_s2"}));
  EXPECT_EQ(made["accelerometer"][2]["axis"], "z");
  expect_account(made, {"first", "second"});
  expect_documented(made);
  EXPECT_NEAR(made["time_offset_s"].get<double>(), kOffset_s, 3e-3);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(made["rotation_vector_rad"][static_cast<std::size_t>(axis)].get<double>(), kRotation_second_first(axis),
                0.03);
  }
}

TEST(CliSchema, DiagnosticsAreInTheDocument) {
  const Program program;
  make_imu_pair(program);
  const Json made = document(program, "evaluate second.csv first.csv");
  ASSERT_EQ(made["diagnostics"].size(), 1u) << "the first file begins before the second";
  EXPECT_EQ(keys(made["diagnostics"][0]), (Names{"code", "message", "where", "effect", "next"}));
  EXPECT_EQ(made["diagnostics"][0]["code"], "W-UNPAIRED");
  EXPECT_EQ(made["diagnostic_counts"]["W-UNPAIRED"], 1);
  EXPECT_NEAR(made["time_offset_s"].get<double>(), -kOffset_s, 3e-3);
}

TEST(CliSchema, EvaluateTrajectory) {
  const Program program;
  make_trajectory_pair(program);
  const Json made = document(program, "evaluate estimate.tum truth.csv --align yaw");
  EXPECT_EQ(made["schema"], "vispline.evaluate_trajectory/1");
  EXPECT_EQ(keys(made), (Names{"schema", "version", "alignment", "scale", "rotation_matrix", "translation_m", "pairs",
                               "estimate_outside", "estimate_unmatched", "reference_unmatched", "duration_s",
                               "path_length_m", "ate", "rpe"}) +
                            kReadKeys + kDiagnosticKeys);
  EXPECT_EQ(made["alignment"], "yaw");
  EXPECT_EQ(keys(made["ate"]),
            (Names{"rmse_m", "mean_m", "median_m", "max_m", "std_m", "rotation_rmse_deg", "rotation_max_deg"}));
  ASSERT_GT(made["rpe"].size(), 0u);
  EXPECT_EQ(keys(made["rpe"][0]), (Names{"delta", "delta_unit", "pairs", "translation_rmse_m", "rotation_rmse_deg"}));
  expect_account(made, {"estimate", "reference"});
  expect_documented(made);
}

TEST(CliSchema, Simulate) {
  const Program program;
  make_trajectory_pair(program);
  const Names head{"schema", "version", "format", "imus", "samples", "begin_s", "end_s", "seed"};
  const Json made = document(program, "simulate --trajectory dance --seed 9000000000000000000 --out a.csv");
  EXPECT_EQ(made["schema"], "vispline.simulate/1");
  EXPECT_EQ(keys(made), head + kDiagnosticKeys);
  EXPECT_EQ(made["seed"], 9'000'000'000'000'000'000);
  const Json fitted = document(program, "simulate --trajectory estimate.tum --like imu.csv --out b.csv");
  EXPECT_EQ(keys(fitted), head + Names{"fit"} + kReadKeys + kDiagnosticKeys);
  EXPECT_EQ(keys(fitted["fit"]), (Names{"knots", "knot_spacing_s", "position", "rotation", "iterations", "converged",
                                        "gaps", "outliers", "translation_spectrum", "rotation_spectrum"}));
  expect_account(fitted, {"trajectory", "like"});
  expect_documented(fitted);
}

/// A recording with a gap, whose documents have every key.
void make_recording(const Program& program) {
  std::filesystem::create_directories(program.path("walk"));
  ImuSignal imu = random_imu(2000, 3);
  for (std::size_t i = 1000; i < imu.size(); ++i) imu.time[i] += Duration(700'000'000);
  write_imu_csv(program.path("walk/imu0.csv"), imu);
  write_trajectory_euroc(program.path("walk/mocap0.csv"), random_poses(1000, 4));
}

TEST(CliSchema, ConvertAndInfo) {
  const Program program;
  make_recording(program);
  const Json converted = document(program, "convert walk walk.bag");
  EXPECT_EQ(converted["schema"], "vispline.convert/1");
  EXPECT_EQ(keys(converted), (Names{"schema", "version", "format", "path"}) + kReadKeys + kDiagnosticKeys);
  expect_account(converted, {"imu", "trajectory"});
  expect_documented(converted);
  const Json made = document(program, "info walk.bag");
  EXPECT_EQ(made["schema"], "vispline.info/1");
  EXPECT_EQ(keys(made), (Names{"schema", "version", "kind", "indexed", "lost_bytes", "topics", "signals", "readout_s",
                               "readout_source"}) +
                            kReadKeys + kDiagnosticKeys);
  expect_account(made, {"/imu0", "/pose"});
  expect_documented(made);
  EXPECT_EQ(made["signals"][0]["gaps"], 1);
  EXPECT_NEAR(made["signals"][0]["gaps_s"].get<double>(), 0.705, 1e-3);
}

TEST(CliSchema, InfoOfACalibration) {
  const Program program;
  program.write("t.yaml", "target_type: 'aprilgrid'\ntagCols: 6\ntagRows: 6\ntagSize: 0.088\ntagSpacing: 0.3\n");
  const Json made = document(program, "info t.yaml");
  EXPECT_EQ(made["schema"], "vispline.info_calibration/1");
  EXPECT_EQ(keys(made), (Names{"schema", "version", "dialect", "parts"}) + kDiagnosticKeys);
  std::set<std::string> known = documented("vispline.info_calibration/1");
  EXPECT_EQ(known, (std::set<std::string>{"dialect", "parts", "kind", "part", "text", "readout_s"}));
}

TEST(CliSchema, DemoIsTheIntegrationTable) {
  const Program program;
  const Json made = document(program, "demo --out d");
  EXPECT_EQ(made["schema"], "vispline.integrate/1");
  EXPECT_EQ(Json::parse(program.bytes("d/integration.json")), made);
}

}  // namespace
}  // namespace vispline
