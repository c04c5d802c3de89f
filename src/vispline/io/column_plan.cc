#include "vispline/io/column_plan.h"

#include <algorithm>
#include <cctype>
#include <numbers>

#include "vispline/io/text_cells.h"

namespace vispline {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kStandardGravity = 9.80665;  // m/s^2 in one g, by definition

struct Prefix {
  std::string_view text;
  Channel first;  ///< channel of axis x
};

/// A name is a prefix and an axis: "gyr_" + "x".
constexpr std::array kPrefixes = {
    Prefix{"g", kGyroX},
    Prefix{"gyr", kGyroX},
    Prefix{"gyro", kGyroX},
    Prefix{"w", kGyroX},
    Prefix{"omega", kGyroX},
    Prefix{"w_rs_s", kGyroX},
    Prefix{"gyroscope", kGyroX},
    Prefix{"angular_velocity", kGyroX},
    Prefix{"ang_vel", kGyroX},
    Prefix{"a", kAccelX},
    Prefix{"acc", kAccelX},
    Prefix{"accel", kAccelX},
    Prefix{"a_rs_s", kAccelX},
    Prefix{"accelerometer", kAccelX},
    Prefix{"linear_acceleration", kAccelX},
    Prefix{"lin_acc", kAccelX},
    Prefix{"specific_force", kAccelX},
    Prefix{"", kPositionX},
    Prefix{"p", kPositionX},
    Prefix{"t", kPositionX},
    Prefix{"pos", kPositionX},
    Prefix{"position", kPositionX},
    Prefix{"p_rs_r", kPositionX},
    Prefix{"pose.position", kPositionX},
    Prefix{"q", kQuaternionX},
    Prefix{"quat", kQuaternionX},
    Prefix{"q_rs", kQuaternionX},
    Prefix{"quaternion", kQuaternionX},
    Prefix{"orientation", kQuaternionX},
    Prefix{"pose.orientation", kQuaternionX},
};

constexpr std::array<std::string_view, 7> kTimeNames = {"t",     "time", "timestamp",   "timestamps",
                                                        "stamp", "ts",   "header.stamp"};
constexpr std::array<std::string_view, 4> kIndexNames = {"index", "idx", "sample", "row"};
constexpr std::array<std::string_view, 6> kSecNames = {
    "sec", "secs", "stamp.sec", "stamp.secs", "header.stamp.sec", "header.stamp.secs"};
constexpr std::array<std::string_view, 9> kNsecNames = {"nsec",
                                                        "nsecs",
                                                        "nanosec",
                                                        "stamp.nsec",
                                                        "stamp.nsecs",
                                                        "stamp.nanosec",
                                                        "header.stamp.nsec",
                                                        "header.stamp.nsecs",
                                                        "header.stamp.nanosec"};

/// Units that follow a name after an underscore, "gyro_x_dps".
constexpr std::array<std::string_view, 22> kSuffixes = {
    "s",   "sec", "ms", "us",   "ns",   "nsec",     "dps",   "deg_s", "deg_per_s", "rad_s",  "rad_per_s",
    "rps", "g",   "mg", "m_s2", "mps2", "m_per_s2", "m_s^2", "m",     "rad_s^-1",  "m_s^-2", "deg_s^-1"};

struct Scale {
  std::string_view unit;
  double factor;
};

constexpr std::array kGyroUnits = {
    Scale{"rad/s", 1.0},          Scale{"rad s^-1", 1.0},           Scale{"rad_s", 1.0},
    Scale{"rad_per_s", 1.0},      Scale{"rad_s^-1", 1.0},           Scale{"rps", 1.0},
    Scale{"deg/s", kDegree},      Scale{"deg s^-1", kDegree},       Scale{"deg_s", kDegree},
    Scale{"deg_per_s", kDegree},  Scale{"deg_s^-1", kDegree},       Scale{"dps", kDegree},
    Scale{"\xc2\xb0/s", kDegree}, Scale{"deg/h", kDegree / 3600.0}, Scale{"deg_per_h", kDegree / 3600.0}};
constexpr std::array kAccelUnits = {
    Scale{"m/s^2", 1.0},       Scale{"m s^-2", 1.0},         Scale{"m/s/s", 1.0},
    Scale{"m/s2", 1.0},        Scale{"m_s2", 1.0},           Scale{"mps2", 1.0},
    Scale{"m_per_s2", 1.0},    Scale{"m_s^2", 1.0},          Scale{"m_s^-2", 1.0},
    Scale{"m/s\xc2\xb2", 1.0}, Scale{"g", kStandardGravity}, Scale{"mg", kStandardGravity * 1e-3}};

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return out;
}

