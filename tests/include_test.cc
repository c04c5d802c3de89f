// The two tables of docs/architecture.md against every #include of src/vispline and against the edges of
// CMakeLists.txt.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;
using Table = std::map<std::string, Names>;  // left of the arrow -> right of it

const fs::path kRoot = VISPLINE_SOURCE_DIR;

std::string read(const fs::path& path) {
  std::ifstream file(path);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

Names words(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

/// The lines `left... -> right...` of the fenced block ```name; several names on the left share the right side.
Table fenced_table(const std::string& markdown, const std::string& name) {
  Table table;
  const std::size_t begin = markdown.find("```" + name + "\n");
  if (begin == std::string::npos) return table;
  std::istringstream block(markdown.substr(begin, markdown.find("\n```", begin) - begin));
  for (std::string line; std::getline(block, line);) {
    const std::size_t arrow = line.find("->");
    if (arrow == std::string::npos) continue;
    for (const std::string& left : words(line.substr(0, arrow))) table[left] = words(line.substr(arrow + 2));
  }
  return table;
}

Table architecture(const std::string& name) { return fenced_table(read(kRoot / "docs/architecture.md"), name); }

struct Include {
  std::string target;
  bool quoted = false;
};

std::vector<Include> includes(const std::string& source) {
  static const std::regex pattern(R"re(^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"])re", std::regex::multiline);
  std::vector<Include> found;
  for (std::sregex_iterator it(source.begin(), source.end(), pattern), end; it != end; ++it) {
    found.push_back({(*it)[2], (*it)[1] == "\""});
  }
  return found;
}

bool is_test(const std::string& file) { return file.ends_with("_test.cc") || file.ends_with("_testing.h"); }

/// What file `path` ("core/so3.h", relative to src/vispline) includes although the tables do not let it.
std::vector<std::string> violations(const std::string& path, const std::string& source, const Table& folders,
                                    const Table& libraries) {
  std::vector<std::string> found;
  if (is_test(path)) return found;
  const std::string folder = path.substr(0, path.find('/'));
  for (const Include& include : includes(source)) {
    if (include.quoted) {
      static const std::regex own(R"(vispline/([a-z_0-9]+)/.+)");
      std::smatch match;
      const bool permitted = std::regex_match(include.target, match, own) && !is_test(include.target) &&
                             folders.contains(folder) && (match[1] == folder || folders.at(folder).contains(match[1]));
      if (!permitted) found.push_back(path + " includes " + include.target);
    }
    for (const auto& [prefix, places] : libraries) {
      if (!include.target.starts_with(prefix)) continue;
      if (!places.contains(folder) && !places.contains(path)) found.push_back(path + " includes " + include.target);
    }
  }
  return found;
}

std::vector<fs::path> sources(const fs::path& folder) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path& path = entry.path();
    if (path.extension() == ".h" || path.extension() == ".cc") found.push_back(path);
  }
  return found;
}

TEST(Includes, EveryFileKeepsToTheTables) {
  const Table folders = architecture("includes"), libraries = architecture("libraries");
  const fs::path root = kRoot / "src/vispline";
  const auto files = sources(root);
  EXPECT_GT(files.size(), 20u);
  for (const fs::path& file : files) {
    for (const std::string& violation : violations(fs::relative(file, root).string(), read(file), folders, libraries)) {
      ADD_FAILURE() << violation;
    }
  }
}

TEST(Includes, TheTableNamesTheFoldersThatExist) {
  Names tabled, present;
  for (const auto& [folder, edges] : architecture("includes")) tabled.insert(folder);
  for (const auto& entry : fs::directory_iterator(kRoot / "src/vispline")) {
    if (!fs::is_empty(entry)) present.insert(entry.path().filename().string());
  }
  EXPECT_EQ(tabled, present);
}

TEST(Includes, CMakeRepeatsTheTable) {
  const Table folders = architecture("includes");
  const std::string text = read(kRoot / "CMakeLists.txt");
  const std::regex call(R"(vispline_folder\((\w+)([^)]*)\))");
  Table edges;
  for (std::sregex_iterator it(text.begin(), text.end(), call), end; it != end; ++it) {
    Names& mine = edges[(*it)[1]];
    for (const std::string& word : words((*it)[2])) {
      if (folders.contains(word)) mine.insert(word);
    }
  }
  EXPECT_EQ(edges, folders);
}

TEST(Includes, TheTableHasNoCycle) {
  Table rest = architecture("includes");
  for (bool progress = true; progress && !rest.empty();) {
    progress = std::erase_if(rest, [&](const auto& row) {
                 return std::ranges::none_of(row.second, [&](const auto& name) { return rest.contains(name); });
               }) > 0;
  }
  EXPECT_TRUE(rest.empty()) << rest.begin()->first;
}

class PlantedInclude : public ::testing::Test {
 protected:
  std::size_t count(const std::string& path, const std::string& line) const {
    return violations(path, "#pragma once\n" + line + "\nint x;\n", folders_, libraries_).size();
  }
  const Table folders_ = fenced_table("text\n```includes\ncore ->\nsensors optics -> core\n```\n", "includes");
  const Table libraries_ = fenced_table("```libraries\nRandom123/ -> core/random.cc\nzlib.h -> io\n```\n", "libraries");
};

TEST_F(PlantedInclude, OfAnotherFolderIsCaught) {
  EXPECT_EQ(count("core/time.h", "#include \"vispline/sensors/rig.h\""), 1u);
  EXPECT_EQ(count("sensors/rig.h", "  #  include \"vispline/optics/lens.h\""), 1u);
  EXPECT_EQ(count("sensors/rig.h", "#include \"vispline/core/time.h\""), 0u);
  EXPECT_EQ(count("optics/lens.h", "#include \"vispline/optics/ray.h\""), 0u);
  EXPECT_EQ(count("core/time_test.cc", "#include \"vispline/sensors/rig.h\""), 0u);
}

TEST_F(PlantedInclude, OfALibraryIsCaughtOutsideItsPlace) {
  EXPECT_EQ(count("core/time.h", "#include <Random123/philox.h>"), 1u);
  EXPECT_EQ(count("core/random.cc", "#include <Random123/philox.h>"), 0u);
  EXPECT_EQ(count("core/time.h", "#include <zlib.h>"), 1u);
  EXPECT_EQ(count("core/time.h", "#include <vector>"), 0u);
}

TEST_F(PlantedInclude, ByRelativePathOrOfATestHelperIsCaught) {
  EXPECT_EQ(count("core/time.h", "#include \"so3.h\""), 1u);
  EXPECT_EQ(count("core/time.h", "#include \"vispline/core/lie_testing.h\""), 1u);
  EXPECT_EQ(count("folder_nobody_knows/x.h", "#include \"vispline/core/time.h\""), 1u);
}

}  // namespace
