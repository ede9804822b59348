// Where in a file the things of a Scene come from.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/frame/scene.h"

namespace halfframe::check {

/// Finds materials, images and meshes of a Scene again in the file by what the loader names them after. Where several
/// of one name exist, the place is that of the whole list ("/materials").
class Places {
public:
    /// `file` empty: the scene is built in, and every place is "".
    Places(const Scene& scene, const std::filesystem::path& file);

    [[nodiscard]] std::string material(int index) const;
    [[nodiscard]] std::string image(int index) const;
    [[nodiscard]] std::string mesh(int index) const;

private:
    struct Names {
        const char* list;
        std::vector<std::string> names;  ///< as the loader names them
    };
    [[nodiscard]] static std::string find(const Names& names, const std::string& name);

    const Scene& scene_;
    bool is_file_ = false;
    Names materials_{"/materials", {}};
    Names images_{"/images", {}};
    Names meshes_{"/meshes", {}};
};

}  // namespace halfframe::check
