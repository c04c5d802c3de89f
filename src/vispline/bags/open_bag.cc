#include "vispline/bags/open_bag.h"

#include "vispline/bags/db3_reader.h"
#include "vispline/bags/mcap_reader.h"
#include "vispline/bags/rosbag2_folder.h"
#include "vispline/bags/rosbag_reader.h"
#include "vispline/bags/sqlite_file.h"

namespace vispline {

bool is_bag(const std::string& path) {
  if (is_rosbag2_folder(path)) return true;
  try {
    const Input input = Input::open(path);
    return is_rosbag(input) || is_mcap(input) || is_sqlite(input);
  } catch (const Error&) {
    return false;
  }
}

std::unique_ptr<BagReader> open_bag(const std::string& path, const BagOptions& options) {
  if (is_rosbag2_folder(path)) return open_rosbag2_folder(path, options);
  Input input = Input::open(path);
  if (is_sqlite(input)) return open_db3(path, options);
  return open_bag(std::move(input), options);
}

std::unique_ptr<BagReader> open_bag(Input input, const BagOptions& options) {
  if (is_rosbag(input)) return open_rosbag(std::move(input), options);
  if (is_mcap(input)) return open_mcap(std::move(input), options);
  throw Error(ExitCode::kInput, {.code = input.size() == 0 ? "E-EMPTY" : "E-FORMAT",
                                 .message = vispline::quoted(input.name()) +
                                            (input.size() == 0 ? " holds no bytes" : " is no recording of messages"),
                                 .where = input.name(),
                                 .effect = "nothing read",
                                 .next = "name a rosbag, an MCAP file, a .db3 file or the folder of a rosbag2"});
}

}  // namespace vispline
