/// Grey images as PNG files.
#pragma once

#include <string>
#include <string_view>

#include "vispline/sensors/image.h"

namespace vispline {

/// The bytes of an 8-bit grey PNG. Lossless: read_png gives the same image. Throws E-ARGUMENT for an image whose bytes
/// are not width * height, at least 1.
std::string png_bytes(const GreyImage& image);

/// The image in the bytes of a PNG file; colours become grey, alpha is dropped, 16 bits are cut to 8. `name` says in
/// errors where they come from. Throws Error(kInput, E-IMAGE) for bytes that are no whole PNG, Error(kLimit, E-LIMIT)
/// for more than 2^26 pixels, before any is decoded.
GreyImage decode_png(std::string_view bytes, const std::string& name);

}  // namespace vispline
