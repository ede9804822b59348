// Counts every program of every card.
#include "perf/cost/effect_table.h"

#include <sstream>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "content/data_files.h"
#include "engine/frame/effect_card.h"
#include "engine/gl/fingerprint.h"
#include "perf/cost/counted_frame.h"
#include "perf/cost/insertion_rows.h"
#include "perf/cost/model.h"
#include "perf/shader_ir/compile.h"

namespace halfframe::cost {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string_view> words_of(std::string_view words) {
    std::vector<std::string_view> list;
    while (!words.empty()) {
        const std::size_t end = std::min(words.find(' '), words.size());
        list.push_back(words.substr(0, end));
        words.remove_prefix(std::min(end + 1, words.size()));
    }
    return list;
}

/// All defines of a program that add something.
std::vector<std::string_view> all_defines(const ShaderVariant& variant) {
    std::vector<std::string_view> defines = words_of(variant.defines);
    const std::vector<std::string_view> simpler = words_of(variant.simpler);
    std::erase_if(defines, [&](std::string_view one) { return std::ranges::find(simpler, one) != simpler.end(); });
    return defines;
}

Json counts_json(const ShaderCounts& counts, const Profile& ps3) {
    FragmentWork fragment{.work = counts.weighted.work};
    for (const double count : counts.weighted.fetches) fragment.fetches.push_back({.count = count});
    return {{"rsx_passes", rsx_passes(fragment, ps3, ps3.at("packing_efficiency"))},
            {"slots", counts.weighted.work.slots},
            {"half_normalizes", counts.weighted.work.normalizes},
            {"fetches", counts.weighted.fetch_count()},
            {"xenos_instructions", co_issued(counts.weighted.work)},
            {"multiply_adds", counts.weighted.work.mads},
            {"full_temporaries", counts.temporaries.full},
            {"half_temporaries", counts.temporaries.half},
            {"branches", counts.branches}};
}

/// What the program with the insertions has above the one without; counts of both stages.
class Marginal {
public:
    Marginal(ShaderLibrary& library, const InsertionRow& row, Tier tier, gl::Arithmetic arithmetic, bool all)
        : arithmetic_(arithmetic),
          without_(describe_variant(*row.host, row.variant, tier, arithmetic, true,
                                    all ? all_defines(row.variant) : std::vector<std::string_view>{})),
          with_(without_),
          library_(library) {
        with_.insertions = row.insertions;
    }

    [[nodiscard]] Json json(const Profile& ps3) const {
        const Json without = counts_json(counts(without_, gl::Stage::fragment), ps3);
        Json more = counts_json(counts(with_, gl::Stage::fragment), ps3);
        for (auto& [key, value] : more.items()) {
            if (value.is_number_float()) value = value.get<double>() - without.at(key).get<double>();
            else value = value.get<int>() - without.at(key).get<int>();
        }
        const auto vertex = [&](const gl::ProgramDescription& one) {
            return co_issued(counts(one, gl::Stage::vertex).weighted.work);
        };
        more["vertex_instructions"] = vertex(with_) - vertex(without_);
        return more;
    }

private:
    [[nodiscard]] const ShaderCounts& counts(const gl::ProgramDescription& one, gl::Stage stage) const {
        return library_.stage(one, stage, arithmetic_).counts;
    }

    gl::Arithmetic arithmetic_;
    gl::ProgramDescription without_, with_;
    ShaderLibrary& library_;
};

void add_marginal_rows(ShaderLibrary& library, const Profile& ps3, Json& rows) {
    const auto by_tier = insertion_rows();
    for (std::size_t tier = 0; tier < by_tier.size(); ++tier) {
        for (const InsertionRow& insertion : by_tier[tier]) {
            for (const gl::Arithmetic arithmetic : {gl::Arithmetic::half, gl::Arithmetic::full}) {
                for (const bool all : {false, true}) {
                    if (all && insertion.variant.defines.empty()) continue;
                    Json row{
                        {"effect", insertion.effect->name},       {"tier", halfframe::name(static_cast<Tier>(tier))},
                        {"fragment", insertion.variant.fragment}, {"arithmetic", halfframe::name(arithmetic)},
                        {"defines", all ? "all" : "none"},        {"marginal", true}};
                    row.update(Marginal(library, insertion, static_cast<Tier>(tier), arithmetic, all).json(ps3));
                    rows.push_back(std::move(row));
                }
            }
        }
    }
}

}  // namespace

std::string effect_table_text() {
    const Profile ps3 = load_profile("ps3");
    ShaderLibrary library;
    Json rows = Json::array();
    for (const EffectCard* card : all_effects()) {
        for (int tier = 0; tier < kTierCount; ++tier) {
            for (const ShaderVariant& variant : card->tiers[static_cast<std::size_t>(tier)].shaders) {
                for (const gl::Arithmetic arithmetic : {gl::Arithmetic::half, gl::Arithmetic::full}) {
                    for (const bool all : {false, true}) {
                        const std::vector<std::string_view> defines =
                            all ? all_defines(variant) : std::vector<std::string_view>{};
                        if (all && defines.empty()) continue;
                        const gl::ProgramDescription description =
                            describe_variant(*card, variant, static_cast<Tier>(tier), arithmetic, true, defines);
                        Json row{{"effect", card->name},
                                 {"tier", halfframe::name(static_cast<Tier>(tier))},
                                 {"fragment", variant.fragment},
                                 {"arithmetic", halfframe::name(arithmetic)},
                                 {"defines", all ? "all" : "none"}};
                        row.update(
                            counts_json(library.stage(description, gl::Stage::fragment, arithmetic).counts, ps3));
                        rows.push_back(std::move(row));
                    }
                }
            }
        }
    }
    add_marginal_rows(library, ps3, rows);
    // One row a line, so that a change of one shader is a change of a few lines.
    std::ostringstream text;
    text << "{\n  \"model_version\": " << kModelVersion
         << ",\n  \"compiler\": " << Json(shader_ir::compiler_versions()).dump() << ",\n  \"rows\": [\n";
    for (std::size_t i = 0; i < rows.size(); ++i)
        text << "    " << rows[i].dump() << (i + 1 < rows.size() ? ",\n" : "\n");
    text << "  ]\n}\n";
    return text.str();
}

std::string counts_fingerprint(const std::string& effects) {
    std::uint64_t hash = gl::fingerprint(effects);
    for (const content::DataFile& file : content::data_files())
        if (std::string_view(file.path).starts_with("profiles/")) hash = gl::fingerprint(file.text, hash);
    return fmt::format("{:016x}", hash);
}

}  // namespace halfframe::cost
