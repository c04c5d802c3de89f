/// Zip archives of stored entries, as small result sets need them: no compression, no time, no 64-bit fields.
/// PKWARE APPNOTE 6.3.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace vispline {

class ZipText {
 public:
  /// `name` without folders. Throws E-LIMIT (exit 7) beyond 4 GiB or 65535 entries.
  void add(std::string_view name, std::string_view bytes);
  /// The whole archive; nothing may be added after it.
  std::string finish();

 private:
  std::string entries_, directory_;
  std::uint16_t count_ = 0;
};

}  // namespace vispline
