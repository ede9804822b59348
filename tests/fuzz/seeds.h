// Small files that are right, one for each thing the loader reads: where mutations start.
#pragma once

#include <string>
#include <vector>

namespace halfframe::tests {

struct Seed {
    std::string name;  ///< file name
    std::string bytes;
};
[[nodiscard]] std::vector<Seed> gltf_seeds();

}  // namespace halfframe::tests
