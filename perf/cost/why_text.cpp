// Instruction listings: each line of the text with what it became and what that costs.
#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/error.h"
#include "perf/cost/cost_report.h"
#include "perf/report/text_table.h"

namespace halfframe::cost {
namespace {

using perf::Align;
using perf::TextTable;

std::string number(double value) { return value == 0.0 ? "-" : fmt::format("{:g}", value); }

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

std::string trimmed(const std::string& line) {
    const std::size_t first = line.find_first_not_of(" \t");
    constexpr std::size_t kLongest = 72;
    const std::string rest = first == std::string::npos ? "" : line.substr(first);
    return rest.size() > kLongest ? rest.substr(0, kLongest - 3) + "..." : rest;
}

/// Text of shaders_es; code that an effect inserts has no file of its own.
std::string built_in_text(const std::string& file) {
    const gl::ShaderFile* found = gl::find_shader_file(file);
    return found != nullptr ? std::string(found->text) : std::string();
}

std::string sums_text(const ShaderCounts& counts) {
    const auto path = [](const char* name, const PathCounts& sums) {
        return fmt::format(
            "{}: {:g} slots ({:g} of them moves), {:g} half normalizes, {:g} fetches, Xenos {:g} vector + "
            "{:g} scalar = {:g} instructions, {:g} multiply-adds\n",
            name, sums.work.slots, sums.moves, sums.work.normalizes, sums.fetch_count(), sums.work.vector_ops,
            sums.work.scalar_ops, co_issued(sums.work), sums.work.mads);
    };
    std::string text = path("weighted", counts.weighted);
    if (counts.branches > 0) text += path("shortest", counts.shortest) + path("longest", counts.longest);
    text += fmt::format("{} branches ({}), {} free modifiers, {} fused multiply-adds, temporaries {} full {} half{}\n",
                        counts.branches, counts.weighting, counts.free_modifiers, counts.fused_mads,
                        counts.temporaries.full, counts.temporaries.half, counts.discards ? ", discards" : "");
    for (const std::string& notice : counts.notices) text += "notice: " + notice + "\n";
    return text;
}

}  // namespace

std::string listing_text(const CountedStage& stage,
                         const std::function<std::string(const std::string& file)>& text_of) {
    TextTable table({{"place"},
                     {"instruction"},
                     {"slots", Align::right},
                     {"vector", Align::right},
                     {"scalar", Align::right},
                     {"MADs", Align::right},
                     {"weight", Align::right},
                     {"text"}});
    std::vector<const CountedInstruction*> sorted;
    for (const CountedInstruction& one : stage.counts.instructions) sorted.push_back(&one);
    std::ranges::stable_sort(sorted, {}, [](const CountedInstruction* one) { return one->line; });
    std::map<std::string, std::vector<std::string>> files;
    std::uint32_t line_before = ~0u;
    for (const CountedInstruction* one : sorted) {
        const std::string place = stage.module.place(one->line);
        std::string text;
        if (one->line != line_before) {
            const std::string file = place.substr(0, place.rfind(':'));
            if (!files.contains(file)) files[file] = lines_of(text_of(file));
            const std::size_t row = one->line % gl::kLinesPerFile;
            if (row >= 1 && row <= files[file].size()) text = trimmed(files[file][row - 1]);
        }
        std::string what = fmt::format("{} {}{}", one->half ? "half" : "full", one->what,
                                       one->components > 1 ? fmt::format(" vec{}", one->components) : "");
        if (one->sampler >= 0) what += " " + stage.counts.samplers[static_cast<std::size_t>(one->sampler)].name;
        if (one->moves > 0.0) what += fmt::format(" + {:g} moves", one->moves);
        if (one->work.normalizes > 0.0) what += " (free unit)";
        table.add_row({one->line != line_before ? place : "", what, number(one->work.slots),
                       number(one->work.vector_ops), number(one->work.scalar_ops), number(one->work.mads),
                       fmt::format("{:g}", one->weight), text});
        line_before = one->line;
    }
    return table.text() + sums_text(stage.counts);
}

std::string why_text(const CountedFrame& frame, ShaderLibrary& library, gl::Arithmetic arithmetic,
                     const std::string& pass) {
    std::vector<std::string> passes;
    for (const Pass& one : frame.plan.passes) passes.push_back(one.name);
    if (std::ranges::find(passes, pass) == passes.end()) {
        throw Error(Fault::usage,
                    fmt::format("--why {}: this frame has no such pass; it has {}", pass, fmt::join(passes, ", ")));
    }
    struct Use {
        int draws = 0;
        double shaded = 0.0;
    };
    std::map<std::uint32_t, Use> uses;
    for (const RecordedDraw& draw : frame.draws) {
        if (draw.pass != pass || draw.program == 0) continue;
        ++uses[draw.program].draws;
        uses[draw.program].shaded += static_cast<double>(draw.samples_shaded);
    }
    std::string text;
    for (const auto& [program, use] : uses) {
        const gl::ProgramDescription& description = frame.programs.at(program);
        std::string defines;
        for (const auto& [name, value] : description.defines) defines += " " + name;
        text += fmt::format("{}: {} with{} ({} arithmetic): {} draws, {:.0f} samples shaded\n", pass,
                            description.fragment, defines, halfframe::name(arithmetic), use.draws, use.shaded);
        for (const gl::Stage stage : {gl::Stage::fragment, gl::Stage::vertex}) {
            text += fmt::format("\n{} stage\n", stage == gl::Stage::vertex ? "vertex" : "fragment");
            text += listing_text(library.stage(description, stage, arithmetic), built_in_text);
        }
        text += "\n";
    }
    if (uses.empty()) text = fmt::format("{} shades nothing\n", pass);
    return text + std::string(kModelledWords) + "\n";
}

}  // namespace halfframe::cost
