#include "vispline/calibration/yaml.h"

#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <exception>
#include <sstream>

#include "vispline/calibration/yaml_error.h"
#include "vispline/calibration/yaml_tree_builder.h"
#include "vispline/files/small_file.h"

namespace vispline {
namespace {

constexpr std::string_view kOpencvHead = "%YAML:";

/// The first byte of control; yaml-cpp takes 0x04 for the end of the file.
void refuse_control_bytes(const YamlFile& file, std::string_view text) {
  YamlPlace place{1, 1};
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte < 0x20 && c != '\t' && c != '\n' && c != '\r') || byte == 0x7f) {
      fail_yaml("control byte " + vispline::quoted(std::string(1, c)), file.at(place));
    }
    place = c == '\n' ? YamlPlace{place.line + 1, 1} : YamlPlace{place.line, place.column + 1};
  }
}

/// yaml-cpp reads ahead as long as brackets stay open, and would hold 240 bytes for each. Brackets in quotes and
/// comments are counted as well, hence the wide margin over kDepth.
void refuse_open_brackets(const YamlFile& file, std::string_view text) {
  constexpr int kMost = 1000;
  int open = 0;
  for (const char c : text) {
    open += (c == '[' || c == '{') - (c == ']' || c == '}');
    if (open > kMost) fail_yaml_limit("more than " + std::to_string(kMost) + " open brackets", file.path);
  }
}

/// The place behind the last byte.
YamlPlace end_of(std::string_view text) {
  const auto lines = static_cast<int>(std::ranges::count(text, '\n'));
  return {lines + 1, static_cast<int>(text.size() - (text.rfind('\n') + 1)) + 1};
}

/// The first line up to `last` that is indented by a tab, 0 if there is none.
int tab_line(std::string_view text, int last) {
  int line = 1;
  for (std::size_t begin = 0; begin < text.size() && line <= last; ++line) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view row = text.substr(begin, end - begin);
    const std::size_t word = std::min(row.find_first_not_of(" \t\r"), row.size());
    if (word < row.size() && row.substr(0, word).find('\t') != row.npos) return line;
    begin = end + 1;
  }
  return 0;
}

[[noreturn]] void fail_syntax(const YamlFile& file, std::string_view text, const YAML::Exception& error) {
  // Where the file ends too early, yaml-cpp gives no column.
  const bool at_end = error.mark.is_null() || static_cast<std::size_t>(error.mark.pos) >= text.size();
  const YamlPlace place = at_end ? end_of(text) : YamlPlace{error.mark.line + 1, error.mark.column + 1};
  if (const int tab = tab_line(text, place.line)) {
    fail_yaml("a tab in the indentation", file.at({tab, 1}), "indent with blanks");
  }
  fail_yaml(error.msg, file.at(place));
}

/// The only document of `text`.
YamlNode parse_document(const YamlFile& file, const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  YamlTreeBuilder builder(file);
  if (!parser.HandleNextDocument(builder)) fail_yaml("no values in the file", file.path);
  YamlNode root = builder.take();
  YamlTreeBuilder second(file);
  if (parser.HandleNextDocument(second)) fail_yaml("a second document in the file", file.path, "keep one of them");
  return root;
}

}  // namespace

const YamlNode* YamlNode::find(std::string_view key) const {
  const auto found = std::ranges::find(keys, key, &YamlKey::text);
  return found == keys.end() ? nullptr : &items[static_cast<std::size_t>(found - keys.begin())];
}

std::string YamlFile::at(YamlPlace place) const {
  return path + ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
}

YamlFile parse_yaml(std::string path, std::string_view text) {
  YamlFile file{.path = std::move(path), .is_opencv = false, .root = {}};
  if (text.size() > yaml_limits::kBytes) {
    fail_yaml_limit("more than " + std::to_string(yaml_limits::kBytes) + " bytes", file.path);
  }
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  refuse_control_bytes(file, text);
  refuse_open_brackets(file, text);
  std::string body(text);
  file.is_opencv = body.starts_with(kOpencvHead);
  // The head of OpenCV is not a directive of YAML; blanks in its place keep the columns and lines.
  if (file.is_opencv) std::fill_n(body.begin(), std::min(body.find_first_of("\r\n"), body.size()), ' ');
  try {
    file.root = parse_document(file, body);
  } catch (const YAML::Exception& error) {
    fail_syntax(file, body, error);
  } catch (const std::logic_error& error) {  // yaml-cpp lets a few of the standard library through
    fail_yaml(error.what(), file.path);
  }
  if (file.root.kind != YamlNode::Kind::kMap) {
    fail_yaml("the file does not hold keys with values", file.at(file.root.place));
  }
  return file;
}

YamlFile read_yaml(const std::string& path) {
  return parse_yaml(path, read_small_text_file(path, yaml_limits::kBytes));
}

}  // namespace vispline
