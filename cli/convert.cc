// vispline convert IN OUT: a recording, table or folder into another form.
#include <filesystem>
#include <iostream>
#include <memory>

#include "flags.h"
#include "reading_progress.h"
#include "validators.h"
#include "verbs.h"
#include "vispline/bags/open_bag.h"
#include "vispline/io/copy_bag.h"
#include "vispline/io/imu_stream.h"
#include "vispline/io/write.h"
#include "vispline/io/write_bag.h"

namespace vispline::cli {
namespace {

struct ConvertFlags {
  Session session;
  ReadFlags read;
  std::string in, out, format, compression = "none", as;
};

constexpr const char* kFormats[] = {"rosbag", "mcap", "rosbag2", "euroc", "csv", "tum", "kitti", "gcsv"};

[[noreturn]] void fail_usage(const std::string& message, const std::string& next) {
  throw Error(ExitCode::kUsage,
              {.code = "E-ARGUMENT", .message = message, .where = "", .effect = "nothing written", .next = next});
}

std::string format_of(const ConvertFlags& flags) {
  if (!flags.format.empty()) return flags.format;
  std::filesystem::path name(flags.out);
  if (name.extension() == ".gz" || name.extension() == ".xz") name = name.stem();
  const std::string suffix = name.extension().string();
  if (suffix == ".bag") return "rosbag";
  for (const char* format : kFormats) {
    if (suffix == "." + std::string(format)) return format;
  }
  if (suffix == ".txt") return "tum";
  fail_usage("the name " + vispline::quoted(flags.out) + " does not say which format to write",
             "pass --format rosbag, mcap, rosbag2, euroc, csv, tum, kitti or gcsv");
}

std::optional<Container> container_of(const std::string& format) {
  if (format == "rosbag") return Container::kRosbag;
  if (format == "mcap") return Container::kMcap;
  if (format == "rosbag2") return Container::kRosbag2;
  return std::nullopt;
}

BagWriterOptions writing_of(const ConvertFlags& flags) {
  BagWriterOptions options{.force = flags.session.force};
  if (flags.compression == "bz2") options.compression = Codec::kBz2;
  if (flags.compression == "lz4") options.compression = Codec::kLz4;
  if (flags.compression == "zstd") options.compression = Codec::kZstd;
  return options;
}

/// What of the input is converted.
ContentKind kind_of(const ConvertFlags& flags, const std::string& format, const ReadOptions& options) {
  if (flags.as == "imu" || format == "gcsv") return ContentKind::kImu;
  if (flags.as == "trajectory" || format == "tum" || format == "kitti") return ContentKind::kTrajectory;
  const ContentKind kind = content_of(flags.in, options);
  if (kind == ContentKind::kBoth && format == "csv") {
    fail_usage("the input holds IMU samples and poses, a table holds one of them", "pass --as imu or --as trajectory");
  }
  return kind;
}

/// IMU samples to `sink`, counted as an input.
void stream(ConvertFlags& flags, const ReadOptions& options, const ImuSink& sink) {
  ImuStreamResult result = stream_imu(flags.in, options, sink, {.progress = reading_progress("converting")});
  flags.session.add_input("imu", result.counts, result.diagnostics);
}

void write_imu_table(ConvertFlags& flags, const ReadOptions& options, const std::string& path) {
  ImuCsvWriter writer(path, output_options(flags.session));
  stream(flags, options, [&](std::span<const Time> time, std::span<const ImuSample> samples) {
    writer.write({{time.begin(), time.end()}, {samples.begin(), samples.end()}});
  });
  writer.publish();
}

Signal<Pose> load_poses(ConvertFlags& flags, const ReadOptions& options) {
  auto poses = read_trajectory(flags.in, options);
  flags.session.add_input("trajectory", poses.counts, poses.diagnostics);
  return std::move(poses.value);
}

void write_gcsv(ConvertFlags& flags, const ReadOptions& options) {
  auto imu = read_imu(flags.in, options);
  flags.session.add_input("imu", imu.counts, imu.diagnostics);
  write_imu_gcsv(flags.out, imu.value, std::nullopt, output_options(flags.session));
}

void write_poses(ConvertFlags& flags, const ReadOptions& options, const std::string& format, const std::string& path) {
  const Signal<Pose> T_w_b = load_poses(flags, options);
  const OutputOptions output = output_options(flags.session);
  if (format == "tum") return write_trajectory_tum(path, T_w_b, output);
  if (format == "kitti") return write_trajectory_kitti(path, T_w_b, output);
  write_trajectory_euroc(path, T_w_b, output);
}

void write_tables(ConvertFlags& flags, const ReadOptions& options, const std::string& format, ContentKind kind) {
  const bool folder = format == "euroc";
  const std::string root = flags.out + "/mav0/";
  if (format == "gcsv") return write_gcsv(flags, options);
  if (kind != ContentKind::kTrajectory) write_imu_table(flags, options, folder ? root + "imu0/data.csv" : flags.out);
  if (kind == ContentKind::kImu) return;
  write_poses(flags, options, format, folder ? root + "mocap0/data.csv" : flags.out);
}

void write_messages(ConvertFlags& flags, const ReadOptions& options, Container container, ContentKind kind) {
  SignalBagWriter writer(container, flags.out, writing_of(flags));
  if (kind != ContentKind::kTrajectory) {
    stream(flags, options, [&](std::span<const Time> time, std::span<const ImuSample> samples) {
      writer.write_imu("/imu0", time, samples);
    });
  }
  if (kind != ContentKind::kImu) writer.write_poses("/pose", load_poses(flags, options));
  writer.publish();
}

void convert(ConvertFlags& flags) {
  const ReadOptions options = flags.read.options(0, flags.session);
  const std::string format = format_of(flags);
  const auto container = container_of(format);
  const bool pair = !options.gyro_topic.empty();
  const OutputGuard guard;
  if (container && is_bag(flags.in) && !pair && flags.as.empty()) {
    CopyResult copied =
        copy_recording(flags.in, options, *container, flags.out, writing_of(flags), reading_progress("converting"));
    flags.session.add_input("messages", copied.counts, copied.diagnostics);
    return;
  }
  const ContentKind kind = kind_of(flags, format, options);
  container ? write_messages(flags, options, *container, kind) : write_tables(flags, options, format, kind);
}

void run(ConvertFlags& flags) {
  convert(flags);
  flags.session.finish();
  if (!flags.session.json) {
    std::cout << "wrote " << flags.out << '\n';
    return;
  }
  JsonObject document = begin_document("vispline.convert/1", flags.session.context);
  document.set("format", format_of(flags)).set("path", flags.out);
  end_document(document, flags.session.context);
  std::cout << document.text();
}

}  // namespace

void add_convert(CLI::App& app) {
  auto flags = std::make_shared<ConvertFlags>();
  CLI::App* verb = app.add_subcommand("convert", "a recording, table or folder into another form");
  verb->add_option("in", flags->in, "bag, MCAP, rosbag2 or EuRoC folder, table, recording of a device")->required();
  verb->add_option("out", flags->out, "file or folder to write")->required()->check(not_empty());
  verb->add_option("--format", flags->format, "found from the suffix of the output otherwise")
      ->check(CLI::IsMember(std::vector<std::string>(std::begin(kFormats), std::end(kFormats))));
  verb->add_option("--compression", flags->compression, "of the chunks of a rosbag (bz2, lz4) or MCAP (lz4, zstd)")
      ->check(CLI::IsMember({"none", "bz2", "lz4", "zstd"}))
      ->capture_default_str();
  verb->add_option("--as", flags->as, "what of the input, if it holds both")
      ->check(CLI::IsMember({"imu", "trajectory"}));
  flags->read.add_to(*verb);
  add_session_flags(*verb, flags->session);
  verb->callback([flags] { run(*flags); });
}

}  // namespace vispline::cli
