// Plans a frame: asks every card, chooses storage, orders the passes. Pure: nothing here knows GL.
#include "engine/frame/frame_plan.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/error.h"
#include "shaders_es/common/packing_limits.h"
#include "shaders_es/tone_map/tone_map_limits.h"

namespace halfframe {

namespace {

using gl::PixelFormat;

constexpr std::array kLadder = {PixelFormat::rgba16f, PixelFormat::r11g11b10f, PixelFormat::rgb10_a2,
                                PixelFormat::rgba8};

bool renders(const gl::Caps& caps, PixelFormat format) { return caps.renders[static_cast<std::size_t>(format)]; }

/// A limit that a tier's shaders count on: the minimum of ES 2.0 for low, of ES 3.0 above (what the shader gates
/// check).
struct NeededLimit {
    const char* what;
    int gl::Caps::*has;
    int low;
    int above;
};
constexpr std::array kNeededLimits = {
    NeededLimit{"vertex attributes", &gl::Caps::max_vertex_attributes, 8, 16},
    NeededLimit{"vertex uniform vectors", &gl::Caps::max_vertex_uniform_vectors, 128, 256},
    NeededLimit{"fragment uniform vectors", &gl::Caps::max_fragment_uniform_vectors, 16, 224},
    NeededLimit{"varying vectors", &gl::Caps::max_varying_vectors, 8, 15},
    NeededLimit{"fragment samplers", &gl::Caps::max_fragment_samplers, 8, 16},
};

std::optional<std::string> missing_limit(Tier tier, const gl::Caps& caps) {
    for (const NeededLimit& limit : kNeededLimits) {
        const int needed = tier == Tier::low ? limit.low : limit.above;
        if (caps.*limit.has >= needed) continue;
        return fmt::format("tier {} needs {} {} and {} has {}", name(tier), needed, limit.what, caps.device,
                           caps.*limit.has);
    }
    return std::nullopt;
}

/// Why `tier` cannot run on this device, or nothing.
std::optional<std::string> tier_obstacle(Tier tier, const gl::Caps& caps) {
    if (tier == Tier::low) return missing_limit(tier, caps);
    if (caps.es_version < 30) {
        return fmt::format("tier {} needs OpenGL ES 3.0 and {} is ES {}.{}", name(tier), caps.device,
                           caps.es_version / 10, caps.es_version % 10);
    }
    if (tier == Tier::reference && !renders(caps, PixelFormat::rgba32f) && !renders(caps, PixelFormat::rgba16f)) {
        return fmt::format("tier reference needs a float target (EXT_color_buffer_float) and {} renders none",
                           caps.device);
    }
    return missing_limit(tier, caps);
}

Tier chosen_tier(const Wishes& wishes, const gl::Caps& caps) {
    if (!wishes.tier && !tier_obstacle(Tier::console, caps)) return Tier::console;
    if (const auto obstacle = tier_obstacle(Tier::low, caps)) {
        throw Error(Fault::usage, *obstacle + ", so no tier runs there; use another --device");
    }
    if (!wishes.tier) return Tier::low;
    if (const auto obstacle = tier_obstacle(*wishes.tier, caps)) {
        throw Error(Fault::usage, *obstacle + "; use --tier low, or another --device");
    }
    return *wishes.tier;
}

Arithmetic chosen_arithmetic(const Wishes& wishes, const gl::Caps& caps) {
    if (!wishes.arithmetic) return caps.software && caps.fragment_highp ? Arithmetic::full : Arithmetic::half;
    if (*wishes.arithmetic == Arithmetic::full && !caps.fragment_highp) {
        throw Error(Fault::usage, fmt::format("full arithmetic needs highp in fragment shaders and {} has none; "
                                              "use --arithmetic half",
                                              caps.device));
    }
    return *wishes.arithmetic;
}

/// A format of scene_color, and what decided it.
struct Storage {
    PixelFormat format;
    std::string why;
};

Storage chosen_storage(const Wishes& wishes, Tier tier, const gl::Caps& caps) {
    if (wishes.storage) {
        if (!renders(caps, *wishes.storage)) {
            throw Error(Fault::usage,
                        fmt::format("storage {} does not render on {}; leave --storage out to get the best "
                                    "that does",
                                    name(*wishes.storage), caps.device));
        }
        return {*wishes.storage, "it was asked for by name"};
    }
    if (tier == Tier::low) return {PixelFormat::rgba8, "tier low stores what is shown"};
    const std::string why = tier == Tier::reference ? "tier reference stores light" : "";
    if (tier == Tier::reference && renders(caps, PixelFormat::rgba32f)) return {PixelFormat::rgba32f, why};
    for (const PixelFormat format : kLadder) {
        if (renders(caps, format)) return {format, why};
    }
    throw Error(Fault::context, fmt::format("{} renders no colour format at all", caps.device));
}

/// Why light is stored whatever the plan, as a sentence, or nothing.
std::optional<std::string> wish_for_light(const Wishes& wishes) {
    if (wishes.reads_light) return "it is read back as light";
    // Where shaders map their own light, what guards the curve makes 0 of a NaN before anything stores it.
    if (wishes.census) return "the census counts what light holds";
    return std::nullopt;
}

/// The first pass that blends into 32-bit floats, or nothing.
const Pass* blends_into_float32(const FramePlan& plan) {
    const auto blends = [&](const Pass& pass) {
        return pass.blends && pass.color &&
               plan.targets[static_cast<std::size_t>(*pass.color)].format == PixelFormat::rgba32f;
    };
    const auto found = std::ranges::find_if(plan.passes, blends);
    return found != plan.passes.end() ? &*found : nullptr;
}

/// What in a plan that stores light needs it stored, as a sentence, or nothing: then only the pass that maps light
/// reads it, and whatever draws may map its own.
std::optional<std::string> need_of_light(const FramePlan& plan) {
    const int light = plan.target_index("scene_color");
    for (const Pass& pass : plan.passes) {
        if (pass.resolves && pass.color == light) return fmt::format("{} averages samples of light", pass.effect);
        if (pass.blends && pass.color == light) return fmt::format("{} blends light", pass.effect);
        const bool reads = std::ranges::find(pass.reads, light) != pass.reads.end();
        if (reads && pass.order != PassOrder::display) return fmt::format("{} reads light", pass.effect);
    }
    return std::nullopt;
}

Tier tier_for(std::string_view effect, Tier tier, const Wishes& wishes, const gl::Caps& caps) {
    for (const auto& [wished_effect, wished] : wishes.effect_tiers) {
        if (wished_effect != effect) continue;
        if (const auto obstacle = tier_obstacle(wished, caps)) {
            throw Error(Fault::usage, fmt::format("{}; use --tier {}=low, or another --device", *obstacle, effect));
        }
        tier = wished;
    }
    return tier;
}

bool is_named(std::string_view effect, const Wishes& wishes) {
    return std::ranges::any_of(wishes.effect_tiers, [&](const auto& wish) { return wish.first == effect; });
}

/// The tier of every card: as wished, and that of the effect whose shaders a card draws with (transparent: surface's).
std::vector<Tier> tiers_of(std::span<const EffectCard* const> cards, Tier tier, const Wishes& wishes,
                           const gl::Caps& caps) {
    std::vector<Tier> tiers;
    for (const EffectCard* card : cards) {
        tiers.push_back(tier_for(card->name, tier, wishes, caps));
        if (is_named(card->name, wishes)) continue;
        for (std::size_t i = 0; i + 1 < tiers.size(); ++i) {
            const auto& theirs = cards[i]->tiers[0].shaders;
            const auto& own = card->tiers[0].shaders;
            if (!own.empty() && !theirs.empty() && own.front().fragment == theirs.front().fragment)
                tiers.back() = tiers[i];
        }
    }
    return tiers;
}

std::optional<bool> switch_for(std::string_view effect, const Wishes& wishes) {
    std::optional<bool> on;
    for (const auto& [wished_effect, wished] : wishes.effect_switches) {
        if (wished_effect == effect) on = wished;
    }
    return on;
}

PlanContext at_tier(const PlanContext& context, Tier tier) {
    return {context.scene, context.view, context.caps, tier, context.arithmetic, context.storage, context.plan};
}

/// What `card` adds to the shaders of `host`, as words to compare.
std::vector<std::string> added_to(const EffectCard& card, const PlanContext& context, const EffectCard& host,
                                  Tier host_tier) {
    std::vector<std::string> added;
    if (card.insertions == nullptr) return added;
    for (const gl::Insertion& one : card.insertions(context)) {
        for (const ShaderVariant& variant : host.tiers[static_cast<std::size_t>(host_tier)].shaders) {
            if (!std::string_view(one.point).starts_with(insertion_prefix(variant))) continue;
            added.push_back(fmt::format("{} {}", one.file != nullptr ? one.file : "", one.code));
            break;
        }
    }
    return added;
}

/// `context`'s tier; that of the effect whose shaders the card's code goes into, where one of the two is low and the card
/// adds something else there. What is added is compiled with them: at low they are ES 1.00, and hold other stages.
Tier fitting_tier(const EffectCard& card, const PlanContext& context, std::span<const EffectCard* const> cards,
                  std::span<const Tier> tiers, const Wishes& wishes) {
    Tier tier = context.tier;
    if (card.insertions == nullptr || !switch_for(card.name, wishes).value_or(card.called_for(context).called_for))
        return tier;
    bool may_follow = !is_named(card.name, wishes);
    for (std::size_t i = 0; i < cards.size(); ++i) {
        const EffectCard& host = *cards[i];
        const std::vector<std::string> added = added_to(card, at_tier(context, tier), host, tiers[i]);
        if (added.empty() || !host.called_for(at_tier(context, tiers[i])).called_for) continue;
        // Above low shaders are of one language, and hold what is added at either tier.
        const bool differs = (tier == Tier::low) != (tiers[i] == Tier::low);
        if (differs && added != added_to(card, at_tier(context, tiers[i]), host, tiers[i])) {
            if (!may_follow) {
                throw Error(Fault::usage,
                            fmt::format("{0} at {1} adds code to the shaders of {2} that {2} at {3} cannot hold; use "
                                        "--tier {0}={3} or --tier {2}={1}",
                                        card.name, name(tier), host.name, name(tiers[i])));
            }
            tier = tiers[i];
        }
        may_follow = false;
    }
    return tier;
}

void check_names(const Wishes& wishes, std::span<const EffectCard* const> cards) {
    const auto known = [&](const std::string& effect) {
        return std::ranges::any_of(cards, [&](const EffectCard* card) { return card->name == effect; });
    };
    const auto refuse = [&](const std::string& effect) {
        std::string names;
        for (const EffectCard* card : cards) names += (names.empty() ? "" : ", ") + std::string(card->name);
        throw Error(Fault::usage, fmt::format("there is no effect called {}; there are {}", effect, names));
    };
    for (const auto& [effect, tier] : wishes.effect_tiers) {
        if (!known(effect)) refuse(effect);
    }
    for (const auto& [effect, on] : wishes.effect_switches) {
        if (!known(effect)) refuse(effect);
    }
}

/// What a display value becomes in scene_color, so that a background looks the same on every rung of the ladder.
glm::vec4 background_in(const glm::vec3& display, PixelFormat storage) {
    if (holds_display_values(storage)) return {display, 1.0f};
    glm::vec3 light{0.0f};
    for (int i = 0; i < 3; ++i) {
        const float y = std::clamp(display[i], 0.0f, 1.0f);
        light[i] = static_cast<float>(TONE_MAP_A * y / (TONE_MAP_B - y));
        if (storage == PixelFormat::rgb10_a2) {  // packed as in shaders_es/common/packing.glsl
            light[i] = static_cast<float>(std::sqrt(std::min(light[i] / SCENE_COLOR_RANGE, 1.0)));
        }
    }
    return {light, 1.0f};
}

/// The first pass that writes a target starts it: with a clear, or with nothing if it covers every pixel anyway.
void set_start_actions(FramePlan& plan, const glm::vec4& background) {
    std::vector<bool> started(plan.targets.size(), false);
    for (Pass& pass : plan.passes) {
        if (pass.color && !started[static_cast<std::size_t>(*pass.color)]) {
            started[static_cast<std::size_t>(*pass.color)] = true;
            const bool covers = pass.full_screen && !pass.depth;
            pass.start_color = covers ? StartAction::discard : StartAction::clear;
            pass.clear_color = background;
        }
        if (pass.depth && !started[static_cast<std::size_t>(*pass.depth)]) {
            started[static_cast<std::size_t>(*pass.depth)] = true;
            pass.start_depth = StartAction::clear;
        }
    }
}

/// Asks one card, and lets it add what it adds.
void decide(const EffectCard& card, const PlanContext& context, const Wishes& wishes, FramePlan& plan) {
    EffectDecision decision{
        .effect = std::string(card.name), .in = false, .tier = context.tier, .why = {}, .insertions = {}};
    const Demand demand = card.called_for(context);
    decision.in = demand.called_for;
    decision.why = demand.why;
    if (const auto on = switch_for(card.name, wishes); on && *on != demand.called_for) {
        if (!*on && !card.indispensable.empty()) {
            throw Error(Fault::usage, fmt::format("{} cannot be switched off: {}; leave {}.on out", card.name,
                                                  card.indispensable, card.name));
        }
        decision.in = *on;
        decision.why = fmt::format("switched {} by hand; by itself {}: {}", *on ? "on" : "off",
                                   demand.called_for ? "in" : "out", demand.why);
    }
    if (decision.in) {
        if (card.add_passes) card.add_passes(context, plan);
        if (card.insertions) {
            const auto insertions = card.insertions(context);
            decision.insertions.assign(insertions.begin(), insertions.end());
        }
    }
    plan.effects.push_back(std::move(decision));
}

TextureCompression chosen_textures(const Wishes& wishes, const gl::Caps& caps, std::vector<std::string>& notices) {
    const bool wished = wishes.textures ? *wishes.textures == TextureCompression::dxt : caps.prefers_s3tc;
    if (!wished) return TextureCompression::none;
    if (caps.s3tc) return TextureCompression::dxt;
    notices.push_back(
        fmt::format("textures are not compressed: {} has no GL_EXT_texture_compression_s3tc", caps.device));
    return TextureCompression::none;
}

}  // namespace

std::size_t FramePlan::target_bytes() const {
    std::size_t sum = 0;
    for (const Target& target : targets) sum += target.bytes();
    return sum;
}

double FramePlan::bytes_per_pixel() const {
    const double pixels = static_cast<double>(width) * static_cast<double>(height);
    double bytes = 0.0;
    for (const Target& target : targets) bytes += target.fixed_size ? 0.0 : static_cast<double>(target.bytes());
    return pixels > 0.0 ? bytes / pixels : 0.0;
}

const EffectDecision* FramePlan::find(std::string_view effect) const {
    const auto found = std::ranges::find(effects, effect, &EffectDecision::effect);
    return found == effects.end() ? nullptr : &*found;
}

int FramePlan::target_index(std::string_view target) const {
    for (std::size_t i = 0; i < targets.size(); ++i) {
        if (targets[i].name == target) return static_cast<int>(i);
    }
    return -1;
}

int FramePlan::add_target(std::string_view target_name, gl::PixelFormat format) {
    return add_target({.name = std::string(target_name), .format = format, .width = width, .height = height});
}

int FramePlan::add_target(Target target) {
    if (const int index = target_index(target.name); index >= 0) return index;
    if (census && !gl::is_depth(target.format)) target.format = PixelFormat::rgba32f;
    targets.push_back(std::move(target));
    return static_cast<int>(targets.size()) - 1;
}

int FramePlan::add_scene_color() {
    // Where materials store display values, the picture needs no second target.
    const bool is_display = holds_display_values(storage);
    const int index = add_target(is_display ? "display" : "scene_color", storage);
    if (is_display) display = index;
    return index;
}

int FramePlan::add_scene_depth() { return add_target("depth", depth_format); }

namespace {

/// Everything but the choice of storage.
FramePlan planned(const Storage& storage, const Scene& scene, const View& view, const Wishes& wishes,
                  const gl::Caps& caps, std::span<const EffectCard* const> cards) {
    FramePlan plan;
    plan.scene = scene.name;
    plan.exposure = view.exposure;
    plan.width = view.width;
    plan.height = view.height;
    plan.tier = chosen_tier(wishes, caps);
    plan.arithmetic = chosen_arithmetic(wishes, caps);
    plan.storage = storage.format;
    plan.why_storage = storage.why;
    plan.census = wishes.census;
    plan.fixed_view = wishes.fixed_view;
    plan.vertices = wishes.vertices;
    plan.textures = chosen_textures(wishes, caps, plan.notices);
    if (!wishes.storage && !wishes.census) plan.bytes_per_pixel_limit = bytes_per_pixel_limit(plan.tier);
    plan.depth_format =
        renders(caps, PixelFormat::depth24) && plan.tier != Tier::low ? PixelFormat::depth24 : PixelFormat::depth16;
    if (wishes.census && !renders(caps, PixelFormat::rgba32f)) {
        throw Error(Fault::usage, fmt::format("the census needs RGBA32F targets and {} does not render them; leave "
                                              "--census out or use --device native",
                                              caps.device));
    }
    const std::vector<Tier> tiers = tiers_of(cards, plan.tier, wishes, caps);
    for (std::size_t i = 0; i < cards.size(); ++i) {
        const PlanContext wished{scene, view, caps, tiers[i], plan.arithmetic, plan.storage, plan};
        const Tier tier = fitting_tier(*cards[i], wished, cards, tiers, wishes);
        decide(*cards[i], {scene, view, caps, tier, plan.arithmetic, plan.storage, plan}, wishes, plan);
    }
    std::ranges::stable_sort(plan.passes, {}, &Pass::order);
    const glm::vec4 background = background_in(scene.background, plan.storage);
    if (plan.display < 0 && !plan.passes.empty()) {
        throw Error(Fault::usage, fmt::format("no effect of this build brings {} to the display; use --storage rgba8",
                                              name(plan.storage)));
    }
    if (plan.display < 0) {
        // Nothing that draws was called for: the picture is the background.
        plan.display = plan.add_target("display", PixelFormat::rgba8);
        Pass clear;
        clear.name = "clear";
        clear.order = PassOrder::display;
        clear.color = plan.display;
        plan.passes.push_back(clear);
        set_start_actions(plan, {scene.background, 1.0f});
        return plan;
    }
    set_start_actions(plan, background);
    if (wishes.storage && plan.bytes_per_pixel() > bytes_per_pixel_limit(plan.tier)) {
        plan.notices.push_back(
            fmt::format("the targets take {:.1f} bytes a pixel, over the {:.1f} of tier {}: {} was asked for by name",
                        plan.bytes_per_pixel(), bytes_per_pixel_limit(plan.tier), name(plan.tier), name(plan.storage)));
    }
    return plan;
}

}  // namespace

FramePlan plan_frame(const Scene& scene, const View& view, const Wishes& wishes, const gl::Caps& caps,
                     std::span<const EffectCard* const> cards) {
    check_names(wishes, cards);
    const Tier tier = chosen_tier(wishes, caps);
    Storage storage = chosen_storage(wishes, tier, caps);
    if (!wishes.storage && tier == Tier::console) {
        // What reads light shows in the plan that stores it.
        const PixelFormat light = holds_display_values(storage.format) ? kLadder.front() : storage.format;
        std::optional<std::string> need = wish_for_light(wishes);
        if (!need) need = need_of_light(planned({light, ""}, scene, view, wishes, caps, cards));
        if (!need)
            return planned({kLadder.back(), "no pass reads, blends or averages light"}, scene, view, wishes, caps,
                           cards);
        storage.why = *need;
    }
    FramePlan plan = planned(storage, scene, view, wishes, caps, cards);
    if (const Pass* blending = caps.float_blend ? nullptr : blends_into_float32(plan); blending != nullptr) {
        if (wishes.storage || wishes.census) {
            throw Error(Fault::usage,
                        fmt::format("{} blends into RGBA32F, which {} does not do (GL_EXT_float_blend); {}",
                                    blending->effect, caps.device,
                                    wishes.census ? "leave --census out or use --device native"
                                                  : "use --storage rgba16f or leave it out"));
        }
        storage = {*std::ranges::find_if(kLadder, [&](PixelFormat format) { return renders(caps, format); }),
                   fmt::format("{} and {} does not blend RGBA32F", storage.why, caps.device)};
        plan = planned(storage, scene, view, wishes, caps, cards);
    }
    const bool best = storage.format == kLadder.front() || storage.format == PixelFormat::rgba32f;
    if (!wishes.storage && tier != Tier::low && !best) {
        plan.notices.insert(plan.notices.begin(),
                            fmt::format("{} does not render {}, so scene_color is {}", caps.device,
                                        name(kLadder.front()), name(storage.format)));
    }
    return plan;
}

namespace {

std::optional<std::string> broken_samples_rule(const FramePlan& plan, const Pass& pass,
                                               const std::vector<bool>& written) {
    const auto target = [&](int index) -> const Target& { return plan.targets[static_cast<std::size_t>(index)]; };
    for (const int read : pass.reads) {
        if (target(read).samples > 1)
            return fmt::format("pass {} samples {}, which is not resolved", pass.name, target(read).name);
    }
    if (pass.color && pass.depth && target(*pass.color).samples != target(*pass.depth).samples) {
        return fmt::format("pass {} draws into {} and {}, which differ in samples", pass.name, target(*pass.color).name,
                           target(*pass.depth).name);
    }
    if (!pass.resolves) return std::nullopt;
    const Target& from = target(*pass.resolves);
    if (!written[static_cast<std::size_t>(*pass.resolves)])
        return fmt::format("pass {} resolves {} before any pass has written it", pass.name, from.name);
    const bool fits = pass.color && target(*pass.color).samples == 1 && target(*pass.color).format == from.format &&
                      target(*pass.color).width == from.width && target(*pass.color).height == from.height;
    if (!fits) return fmt::format("pass {} resolves {} into a target that is not like it", pass.name, from.name);
    return std::nullopt;
}

std::optional<std::string> broken_pass_rule(const FramePlan& plan, const Pass& pass, std::vector<bool>& written) {
    for (const int read : pass.reads) {
        const std::string& target = plan.targets[static_cast<std::size_t>(read)].name;
        if (!written[static_cast<std::size_t>(read)]) {
            return fmt::format("pass {} reads {} before any pass has written it", pass.name, target);
        }
        if (read == pass.color || read == pass.depth) {
            return fmt::format("pass {} samples {} while it is bound as its own target", pass.name, target);
        }
    }
    if (auto broken = broken_samples_rule(plan, pass, written)) return broken;
    for (const auto& [target, start] :
         {std::pair{pass.color, pass.start_color}, std::pair{pass.depth, pass.start_depth}}) {
        if (!target) continue;
        if (!written[static_cast<std::size_t>(*target)] && start == StartAction::keep) {
            return fmt::format("pass {} keeps what is in {} and nothing has been written there", pass.name,
                               plan.targets[static_cast<std::size_t>(*target)].name);
        }
        written[static_cast<std::size_t>(*target)] = true;
    }
    return std::nullopt;
}

}  // namespace

std::optional<std::string> broken_rule(const FramePlan& plan, const gl::Caps& caps) {
    for (const Target& target : plan.targets) {
        if (target.width < 1 || target.height < 1) return fmt::format("target {} has no pixels", target.name);
        if (!renders(caps, target.format)) {
            return fmt::format("target {} is {}, which {} does not render", target.name, name(target.format),
                               caps.device);
        }
        if (target.samples > 1 && target.samples > caps.samples[static_cast<std::size_t>(target.format)]) {
            return fmt::format("target {} has {} samples a pixel, which {} does not give {}", target.name,
                               target.samples, caps.device, name(target.format));
        }
        const bool in_renderbuffer = (gl::is_depth(target.format) || target.samples > 1) && !target.compared;
        const int limit = in_renderbuffer ? caps.max_renderbuffer_size : caps.max_texture_size;
        if (target.compared && (caps.es_version < 30 || !gl::is_depth(target.format)))
            return fmt::format("target {} is compared with, which needs a depth format and ES 3.0", target.name);
        if (target.width > limit || target.height > limit) {
            return fmt::format("target {} is {}x{} pixels and {} allows {}", target.name, target.width, target.height,
                               caps.device, limit);
        }
    }
    if (const Pass* blending = caps.float_blend ? nullptr : blends_into_float32(plan); blending != nullptr)
        return fmt::format("pass {} blends into RGBA32F, which {} does not do", blending->name, caps.device);
    std::vector<bool> written(plan.targets.size(), false);
    for (const Pass& pass : plan.passes) {
        if (auto broken = broken_pass_rule(plan, pass, written)) return broken;
    }
    if (plan.display < 0 || !written[static_cast<std::size_t>(plan.display)])
        return "no pass writes the display target";
    if (plan.bytes_per_pixel_limit && plan.bytes_per_pixel() > *plan.bytes_per_pixel_limit) {
        return fmt::format("the targets take {:.1f} bytes a pixel and tier {} allows {:.1f}", plan.bytes_per_pixel(),
                           name(plan.tier), *plan.bytes_per_pixel_limit);
    }
    return std::nullopt;
}

}  // namespace halfframe
