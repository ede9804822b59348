// Where a model is wrong, as a picture.
#pragma once

#include <cstddef>
#include <span>

#include "engine/frame/image.h"
#include "perf/accuracy/model_list.h"
#include "perf/report/lettering.h"

namespace halfframe::accuracy {

/// The rectangle of one map in the picture [pixels].
struct MapPlace {
    int x = 0, y = 0, width = 0, height = 0;
};

/// Of map `index` of a picture whose letters are `letter_px` tall: three stand beside each other.
[[nodiscard]] MapPlace map_place(std::size_t index, int letter_px);

/// A map for each model, with its name, its axes and what full colour means: the first axis to the right, the second
/// upwards. A place has the colour of its mean error over the other axes: white for none, red for too bright, blue for
/// too dark, full at 0.1, 0.2 or 0.5, of codes at 16, 32 or 64: the first that holds all of the map.
[[nodiscard]] Picture error_maps(std::span<const ModelAccuracy> models, const perf::Lettering& lettering);

}  // namespace halfframe::accuracy
