#include "vispline/io/imu_stream.h"

#include "vispline/core/random.h"
#include "vispline/files/limits.h"
#include "vispline/files/output_file.h"
#include "vispline/io/stream_testing.h"

namespace vispline {
namespace {

struct Input {
  std::string name;
  std::string bytes;
};

/// Tables with oddities of every kind, each of them 60 rows long.
std::vector<Input> odd_inputs() {
  Rows rows = healthy();
  rows.resize(60);
  const std::string good = text_of(rows);
  Rows faulty = rows;
  std::swap(faulty[20], faulty[21]);
  faulty[30].values[2] = NAN;
  faulty[40].t += 1e6;
  faulty.insert(faulty.begin() + 50, faulty[50]);
  const std::string bad_cell = replaced(good, line_of(rows[33]), "1,2,three,4,5,6,7");
  const std::string last = line_of(rows.back());
  return {
      {"plain", good},
      {"CRLF", replaced(good, "\n", "\r\n")},
      {"CR", replaced(good, "\n", "\r")},
      {"mixed ends", replaced(replaced(good, "1\n", "1\r\n"), "2\n", "2\r\n\r")},
      {"byte order mark", "\xef\xbb\xbf" + good},
      {"comments", "# one\n\n%two\n" + replaced(good, "3\n", "3\n \n# 1,2,3\n")},
      {"quotes", "\"" + replaced(replaced(good.substr(0, good.size() - 1), ",", "\",\""), "\n", "\"\n\"") + "\"\n"},
      {"blanks", replaced(good, ",", "  \t")},
      {"semicolons and decimal commas", replaced(replaced(good, ",", ";"), ".", ",")},
      {"plus signs", replaced(good, ",", ",+") /* "+-1" is no number */},
      {"exponents", replaced(replaced(good, "\n", "e0\n"), "aze0", "az")},
      {"no az", replaced(good, "az", "azz")},
      {"no line end", good.substr(0, good.size() - 1) + "0000000000"},
      {"cut", good.substr(0, good.size() - last.size() / 2)},
      {"faults", text_of(faulty)},
      {"bad cell", bad_cell},
      {"no rows", "t,gx,gy,gz,ax,ay,az\n"},
      {"one row", good.substr(0, good.find('\n', 20) + 1)},
      {"empty", ""},
  };
}

TEST(ImuStream, IsTheSameForEveryBlockSize) {
  const ScratchFolder folder;
  for (const Input& input : odd_inputs()) {
    SCOPED_TRACE(input.name);
    const std::string path = folder.write("f.csv", input.bytes);
    const Streamed whole = streamed(path);
    for (const std::size_t block : {1, 2, 3, 7, 64, 1000}) {
      SCOPED_TRACE(block);
      expect_same(streamed(path, {}, {.block_bytes = block}), whole);
    }
    const Outcome read = imu_outcome(path);
    EXPECT_EQ(read.exit == 0, whole.error.empty());
    if (read.exit == 0) expect_same_samples(read_imu(path).value, whole.imu);
  }
}

TEST(ImuStream, IsTheSameForCompressedFiles) {
  const ScratchFolder folder;
  const std::string text = text_of(healthy());
  const Streamed whole = streamed(folder.write("f.csv", text));
  for (const char* name : {"f.csv.gz", "f.csv.xz"}) {
    write_file(folder.path(name), text);
    for (const std::size_t block : {7, 64, 1 << 20}) {
      const Streamed packed = streamed(folder.path(name), {}, {.block_bytes = block});
      EXPECT_EQ(packed.error, "");
      expect_same_samples(packed.imu, whole.imu);
    }
  }
}

/// One fault at every place of a recording of several windows is found as in one window that holds all.
template <class Edit>
void expect_same_in_small_windows(const Edit& edit, std::size_t rows, std::size_t window, std::size_t stride) {
  const ScratchFolder folder;
  for (std::size_t at = 1; at + 2 < rows; at += stride) {
    SCOPED_TRACE(at);
    Rows table = healthy();
    table.resize(rows);
    edit(table, at);
    const std::string path = folder.write("f.csv", text_of(table));
    const Streamed whole = streamed(path);
    EXPECT_EQ(whole.error, "");
    EXPECT_FALSE(whole.warnings.empty());
    expect_same(streamed(path, {}, {.window_rows = window}), whole);
  }
}

TEST(ImuStream, FindsFaultsAtTheSeamsOfWindows) {
  expect_same_in_small_windows([](Rows& r, std::size_t i) { std::swap(r[i], r[i + 1]); }, 150, 16, 5);
  expect_same_in_small_windows([](Rows& r, std::size_t i) { r[i].t += 3e8; }, 150, 16, 5);
  expect_same_in_small_windows([](Rows& r, std::size_t i) { r[i].t -= 50; }, 150, 16, 5);
  expect_same_in_small_windows([](Rows& r, std::size_t i) { r.insert(r.begin() + static_cast<long>(i), r[i]); }, 150,
                               16, 1);
  expect_same_in_small_windows([](Rows& r, std::size_t i) { r[i].values[i % 6] = NAN; }, 150, 16, 5);
  expect_same_in_small_windows(
      [](Rows& r, std::size_t i) {
        for (std::size_t k = i; k < r.size(); ++k) r[k].t += 0.7;
      },
      150, 16, 5);
  expect_same_in_small_windows([](Rows& r, std::size_t i) { r[i].values[4] = 1e4; }, 1700, 512, 101);
}

TEST(ImuStream, SortsRowsThatAreLateByUpToAWindow) {
  const ScratchFolder folder;
  const auto late_by = [&](long rows) {
    Rows table = healthy();
    std::rotate(table.begin() + 500, table.begin() + 501, table.begin() + 501 + rows);
    return folder.write("f.csv", text_of(table));
  };
  const Streamed good = streamed(folder.write("good.csv", text_of(healthy())));
  for (const long rows : {1, 7, 31}) {
    const Streamed sorted = streamed(late_by(rows), {}, {.window_rows = 32});
    EXPECT_EQ(sorted.warnings.at(0), "W-ORDER x1");
    expect_same_samples(sorted.imu, good.imu);
  }
  const Streamed lost = streamed(late_by(200), {.repair = true}, {.window_rows = 32});
  EXPECT_NE(lost.error.find("E-ORDER"), std::string::npos) << lost.error;
  EXPECT_NE(lost.error.find("later than 32 others"), std::string::npos) << lost.error;
}

TEST(ImuStream, JudgesLongRecordingsAtTheirEnd) {
  const ScratchFolder folder;
  const auto code_of = [&](const std::function<void(Rows&)>& edit, const ReadOptions& options = {}) {
    const Streamed got = streamed(folder.write("f.csv", edited(edit)), options, {.window_rows = 64});
    return got.error.empty() ? "" : got.error.substr(6, got.error.find(']') - 6);
  };
  EXPECT_EQ(code_of([](Rows&) {}), "");
  EXPECT_EQ(code_of([](Rows& r) { std::reverse(r.begin(), r.end()); }), "E-ORDER");
  EXPECT_EQ(code_of([](Rows& r) {
              for (std::size_t i = 1500; i < r.size(); ++i) r[i].t -= 20;
            }),
            "E-TIME-RESET");
  EXPECT_EQ(code_of([](Rows& r) {
              for (std::size_t i = 1990; i < r.size(); ++i) r[i].t -= 60;
            }),
            "E-TIME-RESET");
  EXPECT_EQ(code_of([](Rows& r) {
              for (std::size_t i = 400; i < 440; ++i) r[2 * i].t = r[2 * i + 1].t;
            }),
            "E-DUPLICATE");
  EXPECT_EQ(code_of([](Rows& r) {
              for (Row& row : r) row.t = std::floor(row.t * 100) / 100;
            }),
            "E-TIME-PRECISION");
  EXPECT_EQ(code_of([](Rows& r) {
              for (Row& row : r) row.t = 5;
            }),
            "E-TIME-CONSTANT");
  EXPECT_EQ(code_of([](Rows& r) {  // 200 Hz, then a row each hour
              for (std::size_t i = 100; i < r.size(); ++i) r[i].t += 3600.0 * static_cast<double>(i);
            }),
            "E-TIME-UNIT");
  EXPECT_EQ(code_of([](Rows& r) {
              for (std::size_t i = 100; i < 130; ++i) r[i].t = -1;
            }),
            "E-TIME-RANGE");
  EXPECT_EQ(code_of([](Rows& r) {
              for (std::size_t i = 100; i < 130; ++i) r[i].values[0] = INFINITY;
            }),
            "E-NONFINITE");
  EXPECT_EQ(code_of([](Rows& r) {
              for (Row& row : r) row.values = {0, 0, 0, 0, 0, 9.81};
            }),
            "E-CONSTANT");
}

TEST(ImuStream, HoldsAFewWindowsWhateverTheLength) {
  const ScratchFolder folder;
  const std::size_t window = 64, block = 4096;
  std::string text = "t,gx,gy,gz,ax,ay,az\n";
  for (int i = 0; i < 50000; ++i) {
    text += std::to_string(100 + i / 200) + "." + std::to_string(1000 + i % 200 * 5).substr(1) + ",0.1,0.2,0.";
    text += std::to_string(1 + i % 7) + ",0.3,0.4,9.81\n";
  }
  const Streamed got = streamed(folder.write("f.csv", text), {}, {.block_bytes = block, .window_rows = window});
  EXPECT_EQ(got.error, "");
  EXPECT_EQ(got.imu.size(), 50000u);
  EXPECT_LE(got.result.largest_window, 8 * window);
  EXPECT_LE(got.result.largest_buffer, 2 * block);
}

TEST(ImuStream, ALongLineIsRefusedBeforeItIsHeld) {
  const ScratchFolder folder;
  const std::string text = text_of(healthy()) + std::string(std::size_t{4} << 20, '7');
  const Streamed got = streamed(folder.write("f.csv", text), {}, {.block_bytes = 1 << 16});
  EXPECT_NE(got.error.find("E-LIMIT"), std::string::npos);
  std::string only_comments;
  for (int i = 0; i < 1000000; ++i) only_comments += "# a comment\n";
  const Streamed comments = streamed(folder.write("f.csv", only_comments));
  EXPECT_NE(comments.error.find("E-LIMIT"), std::string::npos) << comments.error;
}

TEST(ImuStream, ReportsProgressAndCanBeStopped) {
  const ScratchFolder folder;
  const std::string path = folder.write("f.csv", text_of(healthy()));
  std::uint64_t last = 0, size = std::filesystem::file_size(path);
  const auto progress = [&](std::uint64_t done, std::uint64_t total) {
    EXPECT_GE(done, last);
    EXPECT_EQ(total, size);
    last = done;
  };
  streamed(path, {}, {.progress = progress, .block_bytes = 4096});
  EXPECT_EQ(last, size);
  const auto stop = [](std::uint64_t done, std::uint64_t) {
    if (done > 50000) throw std::runtime_error("stopped");
  };
  EXPECT_THROW(streamed(path, {}, {.progress = stop, .block_bytes = 4096}), std::runtime_error);
}

}  // namespace
}  // namespace vispline
