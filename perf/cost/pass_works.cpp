// Joins the draws of a frame with the counts of their shaders.
#include <algorithm>
#include <set>

#include "engine/error.h"
#include "perf/cost/counted_frame.h"
#include "perf/shader_ir/compile.h"

namespace halfframe::cost {
namespace {

struct InternalFormat {
    TexelFormat format = TexelFormat::narrow;
    double bytes = 4.0;
};

InternalFormat internal_format(std::uint32_t name) {
    switch (name) {
        case GL_RGBA32F: return {TexelFormat::full_float, 16.0};
        case GL_RGB32F: return {TexelFormat::full_float, 12.0};
        case GL_RGBA16F: return {TexelFormat::half_float, 8.0};
        case GL_RGB16F: return {TexelFormat::half_float, 6.0};
        case GL_R11F_G11F_B10F: return {TexelFormat::small_float, 4.0};
        case GL_RGB10_A2: return {TexelFormat::packed, 4.0};
        case GL_R8: return {TexelFormat::narrow, 1.0};
        case GL_RG8:
        case GL_R16F:
        case GL_DEPTH_COMPONENT16: return {TexelFormat::narrow, 2.0};
        default: return {};
    }
}

/// Where in the frame a pass stands: what it finds, and what is left of it.
class Residence {
public:
    explicit Residence(const FramePlan& plan) : plan_(plan) {}

    [[nodiscard]] bool stays_from(std::size_t before, std::size_t pass) const {
        return plan_.passes[before].color == plan_.passes[pass].color &&
               plan_.passes[before].depth == plan_.passes[pass].depth;
    }
    [[nodiscard]] bool enters(std::size_t pass) const { return pass == 0 || !stays_from(pass - 1, pass); }
    [[nodiscard]] bool leaves(std::size_t pass) const {
        return pass + 1 == plan_.passes.size() || !stays_from(pass, pass + 1);
    }

    [[nodiscard]] bool written_before(std::size_t pass, int target) const {
        return std::any_of(plan_.passes.begin(), plan_.passes.begin() + static_cast<std::ptrdiff_t>(pass),
                           [&](const Pass& one) { return one.color == target || one.depth == target; });
    }

    [[nodiscard]] bool needed_after(std::size_t pass, int target) const {
        if (target == plan_.display) return true;
        for (std::size_t i = pass + 1; i < plan_.passes.size(); ++i) {
            const Pass& one = plan_.passes[i];
            if (std::ranges::find(one.reads, target) != one.reads.end() || one.resolves == target) return true;
            if (one.color == target) return one.start_color == StartAction::keep;
            if (one.depth == target) return one.start_depth == StartAction::keep;
        }
        return false;
    }

    [[nodiscard]] TargetWork work(std::size_t pass, int target, StartAction start) const {
        const Target& made = plan_.targets[static_cast<std::size_t>(target)];
        const bool stored = leaves(pass) && needed_after(pass, target);
        return {.width = made.width,
                .height = made.height,
                .samples = made.samples,
                .format = made.format,
                .loaded = start == StartAction::keep && enters(pass) && written_before(pass, target),
                .stored = stored,
                .resolved = stored};
    }

private:
    const FramePlan& plan_;
};

class Joining {
public:
    Joining(const CountedFrame& frame, ShaderLibrary& library, gl::Arithmetic arithmetic, std::string without)
        : frame_(frame), library_(library), arithmetic_(arithmetic), without_(std::move(without)) {}

