#include "vispline/calibration/yaml.h"

#include <gtest/gtest.h>

#include "vispline/core/error.h"

namespace vispline {
namespace {

/// "E-YAML f:1:2 message", empty if the text can be read.
std::string failure_of(const std::string& text) {
  try {
    parse_yaml("f", text);
  } catch (const Error& error) {
    const Diagnostic& d = error.diagnostic();
    EXPECT_EQ(error.exit_code(), d.code == "E-LIMIT" ? ExitCode::kLimit : ExitCode::kUsage);
    return d.code + " " + d.where + " " + d.message;
  }
  return "";
}

std::string repeated(const std::string& unit, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += unit;
  return text;
}

TEST(Yaml, KeysValuesAndPlaces) {
  const YamlFile file = parse_yaml("f", "a: 1.5\nb:\n  c: [x, \"2\", ~]\n  d: 'it''s'\n");
  EXPECT_FALSE(file.is_opencv);
  const YamlNode& root = file.root;
  ASSERT_NE(root.find("a"), nullptr);
  EXPECT_EQ(root.find("a")->text, "1.5");
  EXPECT_EQ(root.find("z"), nullptr);
  const YamlNode& c = *root.find("b")->find("c");
  ASSERT_EQ(c.items.size(), 3u);
  EXPECT_EQ(c.items[0].text, "x");
  EXPECT_FALSE(c.items[0].is_quoted);
  EXPECT_TRUE(c.items[1].is_quoted);
  EXPECT_EQ(c.items[2].kind, YamlNode::Kind::kNull);
  EXPECT_EQ(file.at(c.items[1].place), "f:3:10");
  EXPECT_EQ(file.at(root.find("b")->keys[1].place), "f:4:3");
  EXPECT_EQ(root.find("b")->find("d")->text, "it's");
}

TEST(Yaml, RepairsThatChangeNoValueAreSilent) {
  for (const char* text :
       {"\xEF\xBB\xBF%YAML:1.0\r\na: 1\r\n", "# c\r\n\r\na: 1  # c\r\n", "---\na: 1\n...\n", "{\"a\":1}",
        "%YAML:1.0 # head\n---\na: 1", "  a: 1\n  b: 2\n", "{\n\t\"a\": 1,\n\t\"b\": [\n\t\t1\n\t]\n}\n"}) {
    ASSERT_EQ(failure_of(text), "") << text;
    EXPECT_EQ(parse_yaml("f", text).root.find("a")->text, "1") << text;
  }
}

TEST(Yaml, OpencvMatrixUnderItsHeadOnly) {
  const std::string matrix = "T: !!opencv-matrix\n   rows: 1\n   cols: 2\n   dt: d\n   data: [ 1., 2.,\n\t\t]\n";
  const YamlFile file = parse_yaml("f", "%YAML:1.0\n" + matrix);
  EXPECT_TRUE(file.is_opencv);
  EXPECT_TRUE(file.root.find("T")->is_opencv_matrix);
  EXPECT_EQ(file.root.find("T")->find("data")->items.size(), 2u);
  EXPECT_EQ(failure_of(matrix), "E-YAML f:1:4 tag !!opencv-matrix in a file that does not start with %YAML:1.0");
}

TEST(Yaml, MalformedTextIsAnErrorWithItsPlace) {
  struct Case {
    const char *text, *failure;
  };
  for (const Case& c : {
           Case{"a:\n\tb: 1\n", "E-YAML f:2:1 a tab in the indentation"},
           {"a: 1\nb: [1, 2\n", "E-YAML f:3:1 end of sequence flow not found"},
           {"a: {b: 1", "E-YAML f:1:9 end of map flow not found"},
           {"a: \"x", "E-YAML f:1:6 illegal EOF in scalar"},
           {"a: 1\n b: 2\n", "E-YAML f:2:3 illegal map value"},
           {"- 1\n- 2\n", "E-YAML f:1:1 the file does not hold keys with values"},
           {"hello\n", "E-YAML f:1:1 the file does not hold keys with values"},
           {"", "E-YAML f no values in the file"},
           {"# nothing\n\n", "E-YAML f no values in the file"},
           {"a: 1\n---\nb: 2\n", "E-YAML f a second document in the file"},
           {"a: *b\n", "E-YAML f:1:4 the referenced anchor is not defined"},
           {"a: !!python/object:os.system x\n",
            "E-YAML f:1:4 tag 'tag:yaml.org,2002:python/object:os.system': tags are not read"},
           {"a: !mine {b: 1}\n", "E-YAML f:1:4 tag '!mine': tags are not read"},
           {"%TAG ! tag:x.y,2000:\n---\na: !mine 1\n", "E-YAML f:3:4 tag 'tag:x.y,2000:mine': tags are not read"},
           {"%YAML:1.0\na: !!opencv-matrix [1]\n",
            "E-YAML f:2:4 tag 'tag:yaml.org,2002:opencv-matrix': tags are not read"},
           {"a: 1\nb: \x04 2\n", "E-YAML f:2:4 control byte '\\x04'"},
           {"? [x]\n: 1\n", "E-YAML f:1:3 a key that is not a word"},
           {"a: 1\nb: 2\na: 3\n", "E-CONFIG f:3:1 key 'a' comes twice"},
       }) {
    EXPECT_EQ(failure_of(c.text), c.failure) << c.text;
  }
}

TEST(Yaml, AliasesAreReplacedWithinABudget) {
  const YamlFile file = parse_yaml("f", "a: &x {b: 1}\nc: [*x, *x]\n");
  EXPECT_EQ(file.root.find("c")->items[1].find("b")->text, "1");
  std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 9; ++i) {
    const std::string last = "*a" + std::to_string(i - 1);
    bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + repeated(last + ", ", 9) + last + "]\n";
  }
  EXPECT_TRUE(failure_of(bomb).starts_with("E-LIMIT f:4:")) << failure_of(bomb);
  EXPECT_EQ(failure_of("a: &x [1, *x]\n"), "E-LIMIT f:1:11 an alias inside the node that it stands for");
  EXPECT_EQ(failure_of("&r a: &x\n  b: *x\n"), "E-LIMIT f:2:6 an alias inside the node that it stands for");
}

TEST(Yaml, DepthSizeAndNumberOfValues) {
  EXPECT_EQ(failure_of("a: " + repeated("[", 63) + repeated("]", 63)), "");
  EXPECT_TRUE(failure_of("a: " + repeated("[", 64) + repeated("]", 64)).starts_with("E-LIMIT"));
  EXPECT_TRUE(failure_of("a: &x " + repeated("[", 40) + repeated("]", 40) + "\nb: " + repeated("[", 40) + "*x" +
                         repeated("]", 40))
                  .starts_with("E-LIMIT"));
  EXPECT_EQ(failure_of("a: 1\n#" + std::string(yaml_limits::kBytes - 6, 'x')), "");
  EXPECT_TRUE(failure_of("a: 1\n#" + std::string(yaml_limits::kBytes - 5, 'x')).starts_with("E-LIMIT"));
  EXPECT_TRUE(failure_of("a: [" + repeated("1,", 100'000) + "]").starts_with("E-LIMIT"));
  std::string keys;
  for (int i = 0; i <= 1000; ++i) keys += "k" + std::to_string(i) + ": 1\n";
  EXPECT_TRUE(failure_of(keys).starts_with("E-LIMIT f:1001:1"));
}

TEST(Yaml, HostileTextEndsInBoundedWork) {
  for (const std::string unit : {"[",     "{",        "- ",   "? ",   "a: [", "&a ",  "*",  "!",    "\"",
                                 "'",     "|\n",      "{a: ", "[a, ", "x: ",  "- - ", "\n", " \n",  "a\n",
                                 "? a\n", "\xC3\x28", "%a\n", "{? ",  "[? ",  ",",    "]",  "-\n ", ": "}) {
    const std::size_t count = yaml_limits::kBytes / 2 / unit.size();
    EXPECT_NE(failure_of(repeated(unit, count)), "") << unit;
    failure_of("a: " + repeated(unit, count));  // no other exception, no crash
  }
}

TEST(Yaml, ReadsOnlyFilesThatExist) { EXPECT_THROW(read_yaml("/nonexistent/imu.yaml"), Error); }

}  // namespace
}  // namespace vispline
