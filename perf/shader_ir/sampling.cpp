// Texture instructions: what the shader asks for goes to a function of the caller.
#include "engine/error.h"
#include "perf/shader_ir/machine.h"

namespace halfframe::shader_ir {
namespace {

/// Which of SPIR-V's sixteen ways to sample an instruction is.
struct SampleKind {
    bool known = false;
    bool projective = false;  ///< the coordinate behind the last divides
    bool compares = false;    ///< a reference value follows the coordinates
    bool fetches = false;
};

SampleKind kind_of(spv::Op op) {
    switch (op) {
        case spv::OpImageSampleImplicitLod:
        case spv::OpImageSampleExplicitLod: return {true, false, false, false};
        case spv::OpImageSampleDrefImplicitLod:
        case spv::OpImageSampleDrefExplicitLod: return {true, false, true, false};
        case spv::OpImageSampleProjImplicitLod:
        case spv::OpImageSampleProjExplicitLod: return {true, true, false, false};
        case spv::OpImageSampleProjDrefImplicitLod:
        case spv::OpImageSampleProjDrefExplicitLod: return {true, true, true, false};
        case spv::OpImageFetch: return {true, false, false, true};
        default: return {};
    }
}

}  // namespace

bool Machine::run_sampling(const Instruction& one) {
    if (kind_of(one.op).known) {
        sample(one);
        return true;
    }
    switch (one.op) {
        case spv::OpImage: copy_scalars(one, 0, one.operands[0], 0, 1); return true;
        case spv::OpImageQuerySizeLod: query_size(one); return true;
        default: return false;
    }
}

void Machine::sample(const Instruction& one) {
    const SampleKind kind = kind_of(one.op);
    const auto& words = one.operands;
    const Type& image = type_of(words[0]);
    const std::size_t coordinates = image.coordinates;
    const std::size_t given = scalars_of(words[1]);
    const std::size_t fixed = kind.compares ? 3 : 2;
    const std::uint32_t mask = words.size() > fixed ? words[fixed] : 0;
    const std::size_t results = module_.type(one.type).scalars;
    for (const Lane lane : active_) {
        const double handle = in(words[0], 0)[lane];
        if (handle < 0.0) fail(one, "a texture is read, but the bindings give its sampler no function");
        SampleRequest request;
        request.texel_fetch = kind.fetches;
        const double divisor = kind.projective ? in(words[1], given - 1)[lane] : 1.0;
        for (std::size_t c = 0; c < coordinates; ++c) request.at[c] = in(words[1], c)[lane] / divisor;
        if (kind.compares) request.reference = in(words[2], 0)[lane] / divisor;
        std::size_t next = fixed + 1;
        if ((mask & spv::ImageOperandsBiasMask) != 0) request.bias = in(words.at(next++), 0)[lane];
        if ((mask & spv::ImageOperandsLodMask) != 0) request.lod = in(words.at(next++), 0)[lane];
        if ((mask & spv::ImageOperandsGradMask) != 0) {
            std::array<double, 6> gradient{};
            for (std::size_t c = 0; c < image.directions; ++c) {
                gradient[c] = in(words.at(next), c)[lane];
                gradient[c + 3] = in(words.at(next + 1), c)[lane];
            }
            request.gradient = gradient;
            next += 2;
        }
        if ((mask & (spv::ImageOperandsConstOffsetMask | spv::ImageOperandsOffsetMask)) != 0) {
            for (std::size_t c = 0; c < scalars_of(words.at(next)); ++c)
                request.offset[c] = to_int(in(words[next], c)[lane]);
        }
        const std::array<double, 4> texel = samplers_[static_cast<std::size_t>(handle)]->sample(request);
        for (std::size_t s = 0; s < results; ++s) {
            const bool is_float = module_.type(one.type).float_leaf[s];
            out(one, s)[lane] = rounded(is_float ? format(one) : Model::in_double, texel[s]);
        }
    }
}

void Machine::query_size(const Instruction& one) {
    for (const Lane lane : active_) {
        const double handle = in(one.operands[0], 0)[lane];
        const Sampler* sampler = handle >= 0.0 ? samplers_[static_cast<std::size_t>(handle)] : nullptr;
        if (sampler == nullptr || !sampler->size) fail(one, "textureSize, but the bindings give the sampler no size");
        const std::array<int, 3> size = sampler->size(to_int(in(one.operands[1], 0)[lane]));
        for (std::size_t s = 0; s < module_.type(one.type).scalars; ++s) out(one, s)[lane] = size[s];
    }
}

}  // namespace halfframe::shader_ir
