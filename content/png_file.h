// PNG files of images, without compression: for files that must hold the same pixels, not few bytes.
#pragma once

#include <string>

#include "engine/frame/scene.h"

namespace halfframe::content {

/// 8-bit RGBA, row 0 first (ISO/IEC 15948; the deflate stream has stored blocks only, RFC 1951).
[[nodiscard]] std::string png_of(const Image& image);

}  // namespace halfframe::content
