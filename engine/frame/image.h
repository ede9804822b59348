// Pixels on the CPU side.
#pragma once

#include <cstdint>
#include <vector>

namespace halfframe {

/// 8-bit display pixels, row 0 at the top, 4 channels.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;
};

/// Linear float pixels, row 0 at the top, 4 channels.
struct FloatPicture {
    int width = 0;
    int height = 0;
    std::vector<float> rgba;
};

}  // namespace halfframe
