// What the subcommands that write a scene as a GLB file share: which scene, and the file.
#pragma once

#include <string>

#include "content/content.h"

namespace CLI {
class App;
}

namespace halfframe::cli {

struct GlbOutput {
    std::string scene;
    std::string file;
    content::LoadOptions options;

    /// SCENE, --output, --gltf-scene and --variant.
    void add_options(CLI::App& command);
    /// Before minutes of work: a name that does not end in .glb is Error(usage), a place that cannot be written
    /// Error(environment).
    void expect_can_write() const;
    /// With a notice for everything that the file cannot hold.
    void write(const Scene& written) const;
};

}  // namespace halfframe::cli
