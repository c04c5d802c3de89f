// The allan verb as a user meets it: commands, documents, files, refusals.
#include <nlohmann/json.hpp>

#include "cli_inputs.h"

namespace vispline {
namespace {

using Json = nlohmann::json;

void make_still(const Program& program) {
  ASSERT_EQ(program
                .run("simulate --trajectory static --duration 1200 --imu-rate 100 --gyro-white 0.01 --gyro-walk 1e-3 "
                     "--accel-white 0.02 --accel-walk 2e-3 --seed 5 --out still.csv")
                .exit,
            0);
}

const Json& signal(const Json& document, const std::string& sensor, const std::string& axis) {
  for (const Json& entry : document.at("signals")) {
    if (entry.at("sensor") == sensor && entry.at("axis") == axis) return entry;
  }
  throw std::runtime_error("no " + sensor + " " + axis);
}

TEST(CliAllan, JsonHoldsTermsIntervalsAndCurves) {
  const Program program;
  make_still(program);
  const ProgramRun run = program.run("allan still.csv --json");
  ASSERT_EQ(run.exit, 0) << run.err;
  const Json document = Json::parse(run.out);
  EXPECT_EQ(document.at("schema"), "vispline.allan/1");
  EXPECT_NEAR(document.at("rate_hz").get<double>(), 100.0, 1e-6);
  EXPECT_NEAR(document.at("duration_s").get<double>(), 1200.0, 0.1);
  ASSERT_EQ(document.at("signals").size(), 6u);
  for (const auto& [sensor, white] : {std::pair{"gyroscope", 0.01}, {"accelerometer", 0.02}}) {
    const Json& term = signal(document, sensor, "y").at("terms").at("white");
    EXPECT_TRUE(term.at("resolved").get<bool>());
    EXPECT_NEAR(term.at("value").get<double>() / white, 1.0, 0.01) << sensor;
    EXPECT_LT(term.at("low").get<double>(), term.at("value").get<double>());
    EXPECT_GT(term.at("high").get<double>(), term.at("value").get<double>());
    EXPECT_EQ(term.at("confidence"), 0.95);
    const Json& walk = signal(document, sensor, "y").at("terms").at("random_walk");
    ASSERT_TRUE(walk.at("resolved").get<bool>());
    EXPECT_NEAR(walk.at("value").get<double>() / (white / 10.0), 1.0, 0.5) << sensor;
    const Json& flicker = signal(document, sensor, "y").at("terms").at("flicker");
    if (!flicker.at("resolved").get<bool>()) {
      EXPECT_TRUE(flicker.at("value").is_null());
    }
    const Json& curve = signal(document, sensor, "y").at("curves").at(0);
    EXPECT_EQ(curve.at("deviation"), "oadev");
    for (const char* column : {"value", "low", "high", "count"}) {
      EXPECT_EQ(curve.at(column).size(), curve.at("tau_s").size()) << column;
    }
    EXPECT_NEAR(signal(document, sensor, "y").at("imu_utils").at("n").get<double>() / (10.0 * white), 1.0, 0.1);
  }
  EXPECT_NE(run.err.find("samples: 120000 read, 120000 kept, 0 dropped"), std::string::npos);
}

TEST(CliAllan, FolderHoldsReportCurveAndEveryDialect) {
  const Program program;
  make_still(program);
  const std::string command =
      "allan still.csv --topic /imu7 --out out --export kalibr,openvins,vins-fusion,orbslam3,basalt,imu_utils";
  const ProgramRun run = program.run(command);
  ASSERT_EQ(run.exit, 0) << run.err;
  EXPECT_NE(program.bytes("out/report.html").find("<svg"), std::string::npos);
  EXPECT_TRUE(program.bytes("out/curve.csv").starts_with("tau_s"));
  EXPECT_EQ(Json::parse(program.bytes("out/allan.json")).at("schema"), "vispline.allan/1");
  const std::string kalibr = program.bytes("out/imu.yaml");
  EXPECT_NE(kalibr.find("gyroscope_noise_density: 0.0"), std::string::npos) << kalibr;
  EXPECT_NE(kalibr.find("/imu7"), std::string::npos);
  for (const char* file : {"kalibr_imu_chain.yaml", "vins_fusion_imu.yaml", "orbslam3_imu.yaml", "basalt_imu.json",
                           "imu0_imu_param.yaml", "data_imu0_gyr_t.txt", "data_imu0_sim_acc_z.txt"}) {
    EXPECT_TRUE(program.exists(std::string("out/") + file)) << file;
  }
  const ProgramRun explained = program.run("allan --explain out/imu0_imu_param.yaml --rate 100");
  EXPECT_EQ(explained.exit, 0) << explained.err;
  EXPECT_NE(explained.out.find("gyr_w"), std::string::npos);
  EXPECT_EQ(program.run(command).exit, 6) << "an old result is not replaced without --force";
}

TEST(CliAllan, AnySeriesAndEveryDeviation) {
  const Program program;
  std::string phase = "# a clock\n0\n";
  double sum = 0.0;
  std::int64_t n = 1234567890;  // the frequencies of NIST SP 1065
  for (int i = 0; i < 1000; ++i, n = 16807 * n % 2147483647) {
    char line[40];
    std::snprintf(line, sizeof line, "%.17g\n", sum += static_cast<double>(n) / 2147483647.0);
    phase += line;
  }
  program.write("clock.txt", phase);
  const ProgramRun run = program.run(
      "allan clock.txt --data phase --rate 1 --deviation oadev,adev,mdev,hdev,ohdev,totdev --taus decade --json");
  ASSERT_EQ(run.exit, 0) << run.err;
  const Json document = Json::parse(run.out);
  const std::map<std::string, double> at_ten{{"oadev", 9.159953e-2}, {"adev", 9.965736e-2},  {"mdev", 6.172376e-2},
                                             {"hdev", 1.052754e-1},  {"ohdev", 9.581083e-2}, {"totdev", 9.134743e-2}};
  ASSERT_EQ(document.at("signals").at(0).at("curves").size(), 6u);
  for (const Json& curve : document.at("signals").at(0).at("curves")) {
    EXPECT_EQ(curve.at("tau_s").at(3), 10.0);
    EXPECT_NEAR(curve.at("value").at(3).get<double>() / at_ten.at(curve.at("deviation")), 1.0, 1e-6);
  }
}

TEST(CliAllan, NoTimeColumnOtherUnits) {
  const Program program;
  std::string table;
  for (int i = 0; i < 2000; ++i) {
    char line[160];
    std::snprintf(line, sizeof line, "%.6f,%.6f,%.6f,%.6f,%.6f,%.6f\n", std::sin(1.7 * i * i), std::cos(2.3 * i * i),
                  std::sin(0.9 * i * i), 0.01 * std::sin(i * i * 1.1), 0.01 * std::cos(i * i * 0.7),
                  1.0 + 0.01 * std::sin(i * i * 0.3));
    table += line;
  }
  program.write("log.csv", table);
  const ProgramRun run =
      program.run("allan log.csv --columns gx,gy,gz,ax,ay,az --rate 100 --gyro-unit deg/s --accel-unit g --json");
  ASSERT_EQ(run.exit, 0) << run.err;
  const Json document = Json::parse(run.out);
  EXPECT_EQ(document.at("rate_hz"), 100.0);
  EXPECT_NEAR(signal(document, "accelerometer", "z").at("mean").get<double>(), 9.80665, 0.02);
  EXPECT_NEAR(signal(document, "gyroscope", "x").at("standard_deviation").get<double>(), 0.707 * M_PI / 180.0, 5e-4);
}

TEST(CliAllan, SelfTestComparesWithTheTruth) {
  const Program program;
  const ProgramRun run = program.run("allan --self-test --rate 50 --duration 600 --runs 4 --json");
  ASSERT_EQ(run.exit, 0) << run.err;
  const Json document = Json::parse(run.out);
  for (const Json& row : document.at("terms")) {
    if (row.at("term") != "white") continue;
    EXPECT_EQ(row.at("resolved"), 4);
    EXPECT_NEAR(row.at("mean").get<double>() / row.at("truth").get<double>(), 1.0, 0.03);
  }
}

TEST(CliAllan, Refusals) {
  const Program program;
  program.write("short.csv", "t,gx,gy,gz,ax,ay,az\n0,0,0,0,0,0,9.8\n0.01,0.1,0,0,0,0,9.8\n0.02,0,0,0.1,0,0,9.8\n");
  EXPECT_EQ(program.run("allan short.csv").exit, 4);
  EXPECT_EQ(program.run("allan").exit, 2);
  EXPECT_EQ(program.run("allan short.csv --export kalibr").exit, 2);
  EXPECT_EQ(program.run("allan short.csv --out out --export matlab").exit, 2);
  EXPECT_EQ(program.run("allan short.csv --deviation xdev").exit, 2);
  EXPECT_EQ(program.run("allan absent.csv").exit, 3);
}

}  // namespace
}  // namespace vispline