    std::vector<PassWork> run() {
        const Residence residence(frame_.plan);
        std::vector<PassWork> works;
        for (std::size_t i = 0; i < frame_.plan.passes.size(); ++i) {
            const Pass& pass = frame_.plan.passes[i];
            PassWork work{.name = pass.name, .switches_target = residence.enters(i)};
            if (pass.color) work.color = residence.work(i, *pass.color, pass.start_color);
            if (pass.depth) work.depth = residence.work(i, *pass.depth, pass.start_depth);
            texture_bytes_.clear();
            std::set<std::uint32_t> programs;
            for (const RecordedDraw& draw : frame_.draws) {
                if (draw.pass != pass.name) continue;
                work.draws.push_back(draw_work(draw, pass, work));
                if (draw.program == 0) ++work.copies;
                else programs.insert(draw.program);
            }
            work.programs = static_cast<int>(programs.size());
            if (pass.resolves) {
                const Target& source = frame_.plan.targets[static_cast<std::size_t>(*pass.resolves)];
                work.texture_bytes += static_cast<double>(source.bytes());
            }
            for (const auto& [texture, bytes] : texture_bytes_)
                work.texture_bytes += std::min(bytes.fetched, bytes.whole);
            works.push_back(std::move(work));
        }
        return works;
    }

private:
    struct Bytes {
        double fetched = 0.0;
        double whole = 0.0;
    };

    DrawWork draw_work(const RecordedDraw& draw, const Pass& pass, const PassWork& around) {
        const double samples = around.color ? around.color->samples : around.depth ? around.depth->samples : 1;
        DrawWork work{.fragments_shaded = static_cast<double>(draw.samples_shaded) / samples,
                      .fragments_written = static_cast<double>(draw.samples_written),
                      .vertices = static_cast<double>(draw.transformed),
                      .triangles = static_cast<double>(draw.triangles),
                      .blends = draw.blends,
                      .additive = draw.additive,
                      .writes_color = draw.writes_color && around.color.has_value(),
                      .writes_depth = draw.writes_depth && around.depth.has_value(),
                      .tests_depth = draw.tests_depth && around.depth.has_value()};
        if (draw.program == 0) return work;  // a copy: nothing is shaded
        // What covers the screen is known without drawing it.
        if (pass.full_screen && around.color && !around.depth)
            work.fragments_shaded = work.fragments_written = around.color->pixels();
        const auto [vertex_counts, fragment_counts] = stages_of(draw.program);
        work.vertex = vertex_counts->weighted.work;
        work.attributes = vertex_counts->attributes;
        const ShaderCounts& fragment = *fragment_counts;
        work.temporaries = fragment.temporaries;
        const std::array paths{&fragment.weighted, &fragment.shortest, &fragment.longest};
        for (std::size_t way = 0; way < paths.size(); ++way)
            work.fragment[way] = fragment_work(*paths[way], fragment, draw);
        if (work.writes_color || fragment.discards) count_bytes(fragment, draw, work);
        else work.fragment.fill({});  // depth alone: no fragment is shaded
        return work;
    }

    struct StageCounts {
        const ShaderCounts* vertex = nullptr;
        const ShaderCounts* fragment = nullptr;
    };

    /// Of each program once: hundreds of draws share a few dozen.
    StageCounts stages_of(std::uint32_t name) {
        const auto [known, added] = stages_.try_emplace(name);
        if (!added) return known->second;
        const auto program = frame_.programs.find(name);
        expect(program != frame_.programs.end(), "a draw with a program that the renderer does not know");
        const gl::ProgramDescription description =
            without_.empty() ? program->second : without_insertions(program->second, frame_.plan, without_);
        known->second = {&library_.stage(description, gl::Stage::vertex, arithmetic_).counts,
                         &library_.stage(description, gl::Stage::fragment, arithmetic_).counts};
        return known->second;
    }

    static const RecordedTexture* bound(const RecordedDraw& draw, const std::string& sampler) {
        const auto found = std::ranges::find(draw.textures, sampler, &RecordedTexture::sampler);
        return found != draw.textures.end() ? &*found : nullptr;
    }

