/// Bad stamps and values: bytes -> code, exit, rows kept. One case for each row of the table in docs/formats.md,
/// Diagnostics.
#include "vispline/io/read.h"

#include "vispline/io/read_testing.h"

namespace vispline {
namespace {

TEST(ReadImu, ValuesThatAreNoNumbers) {  // rows 12, 13
  const auto nans = [](int count, double value) {
    return edited([&](Rows& rows) {
      for (int i = 0; i < count; ++i) {
        rows[static_cast<std::size_t>(50 + 7 * i)].values[static_cast<std::size_t>(i % 6)] = value;
      }
    });
  };
  check({
      {"one nan", nans(1, NAN), "W-NONFINITE", 0, kRows - 1, {}},
      {"1 % inf", nans(20, INFINITY), "W-NONFINITE W-RATE", 0, kRows - 20, {}},
      {"above 1 %", nans(21, NAN), "E-NONFINITE", 4, 0, {}},
      {"repaired", nans(21, NAN), "W-NONFINITE W-RATE", 0, kRows - 21, {.repair = true}},
      {"strict", nans(1, NAN), "E-NONFINITE", 4, 0, {.strict = true}},
      {"empty cell",
       replaced(text_of(healthy()), line_of(healthy()[9]), "100.045000000,,1,1,1,1,1"),
       "W-NONFINITE",
       0,
       kRows - 1,
       {}},
  });
}

TEST(ReadImu, Stamps) {  // rows 14 - 23
  const auto scaled = [](double factor) {
    return edited([=](Rows& rows) {
      for (Row& row : rows) row.t *= factor;
    });
  };
  check({
      {"swapped", edited([](Rows& r) { std::swap(r[500], r[501]); }), "W-ORDER", 0, kRows, {}},
      {"late row",
       edited([](Rows& r) { std::rotate(r.begin() + 500, r.begin() + 501, r.begin() + 600); }),
       "W-ORDER",
       0,
       kRows,
       {}},
      {"reversed", edited([](Rows& r) { std::reverse(r.begin(), r.end()); }), "E-ORDER", 3, 0, {}},
      {"shuffled",
       edited([](Rows& r) {
         for (std::size_t i = 0; i < r.size(); ++i) std::swap(r[i], r[i * 7919 % r.size()]);
       }),
       "E-ORDER",
       3,
       0,
       {}},
      {"2 % swapped",
       edited([](Rows& r) {
         for (std::size_t i = 0; i < 40; ++i) std::swap(r[40 * i], r[40 * i + 1]);
       }),
       "E-ORDER",
       3,
       0,
       {}},
      {"2 % swapped, repaired",
       edited([](Rows& r) {
         for (std::size_t i = 0; i < 40; ++i) std::swap(r[40 * i], r[40 * i + 1]);
       }),
       "W-ORDER",
       0,
       kRows,
       {.repair = true}},
      {"row twice", edited([](Rows& r) { r.insert(r.begin() + 9, r[9]); }), "W-DUPLICATE", 0, kRows, {}},
      {"all rows twice",
       edited([](Rows& r) {
         Rows b;
         for (const Row& x : r) b.insert(b.end(), {x, x});
         r = b;
       }),
       "W-DUPLICATE",
       0,
       kRows,
       {}},
      {"stamp twice",
       edited([](Rows& r) {
         r.insert(r.begin() + 9, r[9]);
         r[10].values[0] += 1;
       }),
       "W-DUPLICATE",
       0,
       kRows,
       {}},
      {"2 % stamps twice",
       edited([](Rows& r) {
         Rows b;
         for (std::size_t i = 0; i < r.size(); ++i) {
           b.push_back(r[i]);
           if (i % 50 == 0) {
             b.push_back(r[i]);
             b.back().values[2] = 0;
           }
         }
         r = b;
       }),
       "E-DUPLICATE",
       3,
       0,
       {}},
      {"rounded to 10 ms",
       edited([](Rows& r) {
         for (Row& x : r) x.t = std::floor(x.t * 100) / 100;
       }),
       "E-TIME-PRECISION",
       3,
       0,
       {}},
      {"rounded to 2 ms",
       edited([](Rows& r) {
         for (Row& x : r) x.t = std::floor(x.t * 500) / 500;
       }),
       "W-RATE W-TIME-PRECISION",
       0,
       kRows,
       {}},
      {"two ages",
       "t [ns],gx,gy,gz,ax,ay,az\n1,1,1,1,1,1,9\n9000000000000000000,1,1,1,1,1,9\n",
       "",
       0,
       2,
       {.time_unit = "ns"}},
      {"all stamps equal", scaled(0.0), "E-TIME-CONSTANT", 3, 0, {}},
      {"one in the future", edited([](Rows& r) { r[700].t += 3e8; }), "W-TIME-OUTLIER", 0, kRows - 1, {}},
      {"first is 0",
       edited([](Rows& r) {
         for (Row& x : r) x.t += 1e9;
         r[0].t = 0;
       }),
       "W-TIME-OUTLIER",
       0,
       kRows - 1,
       {}},
      {"last in the future", edited([](Rows& r) { r.back().t += 1e6; }), "W-TIME-OUTLIER", 0, kRows - 1, {}},
      {"clock set back",
       edited([](Rows& r) {
         for (std::size_t i = 1000; i < r.size(); ++i) r[i].t -= 60;
       }),
       "E-TIME-RESET",
       3,
       0,
       {}},
      {"gap",
       edited([](Rows& r) {
         for (std::size_t i = 1000; i < r.size(); ++i) r[i].t += 0.2;
       }),
       "W-GAP",
       0,
       kRows,
       {}},
      {"milliseconds", scaled(1e3), "E-TIME-UNIT", 3, 0, {}},
      {"milliseconds said", scaled(1e3), "", 0, kRows, {.time_unit = "ms"}},
      {"microseconds", scaled(1e6), "E-TIME-UNIT", 3, 0, {}},
      {"hours", scaled(1.0 / 3600), "E-TIME-UNIT", 3, 0, {}},
      {"beyond 64 bits", edited([](Rows&) {}) + "99999999999999999999,1,1,1,1,1,9\n", "W-TIME-RANGE", 0, kRows, {}},
      {"all beyond 64 bits",
       "#timestamp [ns],gx,gy,gz,ax,ay,az\n99999999999999999999,1,1,1,1,1,9\n99999999999999999999,2,1,1,1,1,9\n"
       "99999999999999999999,1,3,1,1,1,9\n",
       "E-TIME-RANGE",
       3,
       {},
       {}},
      {"one negative", replaced(text_of(healthy()), "100.045000000,", "-1.5,"), "W-TIME-RANGE", 0, kRows - 1, {}},
      {"many negative",
       edited([](Rows& r) {
         for (Row& x : r) x.t -= 105;
       }),
       "E-TIME-RANGE",
       3,
       0,
       {}},
      {"index", replaced(scaled(200), "t,", "index,"), "E-TIME-UNIT", 3, 0, {}},
      {"index at a rate", replaced(scaled(200), "t,", "index,"), "", 0, kRows, {.time_unit = "index@200"}},
      {"unit unknown", scaled(1), "E-TIME-UNIT", 2, 0, {.time_unit = "h"}},
      {"jitter",
       edited([](Rows& r) {
         Numbers n(5);
         for (Row& x : r) x.t += 0.0008 * std::tanh(n.normal()) + 1e-7 * n.normal();
       }),
       "W-RATE",
       0,
       kRows,
       {}},
      {"rate changes",
       edited([](Rows& r) {
         for (std::size_t i = 0; i < r.size(); ++i) r[i].t += 0.00045 * std::max(0.0, double(i) - 1000.0);
       }),
       "W-RATE",
       0,
       kRows,
       {}},
  });
}

TEST(ReadImu, UnitsAndDeadAxes) {  // rows 26 - 30
  const auto each = [](const std::function<void(std::vector<double>&)>& edit) {
    return edited([&](Rows& rows) {
      for (Row& row : rows) edit(row.values);
    });
  };
  check({
      {"g",
       each([](auto& v) {
         for (int i = 3; i < 6; ++i) v[static_cast<std::size_t>(i)] /= 9.81;
       }),
       "W-UNITS",
       0,
       kRows,
       {}},
      {"mg",
       each([](auto& v) {
         for (int i = 3; i < 6; ++i) v[static_cast<std::size_t>(i)] /= 9.81e-3;
       }),
       "W-UNITS",
       0,
       kRows,
       {}},
      {"deg/s",
       each([](auto& v) {
         for (int i = 0; i < 3; ++i) v[static_cast<std::size_t>(i)] *= 57.3;
       }),
       "W-UNITS",
       0,
       kRows,
       {}},
      {"no gravity", each([](auto& v) { v[5] -= 9.81; }), "W-UNITS", 0, kRows, {}},
      {"swapped", each([](auto& v) { std::rotate(v.begin(), v.begin() + 3, v.end()); }), "W-UNITS", 0, kRows, {}},
      {"one axis dead", each([](auto& v) { v[1] = 0.25; }), "W-CONSTANT", 0, kRows, {}},
      {"all dead", each([](auto& v) { v = {0, 0, 0, 0, 0, 9.81}; }), "E-CONSTANT", 4, 0, {}},
      {"saturated",
       edited([](Rows& r) {
         for (std::size_t i = 300; i < 310; ++i) r[i].values[3] = 16.0;
       }),
       "W-SATURATED",
       0,
       kRows,
       {}},
      {"spike", edited([](Rows& r) { r[300].values[4] = 1e4; }), "W-SPIKE", 0, kRows - 1, {}},
  });
}

TEST(ReadImu, GapsAreOneWarning) {
  const ScratchFolder folder;
  const std::string path = folder.write("imu.csv", edited([](Rows& r) {
                                          for (std::size_t i = 700; i < r.size(); ++i) r[i].t += 0.2;
                                          for (std::size_t i = 1000; i < r.size(); ++i) r[i].t += 0.5;
                                        }));
  const auto read = read_imu(path);
  ASSERT_EQ(read.diagnostics.counts().at("W-GAP"), 1);
  const std::string text = to_text(read.diagnostics.examples().front());
  EXPECT_NE(text.find("2 gaps, 0.7"), std::string::npos) << text;
  EXPECT_NE(text.find(":1002"), std::string::npos) << text;
}

}  // namespace
}  // namespace vispline
