// A user's shader as written, with every precision half, and with every precision full.
#include "perf/cost/user_shader_report.h"

#include <array>
#include <future>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "perf/cost/cost_report.h"
#include "perf/report/text_table.h"
#include "perf/shader_ir/compile.h"

namespace halfframe::cost {
namespace {

using perf::Align;
using perf::ms_text;
using Json = nlohmann::ordered_json;

constexpr std::size_t kLineWidth = 118;

Json path_json(const PathCounts& path) {
    return {{"slots", path.work.slots},
            {"moves", path.moves},
            {"half_normalizes", path.work.normalizes},
            {"fetches", path.fetch_count()},
            {"vector_ops", path.work.vector_ops},
            {"scalar_ops", path.work.scalar_ops},
            {"co_issued", co_issued(path.work)},
            {"multiply_adds", path.work.mads}};
}

}  // namespace

UserShaderCost user_shader_cost(const UserShaderRequest& request) {
    UserShaderCost cost{.file = request.file,
                        .target = request.target,
                        .profiles = request.profiles,
                        .compiler = shader_ir::compiler_versions()};
    constexpr std::array kAll{Precisions::as_written, Precisions::half, Precisions::full};
    std::vector<std::future<CountedStage>> counting;
    for (const Precisions precisions : kAll)
        counting.push_back(std::async(std::launch::async, count_user_shader, request.file, request.text, precisions));
    for (std::size_t i = 0; i < kAll.size(); ++i) {
        UserShaderVariant variant{.precisions = kAll[i], .stage = counting[i].get()};
        variant.work = user_pass(variant.stage.counts, request.textures, request.target);
        for (const Profile& profile : request.profiles) variant.costs.push_back(cost_of(variant.work, profile));
        cost.variants.push_back(std::move(variant));
    }
    return cost;
}

std::string user_shader_text(const UserShaderCost& cost) {
    std::string text = fmt::format("cost of {}: {}x{} {}\nmodel version {}, {}\n\n", cost.file, cost.target.width,
                                   cost.target.height, gl::name(cost.target.format), kModelVersion, cost.compiler);
    perf::TextTable counts({{"precision"},
                            {"slots", Align::right},
                            {"moves", Align::right},
                            {"half normalizes", Align::right},
                            {"fetches", Align::right},
                            {"Xenos instr.", Align::right},
                            {"MADs", Align::right},
                            {"temporaries", Align::left},
                            {"branches", Align::right}});
    for (const UserShaderVariant& variant : cost.variants) {
        const ShaderCounts& one = variant.stage.counts;
        counts.add_row({name(variant.precisions), fmt::format("{:g}", one.weighted.work.slots),
                        fmt::format("{:g}", one.weighted.moves), fmt::format("{:g}", one.weighted.work.normalizes),
                        fmt::format("{:g}", one.weighted.fetch_count()),
                        fmt::format("{:g}", co_issued(one.weighted.work)), fmt::format("{:g}", one.weighted.work.mads),
                        fmt::format("{} full {} half", one.temporaries.full, one.temporaries.half),
                        std::to_string(one.branches)});
    }
    text += counts.text() + "\n";
    perf::TextTable times({{"device"}, {"precision"}, {"ms", Align::right}, {"band"}, {"branches"}, {"bound by"}});
    for (std::size_t device = 0; device < cost.profiles.size(); ++device) {
        for (const UserShaderVariant& variant : cost.variants) {
            const PassCost& pass = variant.costs[device];
            times.add_row(
                {variant.precisions == Precisions::as_written ? cost.profiles[device].name : "",
                 name(variant.precisions), ms_text(pass.ms), ms_text(pass.low_ms) + ".." + ms_text(pass.high_ms),
                 pass.longest_ms > pass.shortest_ms ? ms_text(pass.shortest_ms) + ".." + ms_text(pass.longest_ms) : "-",
                 pass.bound});
        }
    }
    text += times.text() + "\n";
    text += perf::wrapped(fmt::format("Branches: {}. Textures are rgba8, as large as the target, unless --texture says "
                                      "otherwise. {}",
                                      cost.variants.front().stage.counts.weighting, kModelledWords),
                          kLineWidth, 0) +
            "\n";
    for (const std::string& notice : cost.variants.front().stage.counts.notices) text += "notice: " + notice + "\n";
    return text;
}

std::string user_shader_listing(const UserShaderCost& cost, const std::string& text) {
    return listing_text(cost.variants.front().stage, [&](const std::string&) { return text; }) + kModelledWords + "\n";
}

std::string user_shader_csv(const UserShaderCost& cost) {
    std::string csv = "shader,precision,device,ms,low_ms,high_ms,shortest_ms,longest_ms,bound\n";
    for (const UserShaderVariant& variant : cost.variants) {
        for (std::size_t device = 0; device < cost.profiles.size(); ++device) {
            const PassCost& pass = variant.costs[device];
            csv += fmt::format("{},{},{},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{}\n", cost.file, name(variant.precisions),
                               cost.profiles[device].name, pass.ms, pass.low_ms, pass.high_ms, pass.shortest_ms,
                               pass.longest_ms, pass.bound);
        }
    }
    return csv;
}

Json user_shader_json(const UserShaderCost& cost) {
    Json variants = Json::array();
    for (const UserShaderVariant& variant : cost.variants) {
        const ShaderCounts& counts = variant.stage.counts;
        Json devices = Json::array();
        for (std::size_t device = 0; device < cost.profiles.size(); ++device) {
            const PassCost& pass = variant.costs[device];
            devices.push_back({{"profile", cost.profiles[device].name},
                               {"ms", pass.ms},
                               {"low_ms", pass.low_ms},
                               {"high_ms", pass.high_ms},
                               {"shortest_ms", pass.shortest_ms},
                               {"longest_ms", pass.longest_ms},
                               {"bound", pass.bound}});
        }
        variants.push_back({{"precision", name(variant.precisions)},
                            {"weighted", path_json(counts.weighted)},
                            {"shortest", path_json(counts.shortest)},
                            {"longest", path_json(counts.longest)},
                            {"branches", counts.branches},
                            {"weighting", counts.weighting},
                            {"full_temporaries", counts.temporaries.full},
                            {"half_temporaries", counts.temporaries.half},
                            {"free_modifiers", counts.free_modifiers},
                            {"fused_multiply_adds", counts.fused_mads},
                            {"devices", devices},
                            {"notices", counts.notices}});
    }
    return {{"shader", cost.file},
            {"width", cost.target.width},
            {"height", cost.target.height},
            {"target", gl::name(cost.target.format)},
            {"model_version", kModelVersion},
            {"compiler", cost.compiler},
            {"modelled", kModelledWords},
            {"variants", variants}};
}

}  // namespace halfframe::cost
