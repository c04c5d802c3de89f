/// What is in a file, for people and as JSON (docs/json.md, vispline.info/1).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vispline/io/readout.h"
#include "vispline/io/recording_survey.h"
#include "vispline/io/signal_survey.h"
#include "vispline/results/json.h"

namespace vispline::cli {

struct FileInfo {
  std::optional<RecordingSurvey> recording;  ///< absent for tables
  std::vector<SignalSurvey> signals;
  std::optional<Readout> readout;  ///< of the camera, where the recording tells it
};

std::string info_text(const FileInfo& info);
std::string info_json(const FileInfo& info, const JsonContext& context);

}  // namespace vispline::cli
