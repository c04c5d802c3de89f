// Curves of recorded data against tables that others computed. Skipped where the data are not at hand.
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli_inputs.h"

namespace vispline {
namespace {

using Json = nlohmann::json;

std::string data(const std::string& name) { return std::string(VISPLINE_SOURCE_DIR) + "/../shared/data/" + name; }

#define SKIP_IF_ABSENT() \
  if (!std::filesystem::exists(data("README.md"))) GTEST_SKIP() << "no recorded data at hand"

/// A row of a Stable32 table: averaging factor, tau, count, alpha, low, sigma, high.
struct Row {
  double tau_s, low, sigma, high;
};

std::vector<Row> stable32(const std::string& path) {
  std::ifstream file(path);
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line);) {
    std::istringstream cells(line);
    double factor = 0.0, count = 0.0, alpha = 0.0;
    Row row{};
    if (cells >> factor >> row.tau_s >> count >> alpha >> row.low >> row.sigma >> row.high) rows.push_back(row);
  }
  return rows;
}

void expect_table(const Json& curve, const std::vector<Row>& table, double interval_tolerance) {
  std::size_t compared = 0;
  for (std::size_t i = 0; i < curve.at("tau_s").size(); ++i) {
    const double tau_s = curve.at("tau_s")[i];
    for (const Row& row : table) {
      if (row.tau_s != tau_s) continue;
      ++compared;
      EXPECT_NEAR(curve.at("value")[i].get<double>() / row.sigma, 1.0, 1e-4) << curve.at("deviation") << " " << tau_s;
      if (interval_tolerance == 0.0) continue;
      EXPECT_NEAR(curve.at("low")[i].get<double>() / row.low, 1.0, interval_tolerance) << tau_s;
      EXPECT_NEAR(curve.at("high")[i].get<double>() / row.high, 1.0, interval_tolerance) << tau_s;
    }
  }
  EXPECT_GE(compared + 1, table.size());
}

TEST(RecordedClocks, Caesium5071AgainstStable32) {
  SKIP_IF_ABSENT();
  const Program program;
  const ProgramRun run = program.run("allan " + data("allan/allantools_cs5071a/5071A_phase.txt.gz") +
                                     " --data phase --rate 1 --taus decade --json"
                                     " --deviation oadev,adev,mdev,tdev,hdev,ohdev,totdev");
  ASSERT_EQ(run.exit, 0) << run.err;
  const Json document = Json::parse(run.out);
  for (const Json& curve : document.at("signals").at(0).at("curves")) {
    const std::string name = curve.at("deviation");
    expect_table(curve, stable32(data("allan/allantools_cs5071a/" + name + "_decade.txt")),
                 name == "oadev" ? 1e-3 : 0.0);
  }
}

TEST(RecordedClocks, PhaseDatAgainstStable32) {
  SKIP_IF_ABSENT();
  const Program program;
  const ProgramRun run = program.run("allan " + data("allan/allantools_phasedat/PHASE.DAT") +
                                     " --data phase --rate 1 --taus octave --json"
                                     " --deviation oadev,adev,mdev,tdev,hdev,ohdev,totdev");
  ASSERT_EQ(run.exit, 0) << run.err;
  const Json document = Json::parse(run.out);
  for (const Json& curve : document.at("signals").at(0).at("curves")) {
    const std::string name = curve.at("deviation");
    expect_table(curve, stable32(data("allan/allantools_phasedat/phase_dat_" + name + "_octave.txt")),
                 name == "oadev" ? 1e-3 : 0.0);
  }
}

/// Overlapping Allan variance of the same log, computed by others with n - 2 m differences instead of n + 1 - 2 m.
TEST(RecordedImu, Adis16405AgainstAnotherTool) {
  SKIP_IF_ABSENT();
  const Program program;
  const ProgramRun run =
      program.run("allan " + data("noncommercial/adis16405_unit1/adis16405_imu1_static_100hz.csv.xz") +
                  " --columns gx,gy,gz,ax,ay,az --rate 100 --gyro-unit deg/s --accel-unit g --taus octave --json");
  ASSERT_EQ(run.exit, 0) << run.err;
  const Json document = Json::parse(run.out);
  std::ifstream file(data("allan/avar_tables/adis16405_unit1_oavar.csv"));
  std::string line;
  std::getline(file, line);
  int compared = 0;
  while (std::getline(file, line)) {
    const std::size_t first = line.find(','), second = line.find(',', first + 1);
    const double tau_s = std::stod(line.substr(first + 1)), variance = std::stod(line.substr(second + 1));
    const bool gyro = line.starts_with("Gyro");
    const char axis = static_cast<char>(std::tolower(line[first - 1]));
    const double unit = gyro ? M_PI / 180.0 : 9.80665;
    const auto& signal = document.at("signals").at(static_cast<std::size_t>((gyro ? 0 : 3) + axis - 'x'));
    const Json& curve = signal.at("curves").at(0);
    for (std::size_t i = 0; i < curve.at("tau_s").size(); ++i) {
      if (std::abs(curve.at("tau_s")[i].get<double>() / tau_s - 1.0) > 1e-9) continue;
      ++compared;
      EXPECT_NEAR(curve.at("value")[i].get<double>() / (unit * std::sqrt(variance)), 1.0, 1e-5) << line;
    }
  }
  EXPECT_GE(compared, 6 * 17);
}

}  // namespace
}  // namespace vispline
