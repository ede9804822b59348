// Where a model is wrong, as a picture: no axes are written, the order is told beside it.
#pragma once

#include <span>

#include "engine/frame/image.h"
#include "perf/accuracy/model_list.h"

namespace halfframe::accuracy {

/// A map for each model, side by side: its first axis to the right, its second upwards, 6 pixels a place. A place has
/// the colour of its mean error over the other axes: white for none, red for too bright, blue for too dark, full at 0.5
/// or at 64 codes.
[[nodiscard]] Picture error_maps(std::span<const ModelAccuracy> models);

}  // namespace halfframe::accuracy
