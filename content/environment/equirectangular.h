// A picture of everything around: what files and built-in skies are before they become a cube.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

namespace halfframe::content {

/// Linear radiance by direction, row 0 at the zenith (+Y). The middle column looks along -Z, the column three quarters
/// to the right along +X, so that a camera at rest sees the middle of the picture, not mirrored.
struct Equirectangular {
    int width = 0;  ///< twice the height
    int height = 0;
    std::vector<glm::vec3> pixels;  ///< finite and >= 0
};

/// The pixels of a .hdr or .exr file as they stand there: not yet checked for NaN and the like.
struct RawPicture {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> pixels;
};

/// 8192 x 4096, an "8k" environment: 400 MB as floats. Lobes are no narrower than 6 degrees, 1k is enough for them.
inline constexpr int kMostPictureWidth = 8192;
/// Files larger than this hold more than those pixels.
inline constexpr std::uint64_t kMostPictureBytes = 1u << 29;

/// Radiance RGBE (G. Ward, "Real Pixels", Graphics Gems II, 1991): flat, old and new run lengths, EXPOSURE, "-Y N +X
/// M". Broken: Error(input) that starts with `file`.
[[nodiscard]] RawPicture decode_hdr(std::string_view bytes, const std::string& file);
/// OpenEXR through tinyexr: one part, R G B in half or float, or one channel alone for grey.
[[nodiscard]] RawPicture decode_exr(std::string_view bytes, const std::string& file);

/// The size of a picture as its header has it. Not 2:1, empty or over kMostPictureWidth: Error(input).
void expect_equirectangular(long long width, long long height, const std::string& file);

/// Decodes by the ending of `file`. NaN, infinite, negative and absurd values are mended, with one notice, which leaves the
/// name of the file to the caller.
[[nodiscard]] Equirectangular decode_equirectangular(std::string_view bytes, const std::filesystem::path& file,
                                                     std::vector<std::string>& notices);

}  // namespace halfframe::content
