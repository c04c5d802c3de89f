#include "vispline/io/write.h"

#include "vispline/core/error.h"
#include "vispline/io/euroc_imu.h"
#include "vispline/io/gyroflow.h"
#include "vispline/io/kitti.h"
#include "vispline/io/mocap.h"
#include "vispline/io/tum.h"

namespace vispline {
namespace {
constexpr std::size_t kBlockBytes = std::size_t{1} << 19;
constexpr std::uint64_t kRowBytes = 150;  // a stamp of 19 digits and six numbers of up to 20, with separators
}  // namespace

ImuCsvWriter::ImuCsvWriter(std::string path, OutputOptions options) : file_(std::move(path), options) {
  file_.write(euroc_imu::kHeader);
  file_.write("\n");
}

void ImuCsvWriter::write(const ImuSignal& block) {
  require(block.time.size() == block.value.size(), "as many IMU samples as stamps");
  for (std::size_t i = 0; i < block.size(); ++i) {
    euroc_imu::append_row(text_, block.time[i], block.value[i]);
    if (text_.size() < kBlockBytes && i + 1 < block.size()) continue;
    file_.write(text_);
    text_.clear();
  }
}

GroundTruthCsvWriter::GroundTruthCsvWriter(std::string path, OutputOptions options)
    : file_(std::move(path), options), text_(euroc_groundtruth::kHeader) {
  text_ += '\n';
}

void GroundTruthCsvWriter::write(Time time, const GroundTruth& state) {
  euroc_groundtruth::append_row(text_, time, state);
  if (text_.size() < kBlockBytes) return;
  file_.write(text_);
  text_.clear();
}

void GroundTruthCsvWriter::publish() {
  file_.write(text_);
  text_.clear();
  file_.publish();
}

std::uint64_t imu_csv_bytes(std::uint64_t rows) { return rows * kRowBytes + euroc_imu::kHeader.size() + 1; }

void write_imu_csv(const std::string& path, const ImuSignal& imu, OutputOptions options) {
  ImuCsvWriter writer(path, options);
  writer.write(imu);
  writer.publish();
}

void write_trajectory_tum(const std::string& path, const Signal<Pose>& T_w_b, OutputOptions options) {
  write_file(path, tum::text(T_w_b), options);
}

void write_trajectory_euroc(const std::string& path, const Signal<Pose>& T_w_b, OutputOptions options) {
  write_file(path, mocap::text(T_w_b), options);
}

void write_trajectory_kitti(const std::string& path, const Signal<Pose>& T_w_b, OutputOptions options) {
  write_file(path, kitti::text(T_w_b), options);
}

void write_imu_gcsv(const std::string& path, const ImuSignal& imu, std::optional<double> readout_s,
                    OutputOptions options) {
  write_file(path, gyroflow::text(imu, readout_s), options);
}

void write_groundtruth_euroc(const std::string& path, const Signal<GroundTruth>& states, OutputOptions options) {
  write_file(path, euroc_groundtruth::text(states), options);
}

}  // namespace vispline
