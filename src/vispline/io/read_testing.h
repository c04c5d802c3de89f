/// Tables with one fault each, and a check of what the reader makes of them.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "vispline/io/io_testing.h"
#include "vispline/io/number_text.h"

namespace vispline {

inline constexpr int kRows = 2000;

/// A row of a table under construction.
struct Row {
  double t;
  std::vector<double> values;
};
using Rows = std::vector<Row>;

/// kRows rows of a healthy IMU at 200 Hz from t = 100 s.
inline Rows healthy() {
  Numbers numbers(11);
  Rows rows;
  for (int i = 0; i < kRows; ++i) {
    const Vector3d g = 0.3 * numbers.vector(), a = numbers.vector() + Vector3d(0, 0, 9.81);
    rows.push_back({100.0 + 0.005 * i, {g.x(), g.y(), g.z(), a.x(), a.y(), a.z()}});
  }
  return rows;
}

inline std::string line_of(const Row& row, char separator = ',') {
  std::string out;
  append_seconds(out, time_from_ns(std::llround(row.t * 1e9)));
  for (const double value : row.values) {
    out += separator;
    append_number(out, value);
  }
  return out;
}

inline std::string text_of(const Rows& rows, const std::string& header = "t,gx,gy,gz,ax,ay,az") {
  std::string out = header + (header.empty() ? "" : "\n");
  for (const Row& row : rows) out += line_of(row) + "\n";
  return out;
}

inline std::string edited(const std::function<void(Rows&)>& edit) {
  Rows rows = healthy();
  edit(rows);
  return text_of(rows);
}

inline std::string replaced(std::string text, const std::string& what, const std::string& with) {
  for (std::size_t pos = 0; (pos = text.find(what, pos)) != std::string::npos; pos += with.size()) {
    text.replace(pos, what.size(), with);
  }
  return text;
}

struct Case {
  const char* name;
  std::string bytes;
  std::string codes;
  int exit;
  std::int64_t kept;
  ReadOptions options;
};

inline void check(const std::vector<Case>& cases) {
  const ScratchFolder folder;
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    const Outcome outcome = imu_outcome(folder.write("f.csv", c.bytes), c.options);
    EXPECT_EQ(outcome.codes, c.codes) << outcome.message;
    EXPECT_EQ(outcome.exit, c.exit);
    EXPECT_EQ(outcome.kept, c.kept);
    EXPECT_EQ(outcome.next.empty(), c.exit == 0);
  }
}

}  // namespace vispline