    FragmentWork fragment_work(const PathCounts& path, const ShaderCounts& counts, const RecordedDraw& draw) const {
        FragmentWork work{.work = path.work};
        for (std::size_t i = 0; i < counts.samplers.size(); ++i) {
            const RecordedTexture* texture = bound(draw, counts.samplers[i].name);
            FetchWork fetch{.count = path.fetches[i], .shape = counts.samplers[i].shape};
            if (texture != nullptr) {
                fetch.format = internal_format(texture->internal_format).format;
                fetch.target =
                    std::ranges::find(frame_.target_textures, texture->texture) != frame_.target_textures.end();
                fetch.trilinear = texture->trilinear;
            }
            work.fetches.push_back(fetch);
        }
        return work;
    }

    /// A texture is read at most once as a whole, and at most once a fetch.
    void count_bytes(const ShaderCounts& counts, const RecordedDraw& draw, const DrawWork& work) {
        for (std::size_t i = 0; i < counts.samplers.size(); ++i) {
            const RecordedTexture* texture = bound(draw, counts.samplers[i].name);
            if (texture == nullptr) continue;
            const double texel = internal_format(texture->internal_format).bytes;
            Bytes& bytes = texture_bytes_[texture->texture];
            bytes.whole = texture->texels * texel;
            bytes.fetched += work.fragments_shaded * counts.weighted.fetches[i] * texel;
        }
    }

    const CountedFrame& frame_;
    ShaderLibrary& library_;
    gl::Arithmetic arithmetic_;
    std::string without_;
    std::map<std::uint32_t, Bytes> texture_bytes_;
    std::map<std::uint32_t, StageCounts> stages_;  ///< by program
};

bool same(const gl::Insertion& one, const gl::Insertion& other) {
    const auto text = [](const char* words) { return std::string(words != nullptr ? words : ""); };
    return text(one.point) == text(other.point) && text(one.file) == text(other.file) &&
           text(one.code) == text(other.code);
}

}  // namespace

gl::ProgramDescription without_insertions(const gl::ProgramDescription& description, const FramePlan& plan,
                                          const std::string& effect) {
    gl::ProgramDescription rest = description;
    if (const EffectDecision* decision = plan.find(effect)) {
        std::erase_if(rest.insertions, [&](const gl::Insertion& insertion) {
            return std::ranges::any_of(decision->insertions,
                                       [&](const gl::Insertion& own) { return same(insertion, own); });
        });
    }
    return rest;
}

const CountedStage& ShaderLibrary::stage(gl::ProgramDescription description, gl::Stage stage,
                                         gl::Arithmetic arithmetic) {
    description.arithmetic = arithmetic;
    if (arithmetic == gl::Arithmetic::full) description.fragment_highp = true;
    const bool low = description.dialect == gl::Dialect::es100;
    description.dialect = gl::Dialect::es300;  // ES 1.00 is counted as its twin
    const gl::StageText text = gl::assemble_stage(description, stage);
    std::unique_ptr<CountedStage>& counted = by_text_[(low ? "1" : "3") + text.text];
    if (!counted) {
        counted = std::make_unique<CountedStage>();
        counted->module = shader_ir::compile_kept(text, stage, cache_);
        counted->module.up_converted = low;
        counted->counts = count_shader(counted->module);
    }
    return *counted;
}

void WorkSum::add(const PassWork& pass) {
    draws += static_cast<double>(pass.draws.size()) - pass.copies;
    target_switches += pass.switches_target ? 1.0 : 0.0;
    resolves += pass.resolves();
    for (const DrawWork& draw : pass.draws) {
        vertices += draw.vertices;
        triangles += draw.triangles;
        fragments_shaded += draw.fragments_shaded;
        samples_written += draw.fragments_written;
        if (draw.temporaries.weighted() > most.weighted()) most = draw.temporaries;
    }
}

std::vector<PassWork> pass_works(const CountedFrame& frame, ShaderLibrary& library, gl::Arithmetic arithmetic,
                                 const std::string& without) {
    return Joining(frame, library, arithmetic, without).run();
}

}  // namespace halfframe::cost
