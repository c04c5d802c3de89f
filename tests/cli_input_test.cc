// Bad input through the program: exit code, form of the first line, account of every row, nothing left behind.
// The readers' own tests have every case; here stands one for each code that a text file can cause.
#include <sys/stat.h>

#include <cmath>
#include <regex>

#include "program.h"
#include "vispline/io/read_testing.h"
#include "vispline/io/tum.h"

namespace vispline {
namespace {

using namespace std::string_literals;

struct BadInput {
  const char* name;
  std::string bytes;
  std::string code;  ///< of the first line
  int exit;
  std::int64_t read, kept;  ///< if the exit is 0
  std::string flags = "";
};

const std::regex kFirstLine(R"re((error\[E|warning\[W)(-[A-Z]+)+\]: .+)re");
const std::regex kSamples(R"(samples: (\d+) read, (\d+) kept, (\d+) dropped)");

/// The last line of stderr, if it is the account.
void expect_account(const ProgramRun& run, std::int64_t read, std::int64_t kept) {
  const std::string last = run.err.empty() ? "" : lines(run.err).back();
  std::smatch counts;
  ASSERT_TRUE(std::regex_match(last, counts, kSamples)) << run.err;
  EXPECT_EQ(std::stoll(counts[1]), read);
  EXPECT_EQ(std::stoll(counts[2]), kept);
  EXPECT_EQ(std::stoll(counts[3]), read - kept);
}

/// Every line is a first line, one of its four parts, or the account.
void expect_wording(const std::string& err) {
  static const std::regex part(R"(  (where: |effect:|next:  ) .+)");
  for (const std::string& line : lines(err)) {
    EXPECT_TRUE(std::regex_match(line, kFirstLine) || std::regex_match(line, part) || std::regex_match(line, kSamples))
        << line;
  }
}

/// `command` reads bad.csv and writes out.csv.
void check_all(const std::string& command, const std::vector<BadInput>& cases) {
  for (const BadInput& bad : cases) {
    SCOPED_TRACE(bad.name);
    const Program program;
    program.write("bad.csv", bad.bytes);
    const ProgramRun run = program.run(command + " " + bad.flags);
    EXPECT_EQ(run.exit, bad.exit) << run.err;
    expect_wording(run.err);
    const std::string wanted =
        bad.code.empty() ? "samples: " : (bad.exit == 0 ? "warning[" : "error[") + bad.code + "]: ";
    EXPECT_EQ(run.first_line().substr(0, wanted.size()), wanted) << run.err;
    EXPECT_EQ(program.exists("out.csv"), bad.exit == 0);
    EXPECT_EQ(program.files().size(), bad.exit == 0 ? 2u : 1u) << "something is left behind";
    if (bad.exit == 0) expect_account(run, bad.read, bad.kept);
    EXPECT_EQ(program.bytes("bad.csv"), bad.bytes);
  }
}

void check_imu(const std::vector<BadInput>& cases) {
  check_all("simulate --trajectory ellipse --start 0 --duration 1000 --like bad.csv --out out.csv", cases);
}

std::string each(const std::function<void(std::vector<double>&)>& edit) {
  return edited([&](Rows& rows) {
    for (Row& row : rows) edit(row.values);
  });
}

std::string each_time(const std::function<void(double&, std::size_t)>& edit) {
  return edited([&](Rows& rows) {
    for (std::size_t i = 0; i < rows.size(); ++i) edit(rows[i].t, i);
  });
}

std::string nans(std::size_t count) {
  return edited([=](Rows& rows) {
    for (std::size_t i = 0; i < count; ++i) rows[50 + 7 * i].values[i % 6] = NAN;
  });
}

TEST(CliInput, Files) {  // rows 1, 2, 3
  const Program program;
  ASSERT_EQ(::mkfifo(program.path("fifo").c_str(), 0600), 0);
  ASSERT_EQ(::symlink("nowhere", program.path("dangling").c_str()), 0);
  ASSERT_EQ(::symlink("loop", program.path("loop").c_str()), 0);
  for (const std::string name : {"absent", "fifo", "dangling", "loop", ".", "/dev/zero"}) {
    const ProgramRun run = program.run("evaluate " + name + " " + name);
    EXPECT_EQ(run.exit, 3) << name;
    EXPECT_EQ(run.first_line().find("error[E-OPEN]: "), 0u) << run.err;
    expect_wording(run.err);
  }
  const ProgramRun forged = program.run({"evaluate", "a\nwarning[W-GAP]: \x1b[31m", "b"});
  expect_wording(forged.err);
  EXPECT_EQ(forged.err.find('\x1b'), std::string::npos);
  const std::string good = text_of(healthy());
  check_imu({
      {"empty", "", "E-EMPTY", 3, 0, 0},
      {"only a header", good.substr(0, good.find('\n') + 1), "E-EMPTY", 3, 0, 0},
      {"a bag without messages", "#ROSBAG V2.0\n", "E-TOPIC", 4, 0, 0},
      {"UTF-16", "\xff\xfet\0,\0"s, "E-FORMAT", 3, 0, 0},
      {"cut gzip", "\x1f\x8b\x08\0\0\0\0\0\0\3abc"s, "E-CORRUPT", 3, 0, 0},
  });
}

TEST(CliInput, Text) {  // rows 4 to 11
  const std::string good = text_of(healthy()), row = line_of(healthy()[7]);
  const std::string commas = replaced(replaced(good, ",", ";"), ".", ",");
  check_imu({
      {"accepted in silence", "\xef\xbb\xbf# x\n" + replaced(good, "\n", ",\r\n"), "", 0, kRows, kRows},
      {"cut", good.substr(0, good.rfind(',')), "W-TRUNCATED", 0, kRows, kRows - 1},
      {"text cell", replaced(good, row, row + "abc"), "E-CSV", 3, 0, 0},
      {"text cell skipped", replaced(good, row, row + "abc"), "W-CSV", 0, kRows, kRows - 1, "--skip-bad-rows"},
      {"unknown names", replaced(good, "gx,gy,gz", "one,two,three"), "E-COLUMNS", 3, 0, 0},
      {"no header", text_of(healthy(), ""), "W-COLUMNS", 0, kRows, kRows},
      {"columns said", text_of(healthy(), ""), "", 0, kRows, kRows, "--columns t,gx,gy,gz,ax,ay,az"},
      {"decimal commas by tabs", replaced(commas, ";", "\t"), "E-DECIMAL", 3, 0, 0},
      {"decimal commas by semicolons", commas, "W-DECIMAL", 0, kRows, kRows},
      {"decimal commas said", commas, "", 0, kRows, kRows, "--decimal ,"},
      {"long line", good + std::string(2 << 20, '1') + "\n", "E-LIMIT", 7, 0, 0},
  });
}

TEST(CliInput, ValuesAndOrder) {  // rows 12 to 17
  check_imu({
      {"one nan", nans(1), "W-NONFINITE", 0, kRows, kRows - 1},
      {"many nans", nans(21), "E-NONFINITE", 4, 0, 0},
      {"many nans repaired", nans(21), "W-NONFINITE", 0, kRows, kRows - 21, "--repair"},
      {"swapped", edited([](Rows& r) { std::swap(r[500], r[501]); }), "W-ORDER", 0, kRows, kRows},
      {"reversed", edited([](Rows& r) { std::reverse(r.begin(), r.end()); }), "E-ORDER", 3, 0, 0},
      {"row twice", edited([](Rows& r) { r.insert(r.begin() + 9, r[9]); }), "W-DUPLICATE", 0, kRows + 1, kRows},
      {"stamps twice", each_time([](double& t, std::size_t i) { t -= i % 40 == 1 ? 0.005 : 0.0; }), "E-DUPLICATE", 3, 0,
       0},
  });
}

TEST(CliInput, Time) {  // rows 18 to 25
  const auto scaled = [](double factor) { return each_time([=](double& t, std::size_t) { t *= factor; }); };
  const std::string good = text_of(healthy());
  Numbers numbers(5);
  check_imu({
      {"constant", scaled(0.0), "E-TIME-CONSTANT", 3, 0, 0},
      {"one in the future", edited([](Rows& r) { r[700].t += 3e8; }), "W-TIME-OUTLIER", 0, kRows, kRows - 1},
      {"set back", each_time([](double& t, std::size_t i) { t -= i < 1000 ? 0 : 60; }), "E-TIME-RESET", 3, 0, 0},
      {"gap", each_time([](double& t, std::size_t i) { t += i < 1000 ? 0 : 0.2; }), "W-GAP", 0, kRows, kRows},
      {"milliseconds", scaled(1e3), "E-TIME-UNIT", 3, 0, 0},
      {"milliseconds said", scaled(1e3), "", 0, kRows, kRows, "--time-unit ms"},
      {"index", replaced(scaled(200), "t,", "index,"), "", 0, kRows, kRows, "--time-unit index@200"},
      {"one beyond 64 bits", good + "99999999999999999999,1,1,1,1,1,9\n", "W-TIME-RANGE", 0, kRows + 1, kRows},
      {"many negative", each_time([](double& t, std::size_t) { t -= 105; }), "E-TIME-RANGE", 3, 0, 0},
      {"to 2 ms", each_time([](double& t, std::size_t) { t = std::floor(t * 500) / 500; }), "W-TIME-PRECISION", 0,
       kRows, kRows},
      {"to 10 ms", each_time([](double& t, std::size_t) { t = std::floor(t * 100) / 100; }), "E-TIME-PRECISION", 3, 0,
       0},
      {"jitter", each_time([&](double& t, std::size_t) { t += 0.0008 * std::tanh(numbers.normal()); }), "W-RATE", 0,
       kRows, kRows},
  });
}

TEST(CliInput, Readings) {  // rows 26 to 30
  check_imu({
      {"g", each([](auto& v) { v = {v[0], v[1], v[2], v[3] / 9.81, v[4] / 9.81, v[5] / 9.81}; }), "W-UNITS", 0, kRows,
       kRows},
      {"one axis dead", each([](auto& v) { v[1] = 0.25; }), "W-CONSTANT", 0, kRows, kRows},
      {"all dead", each([](auto& v) { v = {0, 0, 0, 0, 0, 9.81}; }), "E-CONSTANT", 4, 0, 0},
      {"saturated", edited([](Rows& r) {
         for (std::size_t i = 300; i < 310; ++i) r[i].values[3] = 16.0;
       }),
       "W-SATURATED", 0, kRows, kRows},
      {"spike", edited([](Rows& r) { r[300].values[4] = 1e4; }), "W-SPIKE", 0, kRows, kRows - 1},
  });
}

TEST(CliInput, Poses) {  // row 58
  const auto poses = [](std::size_t lost) {
    Signal<Pose> signal = random_poses(500, 21);
    for (std::size_t i = 0; i < 500; ++i) {
      const double t = 0.01 * static_cast<double>(i);
      signal.value[i] = {SO3::exp<double>(Vector3d(0.3 * std::sin(t), 0.2 * t, 0.1)), Vector3d(std::sin(t), t, 1)};
      if (i < lost) signal.value[i].p.x() = NAN;
    }
    return tum::text(signal);
  };
  const auto with_row = [&](const std::string& quaternion) {
    return poses(0) + "1520530312.356179851 0.1 5 1 " + quaternion + "\n";
  };
  check_all("simulate --trajectory bad.csv --knot-spacing 0.1 --out out.csv",
            {
                {"good", poses(0), "", 0, 500, 500},
                {"nan", poses(7), "W-NONFINITE", 0, 500, 493},
                {"mostly nan", poses(300), "E-NONFINITE", 4, 0, 0},
                {"norm 1.01", with_row("0 0 0.51 0.87"), "W-QUATERNION", 0, 501, 501},
                {"norm 1.2", with_row("0.5 -0.5 0.5 0.9"), "E-QUATERNION", 3, 0, 0},
                {"commas", replaced(poses(0), " ", ","), "W-COLUMNS", 0, 500, 500},
                {"an IMU", text_of(healthy()), "E-COLUMNS", 3, 0, 0},
            });
}

TEST(CliInput, StrictMakesTheFirstWarningAnError) {
  const std::string cut = text_of(healthy()).substr(0, 5000);
  check_imu({
      {"nan", nans(1), "E-NONFINITE", 4, 0, 0, "--strict"},
      {"cut", cut.substr(0, cut.rfind(',')), "E-TRUNCATED", 3, 0, 0, "--strict"},
      {"no header", text_of(healthy(), ""), "E-COLUMNS", 3, 0, 0, "--strict"},
      {"nothing odd", text_of(healthy()), "", 0, kRows, kRows, "--strict"},
  });
}

TEST(CliInput, StampsOutsideTheMotion) {
  const std::string command = "simulate --trajectory ellipse --start 100 --duration 5 --like bad.csv --out out.csv";
  check_all(command, {{"lenient", text_of(healthy()), "W-SPAN", 0, kRows, kRows}});
  check_all(command, {{"strict", text_of(healthy()), "E-SPAN", 4, 0, 0, "--strict"}});
}

TEST(CliInput, ThreeExamplesOfACode) {
  const Program program;
  program.write("bad.csv", nans(9));
  const ProgramRun run = program.run("simulate --trajectory ellipse --start 100 --like bad.csv --out out.csv");
  ASSERT_EQ(run.exit, 0) << run.err;
  std::size_t examples = 0;
  for (const std::string& line : lines(run.err)) examples += line.starts_with("warning[W-NONFINITE]: ");
  EXPECT_LE(examples, 4u);
  expect_account(run, kRows, kRows - 9);
}

}  // namespace
}  // namespace vispline