/// "x", "y", "z" or "w" at the end, after '_', '.' or nothing.
std::optional<Channel> channel_of(std::string_view name) {
  const auto is_one_of = [&](const auto& names) { return std::find(names.begin(), names.end(), name) != names.end(); };
  if (is_one_of(kTimeNames)) return kTimeColumn;
  if (is_one_of(kIndexNames)) return kIndexColumn;
  if (is_one_of(kSecNames)) return kSecColumn;
  if (is_one_of(kNsecNames)) return kNsecColumn;
  constexpr std::string_view kAxes = "xyzw";
  const std::size_t axis = name.empty() ? std::string_view::npos : kAxes.find(name.back());
  if (axis == std::string_view::npos) return std::nullopt;
  name.remove_suffix(1);
  if (!name.empty() && (name.back() == '_' || name.back() == '.')) name.remove_suffix(1);
  for (const Prefix& prefix : kPrefixes) {
    if (prefix.text != name || (axis == 3 && prefix.first != kQuaternionX)) continue;
    return static_cast<Channel>(prefix.first + static_cast<int>(axis));
  }
  return std::nullopt;
}

/// Takes "[unit]" or "(unit)" off the end of a name.
std::string take_bracket(std::string& name) {
  if (name.empty() || (name.back() != ']' && name.back() != ')')) return "";
  const std::size_t open = name.rfind(name.back() == ']' ? '[' : '(');
  if (open == std::string::npos) return "";
  const std::string unit(trimmed(std::string_view(name).substr(open + 1, name.size() - open - 2)));
  name = trimmed(std::string_view(name).substr(0, open));
  return unit;
}

ColumnName take_suffix(const std::string& name) {
  for (const std::string_view suffix : kSuffixes) {
    if (name.size() <= suffix.size() + 1 || !name.ends_with(suffix)) continue;
    const std::size_t stem = name.size() - suffix.size() - 1;
    if (name[stem] != '_') continue;
    if (const auto channel = channel_of(name.substr(0, stem))) return {channel, std::string(suffix)};
  }
  return {};
}

bool is_gyro(Channel channel) { return channel >= kGyroX && channel <= kGyroZ; }
bool is_accel(Channel channel) { return channel >= kAccelX && channel <= kAccelZ; }

template <class Table>
std::optional<double> factor_of(const Table& table, std::string_view unit) {
  for (const Scale& scale : table) {
    if (scale.unit == unit) return scale.factor;
  }
  return std::nullopt;
}

template <class Table>
double factor_of_flag(const Table& table, const std::string& unit, const char* flag, const char* known) {
  if (const auto factor = factor_of(table, lower(unit))) return *factor;
  throw Error(ExitCode::kUsage, {.code = "E-ARGUMENT",
                                 .message = "unknown unit " + vispline::quoted(unit),
                                 .where = flag,
                                 .effect = "nothing read",
                                 .next = std::string("pass ") + known});
}

[[noreturn]] void fail_unit(const ReadContext& context, const std::string& unit) {
  context.fail(ExitCode::kInput, "E-COLUMNS", "unknown unit " + vispline::quoted(unit) + " in a column name",
               context.path(), "pass --columns with known units, such as \"t [ns],gx [deg/s],...,ax [g],...\"");
}

