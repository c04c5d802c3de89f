#include "vispline/io/kitti.h"

#include <Eigen/SVD>
#include <algorithm>

#include "vispline/io/format_words.h"
#include "vispline/io/text_row.h"
#include "vispline/io/timed_rows.h"

namespace vispline::kitti {
namespace {

constexpr std::size_t kColumns = 12, kHalf = 6;
constexpr double kRounding = 1e-3, kNoRotation = 0.1;

using Numbers = std::array<double, kColumns>;

Matrix3d rotation_of(const Numbers& n) {
  Matrix3d R;
  R << n[0], n[1], n[2], n[4], n[5], n[6], n[8], n[9], n[10];
  return R;
}

/// Distance from a rotation; infinite for a reflection.
double off_rotation(const Matrix3d& R) {
  if (!R.allFinite()) return 0.0;  // a lost pose, for the check of finite numbers
  if (R.determinant() <= 0.0) return INFINITY;
  return (R.transpose() * R - Matrix3d::Identity()).cwiseAbs().maxCoeff();
}

Matrix3d nearest_rotation(const Matrix3d& R) {
  const Eigen::JacobiSVD<Matrix3d> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

/// The two halves of a row: a row has more numbers than a reader of rows takes.
class KittiRow {
 public:
  explicit KittiRow(const TextLayout& layout)
      : first_(layout, {.values = {0, 1, 2, 3, 4, 5}}), second_(layout, {.values = {6, 7, 8, 9, 10, 11}}) {}

  bool read(std::string_view line, Numbers& numbers, BadRow& bad) const {
    TextRow row;
    if (!first_.read(line, row, bad)) return false;
    std::copy_n(row.values.begin(), kHalf, numbers.begin());
    if (!second_.read(line, row, bad)) return false;
    std::copy_n(row.values.begin(), kHalf, numbers.begin() + kHalf);
    return true;
  }

 private:
  RowReader first_, second_;
};

SensorRow pose_row(ReadContext& context, const Numbers& numbers, std::int64_t line) {
  const Matrix3d R = rotation_of(numbers);
  const double off = off_rotation(R);
  if (off > kNoRotation) {
    context.fail(ExitCode::kInput, "E-CSV", "the row holds no rotation: off by " + brief(off), context.where_line(line),
                 "a KITTI row is R00 R01 R02 x R10 R11 R12 y R20 R21 R22 z");
  }
  if (off > kRounding) {
    context.warn("W-ROTATION", "the rotation is off by " + brief(off), context.where_line(line),
                 "the nearest rotation is used");
  }
  SensorRow row{.where = line};
  Eigen::Quaterniond q(NAN, NAN, NAN, NAN);
  if (R.allFinite()) q = nearest_rotation(R);
  row.values = {numbers[3], numbers[7], numbers[11], q.x(), q.y(), q.z(), q.w()};
  return row;
}

std::size_t decimals_of(std::string_view cell) {
  const std::size_t point = cell.find('.');
  return point == std::string_view::npos ? 0 : cell.size() - point - 1;
}

/// A row without a line end whose last number has fewer digits after the point than those of the first rows.
bool is_cut(const TextLine& line, const TextLayout& layout) {
  if (line.has_end) return false;
  std::size_t usual = SIZE_MAX;
  for (const std::vector<std::string>& cells : layout.sample) {
    if (cells.size() == kColumns && &cells != &layout.sample.back()) usual = std::min(usual, decimals_of(cells.back()));
  }
  return usual != SIZE_MAX && decimals_of(line.text.substr(line.text.find_last_of(" ,\t") + 1)) < usual;
}

/// kNoStamp beyond 64 bits.
std::int64_t stamp_of(const StampPlan& stamps, std::int64_t index) {
  if (stamps.clock) {
    const bool fits = static_cast<double>(index) * 1e9 / stamps.clock->rate_hz < 9e18;
    return fits ? to_ns((*stamps.clock)(index)) : kNoStamp;
  }
  return to_nanoseconds({.whole = index}, *stamps.given).value_or(kNoStamp);
}

}  // namespace

bool recognizes(const ReadContext& context, const TextLayout& layout) {
  const ReadOptions& options = context.options();
  if (layout.fields != kColumns || !options.columns.empty()) return false;
  if (options.format == kName) return true;
  if (!options.format.empty() || !layout.header.empty() || layout.separator != ' ') return false;
  for (const std::vector<std::string>& cells : layout.sample) {
    Numbers numbers{};
    for (std::size_t i = 0; i < kColumns && i < cells.size(); ++i) {
      if (parse_double(cells[i], numbers[i]) != NumberStatus::kOk) return false;
    }
    if (off_rotation(rotation_of(numbers)) > kNoRotation) return false;
  }
  return !layout.sample.empty();
}

std::vector<SensorRow> load(ReadContext& context, TextLines& lines, const TextLayout& layout) {
  const StampPlan stamps = plan_stamps(context, {});
  const KittiRow reader(layout);
  std::vector<SensorRow> rows;
  std::int64_t index = 0;
  for (TextLine line; lines.next(line); ++index) {
    if (line.text.find_first_not_of(" \t") == std::string_view::npos || line.text.front() == '#') {
      --index;
      continue;
    }
    ++context.counts.read;
    Numbers numbers{};
    BadRow bad;
    if (is_cut(line, layout) || !reader.read(line.text, numbers, bad)) {
      if (line.has_end) {
        context.fail(ExitCode::kInput, bad.code, bad.message, context.where_line(line.number),
                     "mend or remove the row");
      }
      context.drop("W-TRUNCATED", "the last row is cut", context.where_line(line.number));
      continue;
    }
    SensorRow row = pose_row(context, numbers, line.number);
    row.ns = stamp_of(stamps, index);
    if (row.ns == kNoStamp) {
      context.drop("W-TIME-RANGE", "the stamp is no time of 64 bits", context.where_line(line.number));
      continue;
    }
    rows.push_back(row);
  }
  return rows;
}

std::string text(const Signal<Pose>& T_w_b) {
  std::string out;
  for (const Pose& pose : T_w_b.value) {
    for (int row = 0; row < 3; ++row) {
      if (row > 0) out += ' ';
      append_number(out, pose.R(row, 0));
      append_cells(out, ' ', Eigen::Vector3d(pose.R(row, 1), pose.R(row, 2), pose.p[row]));
    }
    out += '\n';
  }
  return out;
}

}  // namespace vispline::kitti
