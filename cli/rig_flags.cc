#include "rig_flags.h"

#include <algorithm>

#include "rig_scene.h"
#include "validators.h"
#include "vispline/core/error.h"
#include "vispline/io/rig_presets.h"

namespace vispline::cli {
namespace {

constexpr const char* kFrontEnd = "Front end (with --rig)";

std::string preset_names() {
  std::string text;
  for (const std::string& name : rig_preset_names()) text += name + ", ";
  return text;
}

}  // namespace

void RigFlags::add_to(CLI::App& verb) {
  CLI::Option* option =
      verb.add_option("--rig", rig, "a whole rig: " + preset_names() + "or files of it, comma separated")
          ->check(not_empty());
  verb.add_option("--scene", scene, kSceneHelp)->check(not_empty())->capture_default_str()->needs(option);
  verb.add_option("--landmarks", landmarks, "number of points of a room or a cloud")
      ->check(between(1, 1e6))
      ->needs(option);
  verb.add_option("--with", with, "also write: course, bag, mcap, rosbag2")
      ->delimiter(',')
      ->check(CLI::IsMember({"course", "bag", "mcap", "rosbag2"}))
      ->needs(option);
  verb.add_flag("--images", images, "render the images of the cameras, of a room or a board")->needs(option);
  const auto flag = [&](const char* name, auto& value, const CLI::Validator& range, const char* help) {
    verb.add_option(name, value, help)->check(range)->capture_default_str()->group(kFrontEnd)->needs(option);
  };
  TrackOptions& tracks = features.tracks;
  flag("--max-features", tracks.max_features, between(1, 1e6), "features in an image");
  flag("--min-distance", tracks.min_distance_px, not_negative(1e4), "between two features [px]");
  flag("--track-loss", tracks.loss, between(0.0, 1.0), "probability that a track ends before the next image");
  flag("--track-frames", tracks.max_frames, not_negative(), "a track ends after so many images; 0: never");
  verb.add_flag("--keep-ids", tracks.keep_ids, "a landmark that comes back into sight has its old id")
      ->group(kFrontEnd)
      ->needs(option);
  flag("--dropout", features.dropout, between(0.0, 1.0), "probability that a feature is missing in an image");
  flag("--outliers", features.outliers, between(0.0, 1.0), "probability that a feature is displaced");
  flag("--outlier-px", features.outlier_px, not_negative(1e4), "by up to so much [px]");
  flag("--image-gain", render.gain, positive(1e3), "of light and of read noise, in images");
  flag("--image-noise", render.read_sigma_grey, not_negative(255.0), "of a pixel at gain 1 [grey levels]");
  flag("--vignette", render.vignette, between(0.0, 1.0), "part of the light that is missing in the corners");
}

bool RigFlags::wants(const std::string& output) const { return std::ranges::find(with, output) != with.end(); }

void refuse_imu_flags(const CLI::App& verb) {
  static constexpr const char* kOthers[] = {"--like", "--imus", "--format", "--truth", "--imu-rate"};
  for (const CLI::Option* option : verb.get_options()) {
    const std::string name = option->get_name();
    const bool is_imu = option->get_group() == "Noise" || option->get_group() == "Instrument" ||
                        std::ranges::find(kOthers, name) != std::end(kOthers);
    const bool is_shared = name == "--seed" || name == "--threads";
    require(!is_imu || is_shared || option->count() == 0, "no " + name + " with --rig, which describes its IMUs");
  }
}

}  // namespace vispline::cli
