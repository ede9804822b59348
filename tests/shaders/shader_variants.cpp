// Unfolds the cards into programs.
#include "tests/shaders/shader_variants.h"

#include <algorithm>
#include <array>
#include <set>

#include <fmt/format.h>

#include "content/content.h"
#include "engine/frame/frame_plan.h"
#include "engine/frame/scene.h"

namespace halfframe::shaders {
namespace {

using Words = std::vector<std::string_view>;

Words words_of(std::string_view text) {
    Words words;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(' '), text.size());
        if (end > 0) words.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return words;
}

/// None, each alone, all, and (unless `few`) all but each: one define may take away what the others add.
std::vector<Words> define_sets(std::string_view defines, bool few) {
    const Words all = words_of(defines);
    std::vector<Words> sets = {{}};
    for (const std::string_view word : all) sets.push_back({word});
    if (all.size() > 1) sets.push_back(all);
    for (std::size_t left_out = 0; !few && all.size() > 2 && left_out < all.size(); ++left_out) {
        Words less = all;
        less.erase(less.begin() + static_cast<std::ptrdiff_t>(left_out));
        sets.push_back(less);
    }
    return sets;
}

struct ArithmeticCase {
    Arithmetic arithmetic;
    bool fragment_highp;
    const char* name;
};

std::vector<ArithmeticCase> arithmetic_cases(Tier tier) {
    std::vector<ArithmeticCase> cases = {{Arithmetic::half, true, "half"}, {Arithmetic::full, true, "full"}};
    // Full arithmetic on a device without fragment highp is refused by the plan.
    if (tier == Tier::low) cases.push_back({Arithmetic::half, false, "half without fragment highp"});
    return cases;
}

/// Those of `set` that go into the shaders of `variant` made with `defines`: points are named SHADERS.point.
std::vector<gl::Insertion> insertions_into(const ShaderVariant& variant, const std::vector<gl::Insertion>& set,
                                           const Words& defines) {
    std::vector<gl::Insertion> result;
    const std::string prefix = insertion_prefix(variant);
    for (const gl::Insertion& insertion : set) {
        const bool wanted = insertion.only_with == nullptr ||
                            std::ranges::find(defines, std::string_view(insertion.only_with)) != defines.end();
        if (wanted && std::string_view(insertion.point).starts_with(prefix)) result.push_back(insertion);
    }
    return result;
}

std::string sentence(const EffectCard& card, Tier tier, const ArithmeticCase& arithmetic, const Words& defines,
                     const std::vector<gl::Insertion>& insertions) {
    std::string text = fmt::format("{} {} {}", card.name, name(tier), arithmetic.name);
    for (const std::string_view define : defines) text += fmt::format(" {}", define);
    for (const gl::Insertion& insertion : insertions) text += fmt::format(" + {}", insertion.code);
    return text;
}

bool same(const std::vector<gl::Insertion>& a, const std::vector<gl::Insertion>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const gl::Insertion& x, const gl::Insertion& y) {
        return std::string_view(x.point) == y.point && std::string_view(x.code) == y.code;
    });
}

/// Caps under which no effect has a reason to stay out.
gl::Caps rich_caps() {
    gl::Caps caps;
    caps.es_version = 32;
    caps.max_texture_size = 4096;
    caps.max_cube_map_size = 4096;
    caps.max_vertex_attributes = 16;
    caps.max_vertex_uniform_vectors = 1024;
    caps.max_fragment_uniform_vectors = 1024;
    caps.max_varying_vectors = 31;
    caps.max_fragment_samplers = 32;
    caps.max_vertex_samplers = 32;
    caps.max_combined_samplers = 64;
    caps.renders.fill(true);
    return caps;
}

/// Made once a process: four of them filter an environment, a second each.
const std::vector<Scene>& scenes() {
    static const std::vector<Scene> kScenes = [] {
        std::vector<Scene> made;
        for (const content::BuiltInScene& built_in : content::built_in_scenes()) made.push_back(built_in.make());
        return made;
    }();
    return kScenes;
}

std::set<std::string> stage_files_of(std::span<const EffectCard* const> cards) {
    std::set<std::string> files;
    for (const EffectCard* card : cards) {
        for (const TierCard& tier : card->tiers) {
            for (const ShaderVariant& variant : tier.shaders) {
                files.insert(std::string(variant.vertex));
                files.insert(std::string(variant.fragment));
            }
        }
    }
    return files;
}

/// "a/b" for every a/b.vert with an a/b.frag beside it that no card names.
std::vector<std::string> pairs_without_card(std::span<const EffectCard* const> cards) {
    const std::set<std::string> carded = stage_files_of(cards);
    std::vector<std::string> stems;
    for (const gl::ShaderFile& file : gl::shader_files()) {
        const std::string path = file.path;
        if (!path.ends_with(".vert")) continue;
        const std::string stem = path.substr(0, path.size() - 5);
        if (carded.count(path) == 0 && gl::find_shader_file(stem + ".frag") != nullptr) stems.push_back(stem);
    }
    return stems;
}

}  // namespace

