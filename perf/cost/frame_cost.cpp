// Runs the model over the passes of a frame, with each effect that adds code to others' shaders, and without.
#include "perf/cost/frame_cost.h"

#include <algorithm>
#include <set>

#include "perf/shader_ir/compile.h"

namespace halfframe::cost {
namespace {

std::vector<PassCost> costs_of(const std::vector<PassWork>& works, const Profile& profile) {
    std::vector<PassCost> costs;
    for (const PassWork& work : works) costs.push_back(cost_of(work, profile));
    return costs;
}

/// By effect: the passes without its code.
using Without = std::map<std::string, std::vector<PassWork>>;

std::vector<EffectCost> effects_of(const FramePlan& plan, const Profile& profile, const std::vector<PassCost>& passes,
                                   const Without& without) {
    std::vector<EffectCost> effects;
    for (const EffectDecision& decision : plan.effects) {
        if (!decision.in) continue;
        EffectCost cost{.effect = decision.effect};
        double most_ms = -1.0;
        for (std::size_t i = 0; i < plan.passes.size(); ++i) {
            const bool own = plan.passes[i].effect == decision.effect;
            double part_ms = own ? passes[i].ms : 0.0;
            cost.passes += own;
            for (const auto& [inserting, works] : without) {
                const bool self = inserting == decision.effect;
                if (self == own) continue;  // its code in its own pass is its own; others' code in others' is theirs
                const double marginal_ms = passes[i].ms - cost_of(works[i], profile).ms;
                part_ms += self ? marginal_ms : -marginal_ms;
                if (self) cost.marginal_ms += marginal_ms;
            }
            cost.ms += part_ms;
            if (part_ms <= most_ms || part_ms == 0.0) continue;
            most_ms = part_ms;
            cost.bound = passes[i].bound;
        }
        effects.push_back(cost);
    }
    return effects;
}

}  // namespace

const EffectCost* DeviceCost::find(const std::string& effect) const {
    const auto found = std::ranges::find(effects, effect, &EffectCost::effect);
    return found != effects.end() ? &*found : nullptr;
}

double DeviceCost::frame_ms(double PassCost::*kind) const {
    double sum = 0.0;
    for (const PassCost& pass : passes) sum += pass.*kind;
    return sum;
}

double DeviceCost::other_frame_ms() const {
    double sum = 0.0;
    for (const PassCost& pass : other_passes) sum += pass.ms;
    return sum;
}

WorkSum FrameCost::sum() const {
    WorkSum sum;
    for (const PassWork& pass : works) sum.add(pass);
    return sum;
}

FrameCost frame_cost(const CountedFrame& frame, ShaderLibrary& library, gl::Arithmetic arithmetic,
                     const std::vector<Profile>& profiles) {
    const gl::Arithmetic other = arithmetic == gl::Arithmetic::half ? gl::Arithmetic::full : gl::Arithmetic::half;
    FrameCost cost{.scene = frame.plan.scene, .arithmetic = arithmetic, .plan = frame.plan};
    cost.works = pass_works(frame, library, arithmetic);
    cost.other_works = pass_works(frame, library, other);
    cost.notices = frame.notices;
    cost.compiler = shader_ir::compiler_versions();
    cost.texture_bytes = frame.texture_bytes;
    std::set<std::uint32_t> programs;
    for (const RecordedDraw& draw : frame.draws)
        if (draw.program != 0) programs.insert(draw.program);
    cost.programs = static_cast<int>(programs.size());
    Without without, other_without;
    for (const EffectDecision& decision : frame.plan.effects) {
        if (!decision.in || decision.insertions.empty()) continue;
        without[decision.effect] = pass_works(frame, library, arithmetic, decision.effect);
        other_without[decision.effect] = pass_works(frame, library, other, decision.effect);
    }
    for (const Profile& profile : profiles) {
        DeviceCost device{.profile = profile,
                          .passes = costs_of(cost.works, profile),
                          .other_passes = costs_of(cost.other_works, profile)};
        device.effects = effects_of(frame.plan, profile, device.passes, without);
        const std::vector<EffectCost> others = effects_of(frame.plan, profile, device.other_passes, other_without);
        for (std::size_t i = 0; i < others.size(); ++i) device.effects[i].other_ms = others[i].ms;
        cost.devices.push_back(std::move(device));
    }
    return cost;
}

}  // namespace halfframe::cost
