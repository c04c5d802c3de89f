/// The telemetry of a GoPro payload by payload: out of an MP4, or bare GPMF as it stands in a file. One payload is held
/// at a time; nothing else of a video is read but the boxes that tell where the telemetry is.
#pragma once

#include <functional>

#include "vispline/io/gpmf.h"
#include "vispline/io/mp4_track.h"
#include "vispline/io/text_lines.h"

namespace vispline::gopro {

/// What cameras cut their telemetry into; bare payloads have no other time.
inline constexpr double kPayloadSeconds = 1.001;

class Payloads {
 public:
  /// `input` must outlive it. Throws as mp4::find_telemetry does.
  explicit Payloads(const Input& input);

  /// Payloads have the times of an MP4.
  bool is_timed() const { return is_mp4_; }
  /// A video without a gpmd track has none.
  bool has_track() const { return !is_mp4_ || !telemetry_.payloads.empty(); }
  /// A box of the video leaves its place, or the file.
  bool is_damaged() const { return telemetry_.damaged; }
  /// The GPMF box for the whole recording; empty: there is none.
  const std::string& settings() const { return telemetry_.settings; }

  /// Gets one device with its payload; false: that is enough.
  using Visit = std::function<bool(const gpmf::Device&, const mp4::Payload&)>;
  /// From the first payload to the last. True: a part is damaged and was left out.
  bool each(const Visit& visit, const ReadProgress& progress = {}) const;

 private:
  bool each_of_track(const Visit& visit, const ReadProgress& progress) const;
  bool each_bare(const Visit& visit, const ReadProgress& progress) const;

  const Input& input_;
  bool is_mp4_;
  mp4::Telemetry telemetry_;
};

}  // namespace vispline::gopro
