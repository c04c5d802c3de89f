/// Bad input: bytes -> code, exit, rows kept. One case for each row of the table in docs/formats.md, Diagnostics.
#include "vispline/io/read.h"

#include "vispline/io/read_testing.h"

namespace vispline {
namespace {

using namespace std::string_literals;

TEST(ReadImu, AcceptsEveryWayToWriteATable) {  // rows 4, 8, 9
  const std::string good = text_of(healthy());
  const std::string bare = text_of(healthy(), "");
  const std::string body = good.substr(0, good.size() - 1);
  const std::string in_quotes = replaced(replaced("\"" + body, ",", "\",\""), "\n", "\"\n\"") + "\"\n";
  check({
      {"plain", good, "", 0, kRows, {}},
      {"CRLF", replaced(good, "\n", "\r\n"), "", 0, kRows, {}},
      {"lone CR", replaced(good, "\n", "\r"), "", 0, kRows, {}},
      {"mixed line ends", replaced(replaced(good, "1\n", "1\r\n"), "2\n", "2\r"), "", 0, kRows, {}},
      {"byte order mark", "\xef\xbb\xbf" + good, "", 0, kRows, {}},
      {"comments", "\n# a comment\n" + replaced(good, "3\n", "3\n\n  \n# more, words\n% more\n"), "", 0, kRows, {}},
      {"blanks", replaced(good, ",", " ,\t "), "", 0, kRows, {}},
      {"trailing comma", replaced(good, "\n", ",\n"), "", 0, kRows, {}},
      {"trailing comma in rows only", replaced(replaced(good, "\n", ",\n"), "az,\n", "az\n"), "", 0, kRows, {}},
      {"quotes", in_quotes, "", 0, kRows, {}},
      {"semicolons", replaced(good, ",", ";"), "", 0, kRows, {}},
      {"tabs", replaced(good, ",", "\t"), "", 0, kRows, {}},
      {"blanks apart", replaced(good, ",", "   "), "", 0, kRows, {}},
      {"header in a comment", "# recorded by hand\n#" + good, "", 0, kRows, {}},
      {"units", replaced(good, "t,gx", "time [s],gx"), "", 0, kRows, {}},
      {"no line end", body + "00000000000000000", "", 0, kRows, {}},
      {"no header", bare, "W-COLUMNS", 0, kRows, {}},
      {"no header but a format", bare, "", 0, kRows, {.format = "euroc_imu", .time_unit = "s"}},
      {"no header but columns", bare, "", 0, kRows, {.columns = "t,gx,gy,gz,ax,ay,az"}},
  });
}

TEST(ReadImu, MalformedText) {  // rows 2, 5, 6
  const std::string good = text_of(healthy());
  const std::string header = "t,gx,gy,gz,ax,ay,az\n";
  const std::string row7 = line_of(healthy()[7]);
  const auto with_row7 = [&](const std::string& text) { return replaced(good, row7, text); };
  check({
      {"empty", "", "E-EMPTY", 3, 0, {}},
      {"only a byte order mark", "\xef\xbb\xbf", "E-EMPTY", 3, 0, {}},
      {"only line ends", "\r\n\n\r", "E-EMPTY", 3, 0, {}},
      {"only a header", header, "E-EMPTY", 3, 0, {}},
      {"only a comment header", "#" + header, "E-EMPTY", 3, 0, {}},
      {"cut row", good.substr(0, good.rfind(',')), "W-TRUNCATED", 0, kRows - 1, {}},
      {"cut number", good.substr(0, good.rfind(',') + 2), "W-TRUNCATED", 0, kRows - 1, {}},
      {"cut before a number", good.substr(0, good.rfind(',') + 1), "W-TRUNCATED", 0, kRows - 1, {}},
      {"field missing", with_row7(row7.substr(0, row7.rfind(','))), "E-CSV", 3, 0, {}},
      {"field too many", with_row7(row7 + ",1"), "E-CSV", 3, 0, {}},
      {"text cell", with_row7("hello" + row7.substr(row7.find(','))), "E-CSV", 3, 0, {}},
      {"number and text", with_row7(row7 + "abc"), "E-CSV", 3, 0, {}},
      {"1e400", with_row7(row7.substr(0, row7.rfind(',')) + ",1e400"), "E-CSV", 3, 0, {}},
      {"NUL", with_row7(row7 + "\0"s), "E-CSV", 3, 0, {}},
      {"bad row skipped", with_row7(row7 + "abc"), "W-CSV", 0, kRows - 1, {.skip_bad_rows = true}},
      {"too many bad rows", replaced(good, "1\n", "1x\n"), "E-CSV", 3, 0, {.skip_bad_rows = true}},
  });
}

TEST(ReadImu, ColumnsDecimalsLimits) {  // rows 7, 10, 11
  const std::string good = text_of(healthy());
  const std::string names = "t,gx,gy,gz,ax,ay,az";
  const std::string commas = replaced(replaced(good, ",", ";"), ".", ",");
  const std::string many = replaced(std::string(5000, 'x'), "x", "1,") + "\n";
  check({
      {"header and rows differ", replaced(good, "az\n", "az,temp,mag\n"), "E-COLUMNS", 3, 0, {}},
      {"unknown names", replaced(good, names, "one,two,three,four,five,six,seven"), "E-COLUMNS", 3, 0, {}},
      {"names twice", replaced(good, "gy,gz", "gx,gz"), "E-COLUMNS", 3, 0, {}},
      {"unknown unit", replaced(good, "gx,", "gx [furlong],"), "E-COLUMNS", 3, 0, {}},
      {"five columns", "1,2,3,4,5\n2,3,4,5,6\n", "E-COLUMNS", 3, 0, {}},
      {"poses", "0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n", "E-COLUMNS", 3, 0, {}},
      {"columns too few", good, "E-COLUMNS", 3, 0, {.columns = "t,gx,gy,gz,ax,ay"}},
      {"columns unknown", good, "E-COLUMNS", 2, 0, {.columns = "t,gx,gy,gz,ax,ay,foo"}},
      {"format unknown", good, "E-ARGUMENT", 2, 0, {.format = "foo"}},
      {"decimal commas by semicolons", commas, "W-DECIMAL", 0, kRows, {}},
      {"decimal commas said", commas, "", 0, kRows, {.decimal = ','}},
      {"decimal commas by tabs", replaced(commas, ";", "\t"), "E-DECIMAL", 3, 0, {}},
      {"decimal commas by tabs said", replaced(commas, ";", "\t"), "", 0, kRows, {.decimal = ','}},
      {"decimal commas by blanks", replaced(commas, ";", " "), "E-DECIMAL", 3, 0, {}},
      {"decimal commas by commas", replaced(commas, ";", ","), "E-DECIMAL", 3, 0, {}},
      {"thousands", replaced(good, ",", ";") + "101;1;2;3;4;5;1,234.5\n", "E-DECIMAL", 3, 0, {}},
      {"long line", good + std::string(2 << 20, '1') + "\n", "E-LIMIT", 7, 0, {}},
      {"long first line", std::string(2 << 20, '1'), "E-LIMIT", 7, 0, {}},
      {"many fields", good + many, "E-LIMIT", 7, 0, {}},
      {"many fields first", many + "2\n", "E-LIMIT", 7, 0, {}},
  });
}

TEST(ReadImu, ConvertsNamedUnits) {
  const ScratchFolder folder;
  const std::string header = "#time [ms],gyr_x[deg/s],gyr_y[deg/s],gyr_z[deg/s],acc_x[g],acc_y[g],acc_z[g]\n";
  const auto result = read_imu(folder.write("f", header + "1000,180,0,0,0,0,1\n1005,0,-90,0,0,0,2\n"));
  ASSERT_EQ(result.value.size(), 2u);
  EXPECT_EQ(to_ns(result.value.time[1]), 1'005'000'000);
  EXPECT_NEAR(result.value.value[0].gyro.x(), 3.14159265358979324, 1e-15);
  EXPECT_NEAR(result.value.value[1].gyro.y(), -1.57079632679489662, 1e-15);
  EXPECT_DOUBLE_EQ(result.value.value[1].accel.z(), 19.6133);
}

TEST(ReadImu, NamedColumnsInAnyOrder) {
  const ScratchFolder folder;
  const auto result =
      read_imu(folder.write("f", "az,temp,gy,t,ax,gx,ay,gz\n9,text,2,0.01,7,1,8,3\n9,x,2,0.02,7,1,8,3\n"));
  EXPECT_EQ(result.value.value[0].gyro, Vector3d(1, 2, 3));
  EXPECT_EQ(result.value.value[0].accel, Vector3d(7, 8, 9));
  EXPECT_EQ(to_ns(result.value.time[1]), 20'000'000);
}

TEST(ReadImu, SaysWhere) {
  const ScratchFolder folder;
  Rows rows = healthy();
  const std::string bad = replaced(text_of(rows), line_of(rows[7]), line_of(rows[7]) + "\x1b[31m");
  const Outcome csv = imu_outcome(folder.write("f", "# one\n\n" + bad));
  EXPECT_EQ(csv.where, folder.path("f") + ":11");
  EXPECT_NE(csv.message.find("\\x1B[31m"), std::string::npos);
  for (std::size_t i = 1000; i < rows.size(); ++i) rows[i].t -= 3600;
  for (Row& row : rows) row.t += 4000;
  const Outcome reset = imu_outcome(folder.write("f", text_of(rows)));
  EXPECT_EQ(reset.where, folder.path("f") + ":1002");
  EXPECT_EQ(reset.message, "clock set back by 3599.995 s after sample 1000 (t = 4104.995 s)");
}

}  // namespace
}  // namespace vispline
