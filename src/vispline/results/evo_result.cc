#include "vispline/results/evo_result.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdlib>
#include <numeric>

#include "vispline/files/zip.h"
#include "vispline/results/json.h"

namespace vispline {
namespace {

/// NumPy's format 1.0: doubles, little-endian, row by row.
std::string npy(const std::vector<double>& values, const std::string& shape) {
  std::string head = "{'descr': '<f8', 'fortran_order': False, 'shape': (" + shape + "), }";
  head.append(63 - (10 + head.size()) % 64, ' ');
  head += '\n';
  std::string out("\x93NUMPY\x01\0", 8);
  out += static_cast<char>(static_cast<unsigned char>(head.size() & 255));
  out += static_cast<char>(static_cast<unsigned char>(head.size() >> 8));
  out += head;
  for (const double value : values) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    for (int i = 0; i < 8; ++i) out += static_cast<char>(static_cast<unsigned char>(bits >> (8 * i)));
  }
  return out;
}

std::string npy(const std::vector<double>& values) { return npy(values, std::to_string(values.size()) + ","); }

/// The compared poses: stamps, the aligned estimate, the reference.
struct Compared {
  std::vector<Time> time;
  std::vector<Pose> estimate, reference;
};

Compared compared(const TrajectoryComparison& comparison) {
  Compared all;
  for (const PosePair& pair : comparison.association.pairs) {
    all.time.push_back(pair.time);
    all.estimate.push_back(comparison.alignment * pair.T_w_b_estimate);
    all.reference.push_back(pair.T_w_b_reference);
  }
  return all;
}

std::vector<double> distances(const std::vector<Pose>& poses) {
  std::vector<double> along;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    along.push_back(i == 0 ? 0.0 : along.back() + (poses[i].p - poses[i - 1].p).norm());
  }
  return along;
}

std::string number(double value) {
  char text[40];
  return {text, std::to_chars(text, text + sizeof(text), value).ptr};
}

std::string tum(const std::vector<Time>& time, const std::vector<Pose>& poses) {
  std::string out;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::int64_t ns = std::abs(to_ns(time[i]));
    const std::string fraction = std::to_string(1'000'000'000 + ns % 1'000'000'000);
    out += (to_ns(time[i]) < 0 ? "-" : "") + std::to_string(ns / 1'000'000'000) + "." + fraction.substr(1);
    const Eigen::Quaterniond q = poses[i].quaternion();
    const Vector3d& p = poses[i].p;
    for (const double value : {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()}) out += " " + number(value);
    out += '\n';
  }
  return out;
}

std::vector<double> errors_of(const Compared& all) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < all.time.size(); ++i) errors.push_back((all.estimate[i].p - all.reference[i].p).norm());
  return errors;
}

std::string stats_json(const std::vector<double>& errors) {
  const ErrorStatistics statistics = error_statistics(errors);
  const double squares = std::inner_product(errors.begin(), errors.end(), errors.begin(), 0.0);
  JsonObject stats;
  stats.set("rmse", statistics.rmse).set("mean", statistics.mean).set("median", statistics.median);
  stats.set("std", statistics.std).set("min", *std::min_element(errors.begin(), errors.end()));
  return stats.set("max", statistics.max).set("sse", squares).text();
}

std::string info_json(const TrajectoryComparison& comparison, const std::string& reference,
                      const std::string& estimate) {
  const std::string how = comparison.alignment_mode == AlignmentMode::kNone
                              ? "not aligned"
                              : "with " + std::string(to_name(comparison.alignment_mode)) + " alignment";
  JsonObject info;
  info.set("title", "APE w.r.t. translation part (m)\n(" + how + ")").set("label", "APE (m)");
  return info.set("ref_name", reference).set("est_name", estimate).text();
}

std::vector<double> similarity(const Alignment& alignment) {
  std::vector<double> rows;
  for (int row = 0; row < 3; ++row) {
    for (int col = 0; col < 3; ++col) rows.push_back(alignment.scale * alignment.R_r_e(row, col));
    rows.push_back(alignment.p_r_e[row]);
  }
  rows.insert(rows.end(), {0.0, 0.0, 0.0, 1.0});
  return rows;
}

}  // namespace

std::string evo_result_zip(const TrajectoryComparison& comparison, const std::string& reference_name,
                           const std::string& estimate_name) {
  const Compared all = compared(comparison);
  require(!all.time.empty(), "a comparison with at least one pair of poses");
  std::vector<double> stamps, from_start;
  for (const Time time : all.time) {
    stamps.push_back(static_cast<double>(to_ns(time)) * 1e-9);
    from_start.push_back(to_seconds(time - all.time.front()));
  }
  const std::vector<double> errors = errors_of(all);
  ZipText zip;
  zip.add("info.json", info_json(comparison, reference_name, estimate_name));
  zip.add("stats.json", stats_json(errors));
  zip.add("error_array.npy", npy(errors));
  zip.add("timestamps.npy", npy(stamps));
  zip.add("seconds_from_start.npy", npy(from_start));
  zip.add("distances_from_start.npy", npy(distances(all.reference)));
  zip.add("distances.npy", npy(distances(all.estimate)));
  zip.add("alignment_transformation_sim3.npy", npy(similarity(comparison.alignment), "4, 4"));
  zip.add("reference.tum", tum(all.time, all.reference));
  zip.add("estimate.tum", tum(all.time, all.estimate));
  return zip.finish();
}

}  // namespace vispline