/// Notes the unit of one column; all axes of a triad must agree.
void set_unit(const ReadContext& context, const ColumnName& name, ColumnPlan& plan) {
  const Channel channel = *name.channel;
  if (name.unit.empty()) return;
  if (channel == kTimeColumn) {
    plan.time_unit = time_unit_named(name.unit);
    if (!plan.time_unit) fail_unit(context, name.unit);
  } else if (is_gyro(channel) || is_accel(channel)) {
    if (!(is_gyro(channel) ? context.options().gyro_unit : context.options().accel_unit).empty()) return;
    const auto factor = is_gyro(channel) ? factor_of(kGyroUnits, name.unit) : factor_of(kAccelUnits, name.unit);
    std::optional<double>& triad = is_gyro(channel) ? plan.gyro_unit : plan.accel_unit;
    if (!factor || (triad && *triad != *factor)) fail_unit(context, name.unit);
    triad = factor;
  } else if (channel >= kPositionX && channel <= kPositionZ && name.unit != "m") {
    fail_unit(context, name.unit);
  }
}

void add_column(const ReadContext& context, const ColumnName& name, std::size_t index, ColumnPlan& plan) {
  int& column = plan.column[static_cast<std::size_t>(*name.channel)];
  if (column >= 0) {
    context.fail(ExitCode::kInput, "E-COLUMNS",
                 "columns " + std::to_string(column + 1) + " and " + std::to_string(index + 1) + " have one meaning",
                 context.path(), "pass --columns with - for the one to skip");
  }
  column = static_cast<int>(index);
  set_unit(context, name, plan);
}

}  // namespace

ColumnName parse_column_name(std::string_view raw) {
  std::string name = lower(trimmed(raw));
  name.erase(0, std::min(name.find_first_not_of("#% \t"), name.size()));
  const std::string unit = take_bracket(name);
  if (name.starts_with("field.")) name.erase(0, 6);
  if (const auto channel = channel_of(name)) return {channel, unit};
  return unit.empty() ? take_suffix(name) : ColumnName{};
}

bool ColumnPlan::has(Channel first, int count) const {
  const auto begin = column.begin() + first;
  return std::all_of(begin, begin + count, [](int c) { return c >= 0; });
}

ColumnPlan plan_by_names(const ReadContext& context, const std::vector<std::string>& names) {
  ColumnPlan plan;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const ColumnName name = parse_column_name(names[i]);
    if (name.channel) add_column(context, name, i, plan);
  }
  return plan;
}

ColumnPlan plan_by_order(std::string_view order) {
  ColumnPlan plan;
  const std::vector<std::string_view> names = split_cells(order, ' ');
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto channel = channel_of(names[i]);
    if (channel) plan.column[static_cast<std::size_t>(*channel)] = static_cast<int>(i);
  }
  return plan;
}

ColumnPlan plan_by_flag(const ReadContext& context, const std::string& columns, std::size_t fields) {
  const std::vector<std::string_view> names = split_cells(columns, ',');
  if (names.size() != fields) {
    context.fail(ExitCode::kInput, "E-COLUMNS",
                 "--columns names " + std::to_string(names.size()) + " columns, the file has " + std::to_string(fields),
                 context.path(), "name every column, with - for those to skip");
  }
  ColumnPlan plan;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == "-") continue;
    const ColumnName name = parse_column_name(names[i]);
    if (!name.channel) {
      context.fail(ExitCode::kUsage, "E-COLUMNS", "unknown column name " + vispline::quoted(names[i]), "--columns",
                   "known names: " + known_column_names());
    }
    add_column(context, name, i, plan);
  }
  return plan;
}

void apply_unit_flags(const ReadOptions& options, ColumnPlan& plan) {
  if (!options.gyro_unit.empty()) {
    plan.gyro_unit = factor_of_flag(kGyroUnits, options.gyro_unit, "--gyro-unit", "rad/s, deg/s or deg/h");
  }
  if (!options.accel_unit.empty()) {
    plan.accel_unit = factor_of_flag(kAccelUnits, options.accel_unit, "--accel-unit", "m/s^2, g or mg");
  }
}

std::string known_column_names() {
  return "t sec nsec index gx gy gz ax ay az px py pz qx qy qz qw, and - to skip a column";
}

}  // namespace vispline
