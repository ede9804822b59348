// Pairs of whole frames that must look alike: what stability of a picture means, as data.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/frame/tier.h"
#include "perf/accuracy/scene_changes.h"

namespace halfframe::accuracy {

enum class Relation : std::uint8_t {
    same,          ///< the changed picture is the plain one
    never_darker,  ///< no channel of the changed picture is below the plain one: more light was added
};

/// A part of a picture, from the left and the top [pixels].
struct Part {
    int x = 0, y = 0, width = 1, height = 1;
};

/// The largest distance allowed, and what causes one of that size.
struct FrameBound {
    int max_channel_error = 0;      ///< [1/255]
    double max_bad_fraction = 0.0;  ///< pixels that differ at all, 0..1
    const char* reason = "the same numbers";
};

struct FrameCase {
    std::string kind;    ///< a word for the family: "moved", "units"; a label for tests
    std::string change;  ///< what was changed, for a reader
    std::function<Shot()> plain;
    std::function<Shot()> changed;
    Relation relation = Relation::same;
    std::optional<Part> plain_part = std::nullopt;  ///< compared; nothing: the whole picture
    std::optional<Part> changed_part = std::nullopt;
    /// With all that the scene calls for. Otherwise without shadow, bloom and anti_alias: they work on grids, of a map
    /// that stands still in the world or of the picture's pixels, and what moves against a grid changes at its edges.
    bool whole = false;
    double least_covered =
        0.5;  ///< of the changed picture by surfaces: with less, a blank frame could pass for a stable one
    FrameBound full = {};
    FrameBound half = {};
    std::optional<FrameBound> reference_half = std::nullopt;  ///< the reference tier in half; nothing: as `half`
};

[[nodiscard]] const FrameBound& bound_of(const FrameCase& pair, Tier tier, Arithmetic arithmetic);

/// All pairs, of the built-in test room. The order is that of the table; pairs of a kind stand together.
[[nodiscard]] std::vector<FrameCase> frame_cases();

/// Pairs that any scene can stand in, seen by its first camera, or by one that frames it: `kind` is "scene". Those that
/// it has nothing for (no lamps, nothing that moves) are left out. All copies of the shot are made when they are drawn.
[[nodiscard]] std::vector<FrameCase> scene_cases(const Scene& scene);

}  // namespace halfframe::accuracy
