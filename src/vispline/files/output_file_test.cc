#include "vispline/files/output_file.h"

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "vispline/files/input_file.h"
#include "vispline/io/io_testing.h"

namespace vispline {
namespace {

template <class Work>
std::string failure_of(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::kOutput);
    EXPECT_EQ(error.diagnostic().code, "E-OUTPUT");
    return error.diagnostic().message;
  }
  return "";
}

std::size_t files_in(const std::string& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

TEST(OutputFile, PublishesWholeFilesUnderTheUmask) {
  const ScratchFolder folder;
  const std::string path = folder.path("new/sub/result.csv");
  OutputFile file(path);
  file.write("abc");
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_EQ(files_in(folder.path("new/sub")), 1u);
  file.publish();
  EXPECT_EQ(file_bytes(path), "abc");
  EXPECT_EQ(files_in(folder.path("new/sub")), 1u);
  const mode_t mask = ::umask(0);
  ::umask(mask);
  struct stat info {};
  ASSERT_EQ(::stat(path.c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777, 0666 & ~mask);
}

TEST(OutputFile, PatchesWhatWasWritten) {
  const ScratchFolder folder;
  OutputFile file(folder.path("x"));
  file.write("0123456789");
  file.patch(2, "ab");
  EXPECT_THROW(file.patch(9, "ab"), Error);
  file.write("z");
  file.publish();
  EXPECT_EQ(file_bytes(folder.path("x")), "01ab456789z");
  EXPECT_THROW(OutputFile(folder.path("x.gz")).patch(0, ""), Error);
}

TEST(OutputFile, VanishesUnlessPublished) {
  const ScratchFolder folder;
  {
    OutputFile file(folder.path("x"));
    file.write(std::string(3 << 20, 'x'));
    OutputFile moved(std::move(file));
    EXPECT_EQ(files_in(folder.path("")), 1u);
  }
  EXPECT_EQ(files_in(folder.path("")), 0u);
}

TEST(OutputFile, KeepsAnOldResultUnlessForced) {
  const ScratchFolder folder;
  const std::string path = folder.write("x", "old");
  EXPECT_NE(failure_of([&] { write_file(path, "new"); }).find("it exists"), std::string::npos);
  EXPECT_EQ(file_bytes(path), "old");
  {
    OutputFile unfinished(path, {.force = true});
    unfinished.write("half");
  }
  EXPECT_EQ(file_bytes(path), "old");
  write_file(path, "new", {.force = true});
  EXPECT_EQ(file_bytes(path), "new");
}

TEST(OutputFile, DoesNotReplaceAFileThatAppearsMeanwhile) {
  const ScratchFolder folder;
  OutputFile file(folder.path("x"));
  file.write("mine");
  folder.write("x", "theirs");
  EXPECT_NE(failure_of([&] { file.publish(); }).find("it exists"), std::string::npos);
  EXPECT_EQ(file_bytes(folder.path("x")), "theirs");
}

TEST(OutputFile, RefusesWhatIsNoPlaceForAFile) {
  const ScratchFolder folder;
  folder.write("file", "");
  ASSERT_EQ(::symlink("/dev/full", folder.path("link").c_str()), 0);
  for (const std::string& path : {std::string("/dev/full"), folder.path("link"), folder.path("file/below"),
                                  folder.path(""), std::string("/proc/no/such"), std::string()}) {
    EXPECT_NE(failure_of([&] { write_file(path, "x", {.force = true}); }), "") << path;
    EXPECT_NE(failure_of([&] { probe_output(path, 1, {.force = true}); }), "") << path;
  }
}

TEST(OutputFile, ReadOnlyFolder) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const ScratchFolder folder;
  std::filesystem::create_directory(folder.path("closed"));
  ::chmod(folder.path("closed").c_str(), 0500);
  EXPECT_NE(failure_of([&] { write_file(folder.path("closed/x"), "x"); }).find("denied"), std::string::npos);
}

/// The disk fills up at `limit` bytes, in a process of its own.
int child_result(const std::string& path, rlim_t limit) {
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limits{limit, limit};
    ::setrlimit(RLIMIT_FSIZE, &limits);
    try {
      write_file(path, std::string(5 << 20, 'x'), {.force = true});
    } catch (const Error& error) {
      ::_exit(static_cast<int>(error.exit_code()));
    }
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WEXITSTATUS(status);
}

TEST(OutputFile, AFullDiskLeavesTheOldResult) {
  const ScratchFolder folder;
  const std::string path = folder.write("x", "old");
  for (const rlim_t limit : {rlim_t{0}, rlim_t{1}, rlim_t{1 << 20}, rlim_t{(5 << 20) - 1}}) {
    EXPECT_EQ(child_result(path, limit), 6) << limit;
    EXPECT_EQ(file_bytes(path), "old");
    EXPECT_EQ(files_in(folder.path("")), 1u);
  }
  EXPECT_EQ(child_result(path, 5 << 20), 0);
  EXPECT_EQ(file_bytes(path).size(), std::size_t{5} << 20);
}

TEST(OutputFile, ProbeLeavesNothingAndSeesAFullDisk) {
  const ScratchFolder folder;
  probe_output(folder.path("sub/x"), 1000);
  EXPECT_EQ(files_in(folder.path("sub")), 0u);
  EXPECT_NE(failure_of([&] { probe_output(folder.path("x"), UINT64_MAX / 2); }).find("room"), std::string::npos);
}

TEST(OutputFile, CompressesBySuffix) {
  const ScratchFolder folder;
  std::string text;
  for (int i = 0; i < 300000; ++i) text += std::to_string(i) + "\n";
  for (const char* name : {"a.csv.gz", "a.csv.xz"}) {
    OutputFile file(folder.path(name));
    for (std::size_t pos = 0; pos < text.size(); pos += 77777) file.write(std::string_view(text).substr(pos, 77777));
    file.publish();
    EXPECT_LT(std::filesystem::file_size(folder.path(name)), text.size() / 2);
    EXPECT_EQ(read_text_file(folder.path(name)), text);
  }
}

}  // namespace
}  // namespace vispline
