// Directions of a cube map's faces, as OpenGL ES 3.0 (table 3.22) lays them out.
#pragma once

#include <glm/glm.hpp>

namespace halfframe {

/// Where u, v (-1..1 across a face, v down its rows) of face 0..5 (+X -X +Y -Y +Z -Z) looks. Not unit.
[[nodiscard]] inline glm::dvec3 face_direction(int face, double u, double v) {
    switch (face) {
        case 0: return {1.0, -v, -u};
        case 1: return {-1.0, -v, u};
        case 2: return {u, 1.0, v};
        case 3: return {u, -1.0, -v};
        case 4: return {u, -v, 1.0};
        default: return {-u, -v, -1.0};
    }
}

}  // namespace halfframe
