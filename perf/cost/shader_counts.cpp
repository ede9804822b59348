// Puts the counts of a stage together: instructions, then the ways through them, then the temporaries.
#include "perf/cost/shader_counts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "engine/error.h"
#include "perf/cost/branch_paths.h"
#include "perf/cost/instruction_work.h"
#include "perf/cost/live_registers.h"
#include "perf/cost/values.h"

namespace halfframe::cost {
namespace {

using shader_ir::Function;

class Counter {
public:
    explicit Counter(const Module& module)
        : module_(module), values_(module), mads_(module, values_), main_(main_of(module)) {}

    ShaderCounts run() {
        list_instructions();
        std::vector<double> cost(main_.blocks.size(), 0.0);
        for (const CountedInstruction& one : counts_.instructions)
            cost[static_cast<std::size_t>(one.block)] +=
                one.work.slots + 0.5 * one.work.normalizes + (one.sampler >= 0 ? 1.0 : 0.0);
        const BlockRuns runs = runs_of(module_, main_, cost);
        for (CountedInstruction& one : counts_.instructions)
            one.weight = runs.weighted[static_cast<std::size_t>(one.block)];
        counts_.shortest = along(runs.shortest);
        counts_.longest = along(runs.longest);
        counts_.weighted = along(runs.weighted);
        counts_.branches = runs.branches;
        counts_.notices = runs.notices;
        counts_.weighting = fmt::format("each side of a branch is taken by {} of the pixels", kBranchWeight);
        counts_.temporaries = live_temporaries(module_, values_, main_);
        counts_.fused_mads = mads_.count();
        if (values_.indexes_memory())
            counts_.notices.emplace_back("an array stays in memory: reading and writing it is not counted");
        if (module_.up_converted) counts_.notices.emplace_back("ES 1.00, counted as its ES 3.00 twin");
        return std::move(counts_);
    }

private:
    static const Function& main_of(const Module& module) {
        expect(module.functions.size() == 1, "only an optimised module, whose one function is main, is counted");
        return module.functions.front();
    }

    void list_instructions() {
        std::set<shader_ir::Id> inputs;
        for (std::size_t block = 0; block < main_.blocks.size(); ++block) {
            for (const Instruction& one : main_.blocks[block].instructions) {
                counts_.discards = counts_.discards || one.op == spv::OpKill;
                if (one.op == spv::OpLoad) inputs.insert(values_.variable_of(one.operands.at(0)));
                if (values_.is_alias(one) && values_.is_modifier(one)) ++counts_.free_modifiers;
                CountedInstruction counted = work_of(module_, values_, mads_, one);
                if (counted.what.empty()) continue;
                if (is_fetch(one.op)) counted.sampler = sampler_of(one);
                counted.block = static_cast<int>(block);
                counts_.instructions.push_back(std::move(counted));
            }
        }
        for (const shader_ir::Variable& variable : module_.variables) {
            if (variable.storage == spv::StorageClassInput && inputs.contains(variable.id) &&
                !variable.name.starts_with("gl_"))
                ++counts_.attributes;
        }
    }

    int sampler_of(const Instruction& fetch) {
        const shader_ir::Id variable = values_.variable_of(fetch.operands.at(0));
        const auto known = sampler_index_.find(variable);
        if (known != sampler_index_.end()) return known->second;
        const auto named = std::ranges::find(module_.variables, variable, &shader_ir::Variable::id);
        expect(named != module_.variables.end(), "a fetch from a sampler that is no uniform");
        const shader_ir::Type* type = &module_.type(named->type);
        while (type->kind == shader_ir::Type::Kind::array) type = &module_.type(type->element);
        SamplerUse use{.name = named->name, .compares = type->compares, .half = values_.half(fetch.result)};
        use.shape = type->dimension == spv::DimCube        ? SamplerUse::Shape::cube
                    : type->dimension == spv::Dim3D        ? SamplerUse::Shape::volume
                    : type->coordinates > type->directions ? SamplerUse::Shape::layers
                                                           : SamplerUse::Shape::flat;
        counts_.samplers.push_back(use);
        return sampler_index_[variable] = static_cast<int>(counts_.samplers.size()) - 1;
    }

    PathCounts along(const std::vector<double>& runs) const {
        PathCounts path;
        path.fetches.assign(counts_.samplers.size(), 0.0);
        path.level_fetches = path.fetches;
        for (const CountedInstruction& one : counts_.instructions) {
            const double weight = runs[static_cast<std::size_t>(one.block)];
            path.work += weight * one.work;
            path.moves += weight * one.moves;
            path.instructions += weight;
            if (one.sampler < 0) continue;
            path.fetches[static_cast<std::size_t>(one.sampler)] += weight;
            if (one.any_level) path.level_fetches[static_cast<std::size_t>(one.sampler)] += weight;
        }
        return path;
    }

    const Module& module_;
    Values values_;
    FusedMads mads_;
    const Function& main_;
    ShaderCounts counts_;
    std::map<shader_ir::Id, int> sampler_index_;
};

}  // namespace

Work& Work::operator+=(const Work& other) {
    slots += other.slots;
    vector_ops += other.vector_ops;
    scalar_ops += other.scalar_ops;
    mads += other.mads;
    normalizes += other.normalizes;
    return *this;
}

Work operator*(double factor, Work work) {
    work.slots *= factor;
    work.vector_ops *= factor;
    work.scalar_ops *= factor;
    work.mads *= factor;
    work.normalizes *= factor;
    return work;
}

double PathCounts::fetch_count() const {
    double sum = 0.0;
    for (const double fetch : fetches) sum += fetch;
    return sum;
}

double co_issued(const Work& work) {
    return std::max(work.vector_ops, std::ceil((work.vector_ops + work.scalar_ops) / 2.0));
}

ShaderCounts count_shader(const Module& module) { return Counter(module).run(); }

}  // namespace halfframe::cost