ProgramTexts texts_of(const NamedProgram& program) {
    return {.name = program.name,
            .dialect = program.description.dialect,
            .fragment_highp = program.description.fragment_highp,
            .vertex_file = program.description.vertex,
            .fragment_file = program.description.fragment,
            .vertex = gl::assemble_stage(program.description, gl::Stage::vertex),
            .fragment = gl::assemble_stage(program.description, gl::Stage::fragment)};
}

std::vector<std::vector<gl::Insertion>> every_insertion_set(Tier tier, std::span<const EffectCard* const> cards) {
    constexpr std::array kStorages = {gl::PixelFormat::rgba32f, gl::PixelFormat::rgba16f, gl::PixelFormat::r11g11b10f,
                                      gl::PixelFormat::rgb10_a2, gl::PixelFormat::rgba8};
    const gl::Caps caps = rich_caps();
    const FramePlan nothing_planned;  // no insertion depends on the decisions of other effects
    std::vector<std::vector<gl::Insertion>> sets;
    const auto keep = [&](const std::vector<gl::Insertion>& set) {
        const auto equal = [&](const auto& other) { return same(set, other); };
        if (!set.empty() && std::none_of(sets.begin(), sets.end(), equal)) sets.push_back(set);
    };
    if (std::ranges::all_of(cards, [](const EffectCard* card) { return card->insertions == nullptr; })) return sets;
    for (const Scene& scene : scenes()) {
        const Camera camera = scene.cameras.empty() ? camera_framing(world_box(scene), 1.0f) : scene.cameras.front();
        const View view = view_of(camera, 64, 64);
        for (const gl::PixelFormat storage : kStorages) {
            std::vector<gl::Insertion> together;
            for (const EffectCard* card : cards) {
                const PlanContext context{scene, view, caps, tier, Arithmetic::half, storage, nothing_planned};
                if (card->insertions == nullptr || !card->called_for(context).called_for) continue;
                const auto alone = card->insertions(context);
                keep({alone.begin(), alone.end()});
                together.insert(together.end(), alone.begin(), alone.end());
            }
            keep(together);
        }
    }
    return sets;
}

std::vector<NamedProgram> every_variant(Tier tier, std::span<const EffectCard* const> cards) {
    std::vector<std::vector<gl::Insertion>> sets = every_insertion_set(tier, cards);
    sets.insert(sets.begin(), std::vector<gl::Insertion>{});
    std::vector<NamedProgram> programs;
    std::set<std::string> known;  // sets differ by what only some defines let in
    for (const EffectCard* card : cards) {
        for (const std::vector<gl::Insertion>& set : sets) {
            for (const ShaderVariant& variant : card->tiers[static_cast<std::size_t>(tier)].shaders) {
                // An effect that some surfaces call for is tried with everything else below; alone it needs only its own.
                const bool few = !set.empty() && std::ranges::all_of(set, [](const gl::Insertion& insertion) {
                    return insertion.only_with != nullptr;
                });
                for (const Words& defines : define_sets(variant.defines, few)) {
                    const std::vector<gl::Insertion> insertions = insertions_into(variant, set, defines);
                    if (!set.empty() && insertions.empty()) continue;
                    for (const ArithmeticCase& arithmetic : arithmetic_cases(tier)) {
                        const std::string of = fmt::format("{} {} ", variant.vertex, variant.fragment);
                        if (!known.insert(of + sentence(*card, tier, arithmetic, defines, insertions)).second) continue;
                        gl::ProgramDescription description = describe_variant(
                            *card, variant, tier, arithmetic.arithmetic, arithmetic.fragment_highp, defines);
                        description.insertions = insertions;
                        programs.push_back(
                            {sentence(*card, tier, arithmetic, defines, insertions), std::move(description)});
                    }
                }
            }
        }
    }
    return programs;
}

std::vector<NamedProgram> programs_without_card(std::span<const EffectCard* const> cards) {
    std::vector<NamedProgram> programs;
    for (const std::string& stem : pairs_without_card(cards)) {
        for (const gl::Dialect dialect : {gl::Dialect::es100, gl::Dialect::es300}) {
            for (const Arithmetic arithmetic : {Arithmetic::half, Arithmetic::full}) {
                gl::ProgramDescription description;
                description.name = stem;
                description.vertex = stem + ".vert";
                description.fragment = stem + ".frag";
                description.dialect = dialect;
                description.arithmetic = arithmetic;
                const char* language = dialect == gl::Dialect::es100 ? "es100" : "es300";
                programs.push_back({fmt::format("{} {} {}", stem, language, name(arithmetic)), std::move(description)});
            }
        }
    }
    return programs;
}

std::vector<std::string> unreached_stage_files(std::span<const EffectCard* const> cards) {
    std::set<std::string> reached = stage_files_of(cards);
    for (const std::string& stem : pairs_without_card(cards)) {
        reached.insert(stem + ".vert");
        reached.insert(stem + ".frag");
    }
    std::vector<std::string> unreached;
    for (const gl::ShaderFile& file : gl::shader_files()) {
        const std::string_view path = file.path;
        const bool is_stage = path.ends_with(".vert") || path.ends_with(".frag");
        if (is_stage && reached.count(std::string(path)) == 0) unreached.emplace_back(path);
    }
    return unreached;
}

}  // namespace halfframe::shaders
