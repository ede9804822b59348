// Options and file of the subcommands that write a GLB file.
#include "perf/cli/glb_output.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "engine/error.h"
#include "perf/cli/terminal.h"
#include "perf/report/atomic_file.h"

namespace halfframe::cli {

void GlbOutput::add_options(CLI::App& command) {
    command.add_option("SCENE", scene, "A .gltf or .glb file, or a built-in scene (halfframe scenes)")->required();
    command.add_option("-o,--output", file, "The file to write; its name ends in .glb")->type_name("FILE")->required();
    command.add_option("--gltf-scene", options.scene, "Scene of a file that has several, by name or number")
        ->type_name("NAME|N");
    command.add_option("--variant", options.variant, "Material variant of a file that has some, by name or number")
        ->type_name("NAME|N");
}

void GlbOutput::expect_can_write() const {
    if (!file.ends_with(".glb")) throw Error(Fault::usage, fmt::format("-o {}: the name must end in .glb", file));
    perf::expect_can_write(file);
}

void GlbOutput::write(const Scene& written) const {
    for (const std::string& sentence : content::not_exported(written)) notice(sentence);
    perf::write_file(file, content::gltf_binary(written));
}

}  // namespace halfframe::cli
