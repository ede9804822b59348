// Prepares, draws and reads back a plan; one file because all of it works on two private structs, the targets and the
// state of GL, that nobody else may see.
#include "engine/frame/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "engine/error.h"

namespace halfframe {

namespace {

constexpr std::uint32_t kContextLost = 0x0507;  // GL_CONTEXT_LOST, ES 3.2 and KHR_robustness
constexpr int kTextureUnits = 8;                // the ES 2.0 minimum: no effect may use more

const char* error_name(std::uint32_t error) {
    switch (error) {
        case GL_NO_ERROR: return "";
        case GL_INVALID_ENUM: return "GL_INVALID_ENUM";
        case GL_INVALID_VALUE: return "GL_INVALID_VALUE";
        case GL_INVALID_OPERATION: return "GL_INVALID_OPERATION";
        case GL_INVALID_FRAMEBUFFER_OPERATION: return "GL_INVALID_FRAMEBUFFER_OPERATION";
        case GL_OUT_OF_MEMORY: return "GL_OUT_OF_MEMORY";
        case kContextLost: return "GL_CONTEXT_LOST";
        default: return "an unknown GL error";
    }
}

/// Everything a pass relies on and never sets: a host that draws between our frames may have left it otherwise. State
/// of ES 3.0 is touched only where the device has it; under an ES 2.0 mask the host has no business with it either.
void set_known_state(gl::EntryPoints& gl, const gl::Caps& caps) {
    for (const GLenum capability :
         {GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_POLYGON_OFFSET_FILL, GL_SAMPLE_ALPHA_TO_COVERAGE, GL_SAMPLE_COVERAGE}) {
        gl.Disable(capability);
    }
    gl.CullFace(GL_BACK);
    gl.FrontFace(GL_CCW);
    gl.BlendEquation(GL_FUNC_ADD);
    gl.DepthRangef(0.0f, 1.0f);
    if (caps.es_version < 30) return;
    gl.Disable(GL_RASTERIZER_DISCARD);
    for (GLuint unit = 0; unit < kTextureUnits; ++unit) gl.BindSampler(unit, 0);
}

/// How pixels travel between us and GL, both ways.
void set_known_transfer_state(gl::EntryPoints& gl, const gl::Caps& caps) {
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
    if (caps.es_version < 30) return;
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    for (const GLenum parameter : {GL_PACK_ROW_LENGTH, GL_PACK_SKIP_PIXELS, GL_PACK_SKIP_ROWS, GL_UNPACK_ROW_LENGTH,
                                   GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_ROWS}) {
        gl.PixelStorei(parameter, 0);
    }
}

void set_capability(gl::EntryPoints& gl, std::uint32_t capability, bool on) {
    on ? gl.Enable(capability) : gl.Disable(capability);
}

}  // namespace

/// The textures and renderbuffers of the plan, and one framebuffer for each pair a pass binds.
struct Renderer::Targets {
    struct Attachments {
        std::optional<int> color;
        std::optional<int> depth;
        gl::Framebuffer framebuffer;
    };
    std::vector<gl::Texture> textures;            ///< by target; empty for depth
    std::vector<gl::Renderbuffer> renderbuffers;  ///< by target; empty for colour
    std::vector<Attachments> framebuffers;
    std::vector<std::uint32_t> framebuffer_of_pass;
    gl::Buffer triangle;
    gl::VertexArray triangle_array;
    gl::VertexArray loose_array;  ///< core desktop profile: something must be bound while buffers are set up

    [[nodiscard]] std::uint32_t framebuffer_of_color(int target) const {
        for (const Attachments& attachments : framebuffers) {
            if (attachments.color == target) return attachments.framebuffer.name();
        }
        return 0;
    }
};

/// GL state as we last set it, so that nothing is set twice.
struct Renderer::State {
    std::uint32_t program = 0;
    std::array<std::uint32_t, kTextureUnits> textures{};
    int active_unit = -1;
    int depth_test = -1, depth_write = -1, cull = -1, blend = -1, color_mask = -1;
    Blend blend_kind = Blend::none;
    std::uint32_t depth_function = 0;
    std::uint32_t array = ~0u;
    std::uint32_t vertex_buffer = ~0u;
    unsigned attributes = 0;  ///< bits of the arrays that are on, where there are no vertex array objects
    bool attributes_known = false;
};

Renderer::Renderer(gl::EntryPoints& gl, const gl::Caps& caps, RendererDescription description)
    : gl_(gl),
      caps_(caps),
      description_(std::move(description)),
      programs_(gl, caps, description_.program_cache_folder),
      targets_(std::make_unique<Targets>()),
      state_(std::make_unique<State>()),
      textures_(std::make_unique<TextureStore>(gl, caps, TextureCompression::none)) {}

Renderer::~Renderer() = default;

namespace {

gl::Texture make_color_target(gl::EntryPoints& gl, const gl::Caps& caps, const Target& target) {
    gl::Texture texture = gl::create<gl::Kind::texture>(gl);
    gl.ActiveTexture(GL_TEXTURE0);
    gl.BindTexture(GL_TEXTURE_2D, texture.name());
    const auto format = gl::transfer_format(target.format, !caps.sized_formats);
    gl.TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format.internal_format), target.width, target.height, 0,
                  format.format, format.type, nullptr);
    const GLint filter = target.filtered ? GL_LINEAR : GL_NEAREST;
    for (const auto& [parameter, value] :
         {std::pair{GL_TEXTURE_MIN_FILTER, filter}, std::pair{GL_TEXTURE_MAG_FILTER, filter},
          std::pair{GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE}, std::pair{GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE}}) {
        gl.TexParameteri(GL_TEXTURE_2D, static_cast<GLenum>(parameter), value);
    }
    gl::label(gl, texture, target.name.c_str());
    return texture;
}

/// A depth texture that shaders compare with: the sampler answers how much of the four texels round it is nearer.
gl::Texture make_compared_target(gl::EntryPoints& gl, const Target& target) {
    gl::Texture texture = gl::create<gl::Kind::texture>(gl);
    gl.ActiveTexture(GL_TEXTURE0);
    gl.BindTexture(GL_TEXTURE_2D, texture.name());
    const auto format = gl::transfer_format(target.format, false);
    gl.TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format.internal_format), target.width, target.height, 0,
                  format.format, format.type, nullptr);
    const GLint filter = target.filtered ? GL_LINEAR : GL_NEAREST;
    for (const auto& [parameter, value] :
         {std::pair{GL_TEXTURE_MIN_FILTER, filter}, std::pair{GL_TEXTURE_MAG_FILTER, filter},
          std::pair{GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE}, std::pair{GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE},
          std::pair{GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE},
          std::pair{GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL}}) {
        gl.TexParameteri(GL_TEXTURE_2D, static_cast<GLenum>(parameter), value);
    }
    gl::label(gl, texture, target.name.c_str());
    return texture;
}

/// What no shader samples: depth, and what is resolved first.
gl::Renderbuffer make_renderbuffer_target(gl::EntryPoints& gl, const Target& target) {
    gl::Renderbuffer renderbuffer = gl::create<gl::Kind::renderbuffer>(gl);
    gl.BindRenderbuffer(GL_RENDERBUFFER, renderbuffer.name());
    const auto format = gl::transfer_format(target.format, false);
    if (target.samples > 1) {
        gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, target.samples, format.internal_format, target.width,
                                          target.height);
    } else {
        gl.RenderbufferStorage(GL_RENDERBUFFER, format.internal_format, target.width, target.height);
    }
    gl::label(gl, renderbuffer, target.name.c_str());
    return renderbuffer;
}

[[noreturn]] void refuse_target(const std::string& names, const FramePlan& plan, const gl::Caps& caps,
                                const std::string& reason) {
    throw Error(
        Fault::context,
        fmt::format(
            "the target {} of {}x{} pixels cannot be allocated on {} ({}); use a smaller --size or another --storage",
            names, plan.width, plan.height, caps.renderer, reason));
}

}  // namespace

void Renderer::prepare(const Scene& scene, const FramePlan& plan) {
    if (const auto broken = broken_rule(plan, caps_))
        throw Mistake("the plan of " + plan.scene + " breaks a rule: " + *broken);
    works_.clear();
    work_of_pass_.clear();
    adoptions_.clear();
    targets_ = std::make_unique<Targets>();
    *state_ = {};
    meshes_.clear();
    notices_.clear();
    textures_ = std::make_unique<TextureStore>(gl_, caps_, plan.textures);
    textures_->fit(scene, notices_);
    texture_bytes_ = 0;
    own_texture_bytes_ = 0;
    scene_ = &scene;
    plan_ = plan;
    while (gl_.GetError() != GL_NO_ERROR) {}  // what came before is not ours
    set_known_transfer_state(gl_, caps_);
    if (caps_.core_profile) {
        targets_->loose_array = gl::create<gl::Kind::vertex_array>(gl_);
        gl_.BindVertexArray(targets_->loose_array.name());
    }
    allocate_targets();
    const auto storages = plan_vertex_storage(scene, plan_.vertices, notices_);
    for (std::size_t i = 0; i < scene.meshes.size(); ++i)
        meshes_.push_back(upload_mesh(gl_, caps_, scene.meshes[i], storages[i]));
    make_works();
    if (const std::uint32_t error = gl_.GetError(); error != GL_NO_ERROR) {
        throw Error(Fault::context,
                    fmt::format("preparing {} left {} on {}; the scene may be too large for this device", plan.scene,
                                error_name(error), caps_.renderer));
    }
    gl_.BindBuffer(GL_ARRAY_BUFFER, 0);
    *state_ = {};
}

void Renderer::allocate_targets() {
    for (const Target& target : plan_.targets) {
        const bool depth = gl::is_depth(target.format);
        const bool in_renderbuffer = (depth || target.samples > 1) && !target.compared;
        if (in_renderbuffer) targets_->textures.emplace_back();
        else
            targets_->textures.push_back(depth ? make_compared_target(gl_, target)
                                               : make_color_target(gl_, caps_, target));
        targets_->renderbuffers.push_back(in_renderbuffer ? make_renderbuffer_target(gl_, target) : gl::Renderbuffer{});
        if (const std::uint32_t error = gl_.GetError(); error != GL_NO_ERROR)
            refuse_target(target.name, plan_, caps_, error_name(error));
    }
    for (const Pass& pass : plan_.passes) {
        auto& all = targets_->framebuffers;
        auto found = std::ranges::find_if(
            all, [&](const auto& made) { return made.color == pass.color && made.depth == pass.depth; });
        if (found == all.end()) {
            all.push_back({pass.color, pass.depth, gl::create<gl::Kind::framebuffer>(gl_)});
            found = all.end() - 1;
            attach(found->framebuffer, pass);
        }
        targets_->framebuffer_of_pass.push_back(found->framebuffer.name());
    }
    constexpr std::array<float, 6> kTriangle = {-1.0f, -1.0f, 3.0f, -1.0f, -1.0f, 3.0f};
    if (caps_.vertex_array_objects || caps_.core_profile) {
        targets_->triangle_array = gl::create<gl::Kind::vertex_array>(gl_);
        gl_.BindVertexArray(targets_->triangle_array.name());
    }
    targets_->triangle = gl::create<gl::Kind::buffer>(gl_);
    gl_.BindBuffer(GL_ARRAY_BUFFER, targets_->triangle.name());
    gl_.BufferData(GL_ARRAY_BUFFER, sizeof(kTriangle), kTriangle.data(), GL_STATIC_DRAW);
    if (targets_->triangle_array) {
        gl_.VertexAttribPointer(kPosition, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
        gl_.EnableVertexAttribArray(kPosition);
        gl_.BindVertexArray(targets_->loose_array.name());
    }
}

void Renderer::attach(const gl::Framebuffer& framebuffer, const Pass& pass) {
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    std::string names;
    if (pass.color) {
        if (const auto& buffer = targets_->renderbuffers[static_cast<std::size_t>(*pass.color)]) {
            gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffer.name());
        } else {
            gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target_texture(*pass.color),
                                     0);
        }
        names = plan_.targets[static_cast<std::size_t>(*pass.color)].name;
    }
    if (pass.depth) {
        if (plan_.targets[static_cast<std::size_t>(*pass.depth)].compared) {
            gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, target_texture(*pass.depth),
                                     0);
        } else {
            gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                        targets_->renderbuffers[static_cast<std::size_t>(*pass.depth)].name());
        }
        names += (names.empty() ? "" : " with ") + plan_.targets[static_cast<std::size_t>(*pass.depth)].name;
    }
    gl::label(gl_, framebuffer, pass.name.c_str());
    if (const std::uint32_t status = gl_.CheckFramebufferStatus(GL_FRAMEBUFFER); status != GL_FRAMEBUFFER_COMPLETE) {
        refuse_target(names, plan_, caps_, fmt::format("framebuffer status 0x{:04X}", status));
    }
}

void Renderer::make_works() {
    for (const Pass& pass : plan_.passes) {
        work_of_pass_.push_back(pass.effect.empty() ? nullptr : work_of(pass.effect));  // nobody clears an empty scene
    }
}

EffectWork* Renderer::work_of(const std::string& effect) {
    const auto known = std::ranges::find(works_, effect, &Work::effect);
    if (known != works_.end()) return known->work.get();
    const auto card = std::ranges::find(description_.effects, std::string_view(effect), &EffectCard::name);
    expect(card != description_.effects.end(),
           [&] { return "the plan has a pass of " + effect + ", which is not in the list"; });
    std::unique_ptr<EffectWork> work;
    if ((*card)->prepare != nullptr) work = (*card)->prepare(*this);
    works_.push_back({effect, std::move(work)});
    return works_.back().work.get();
}

void Renderer::adopt_insertions(const std::string& prefix, gl::Program& program) {
    const auto is_known = [&](const Adoption& adoption) { return adoption.program == program.name(); };
    if (std::ranges::any_of(adoptions_, is_known)) return;
    for (const EffectDecision& decision : plan_.effects) {
        const auto is_here = [&](const gl::Insertion& insertion) {
            return std::string_view(insertion.point).starts_with(prefix);
        };
        if (!std::ranges::any_of(decision.insertions, is_here)) continue;
        EffectWork* work = work_of(decision.effect);
        if (work == nullptr) continue;
        use(program);
        if (const int adopted = work->adopt(*this, program); adopted >= 0)
            adoptions_.push_back({program.name(), work, adopted});
    }
}

void Renderer::draw(const View& view) { draw_passes(view, nullptr); }

void Renderer::draw_timed(const View& view, PassTimer& timer) { draw_passes(view, &timer); }

void Renderer::draw_passes(const View& view, PassTimer* timer) {
    expect(scene_ != nullptr, "draw() before prepare()");
    expect(view.width == plan_.width && view.height == plan_.height, "the view's size is not the plan's");
    *state_ = {};  // the host may have used the context since the last frame
    view_ = &view;
    set_known_state(gl_, caps_);
    if (timer) timer->begin_frame();
    for (std::size_t i = 0; i < plan_.passes.size(); ++i) {
        const Pass& pass = plan_.passes[i];
        // A timed frame leaves nothing out: a budget has to hold in the frame that does all the work.
        if (!timer && work_of_pass_[i] && work_of_pass_[i]->still_holds(*this, view, pass.phase)) continue;
        const gl::PassScope scope(gl_, pass.name.c_str());
        if (timer) timer->begin_pass(static_cast<int>(i));
        begin(pass, targets_->framebuffer_of_pass[i]);
        if (work_of_pass_[i]) work_of_pass_[i]->draw(*this, view, pass.phase);
        if (timer) timer->end_pass(static_cast<int>(i));
    }
    if (timer) timer->end_frame();
    view_ = nullptr;
    finish_frame();
}

void Renderer::begin(const Pass& pass, std::uint32_t framebuffer) {
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    const Target& sized = plan_.targets[static_cast<std::size_t>(pass.color ? *pass.color : *pass.depth)];
    gl_.Viewport(0, 0, sized.width, sized.height);
    // A tiler that knows a target starts empty never loads it from memory.
    std::array<GLenum, 2> discarded{};
    int discard_count = 0;
    if (pass.color && pass.start_color == StartAction::discard)
        discarded[static_cast<std::size_t>(discard_count++)] = GL_COLOR_ATTACHMENT0;
    if (pass.depth && pass.start_depth == StartAction::discard)
        discarded[static_cast<std::size_t>(discard_count++)] = GL_DEPTH_ATTACHMENT;
    if (discard_count > 0 && caps_.discard_framebuffer)
        gl_.InvalidateFramebuffer(GL_FRAMEBUFFER, discard_count, discarded.data());
    GLbitfield clear = 0;
    if (pass.color && pass.start_color == StartAction::clear) {
        set_color_mask(true);
        gl_.ClearColor(pass.clear_color.r, pass.clear_color.g, pass.clear_color.b, pass.clear_color.a);
        clear |= GL_COLOR_BUFFER_BIT;
    }
    if (pass.depth && pass.start_depth == StartAction::clear) {
        set_depth(true, true, GL_LEQUAL);
        gl_.ClearDepthf(1.0f);
        clear |= GL_DEPTH_BUFFER_BIT;
    }
    if (clear != 0) gl_.Clear(clear);
}

void Renderer::finish_frame() {
    if (targets_->loose_array) gl_.BindVertexArray(targets_->loose_array.name());
    const std::uint32_t error = gl_.GetError();
    if (error == kContextLost) {
        throw Error(
            Fault::context,
            fmt::format("the graphics context was lost while drawing {} on {}; make a new context and a new renderer",
                        plan_.scene, caps_.renderer));
    }
    if (error != GL_NO_ERROR && first_error_ == GL_NO_ERROR) first_error_ = error;
}

std::string Renderer::first_gl_error() {
    const std::uint32_t now = gl_.GetError();
    const std::uint32_t error = first_error_ != GL_NO_ERROR ? first_error_ : now;
    first_error_ = GL_NO_ERROR;
    return error_name(error);
}

Picture Renderer::read_display() {
    Picture picture{.width = plan_.width, .height = plan_.height, .rgba = {}};
    if (plan_.census) {  // the display is a float target then
        const FloatPicture floats = read_target(plan_.display);
        picture.rgba.reserve(floats.rgba.size());
        for (const float value : floats.rgba) {
            picture.rgba.push_back(
                static_cast<std::uint8_t>(std::lround((value > 0.0f ? std::min(value, 1.0f) : 0.0f) * 255.0f)));
        }
        return picture;
    }
    const std::size_t row = static_cast<std::size_t>(plan_.width) * 4;
    std::vector<std::uint8_t> bottom_up(row * static_cast<std::size_t>(plan_.height));
    set_known_transfer_state(gl_, caps_);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, targets_->framebuffer_of_color(plan_.display));
    gl_.ReadPixels(0, 0, plan_.width, plan_.height, GL_RGBA, GL_UNSIGNED_BYTE, bottom_up.data());
    picture.rgba.resize(bottom_up.size());
    for (std::size_t y = 0; y < static_cast<std::size_t>(plan_.height); ++y) {
        std::copy_n(
            bottom_up.begin() + static_cast<std::ptrdiff_t>((static_cast<std::size_t>(plan_.height) - 1 - y) * row),
            row, picture.rgba.begin() + static_cast<std::ptrdiff_t>(y * row));
    }
    return picture;
}

FloatPicture Renderer::read_target(int target_index) {
    const Target& target = plan_.targets.at(static_cast<std::size_t>(target_index));
    expect(!gl::is_depth(target.format), "a depth target cannot be read back as floats");
    expect(target.samples == 1, "a multisampled target cannot be read back: read what it is resolved into");
    FloatPicture picture{.width = target.width, .height = target.height, .rgba = {}};
    const std::size_t row = static_cast<std::size_t>(target.width) * 4;
    const std::size_t count = row * static_cast<std::size_t>(target.height);
    std::vector<float> bottom_up(count);
    set_known_transfer_state(gl_, caps_);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, targets_->framebuffer_of_color(target_index));
    const bool normalised = target.format == gl::PixelFormat::rgba8 || target.format == gl::PixelFormat::rgb10_a2;
    if (target.format == gl::PixelFormat::rgba8) {
        std::vector<std::uint8_t> bytes(count);
        gl_.ReadPixels(0, 0, target.width, target.height, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
        std::ranges::transform(bytes, bottom_up.begin(),
                               [](std::uint8_t byte) { return static_cast<float>(byte) / 255.0f; });
    } else if (normalised) {
        std::vector<std::uint32_t> words(count / 4);
        gl_.ReadPixels(0, 0, target.width, target.height, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV, words.data());
        for (std::size_t i = 0; i < words.size(); ++i) {
            for (std::size_t c = 0; c < 3; ++c)
                bottom_up[i * 4 + c] = static_cast<float>((words[i] >> (10 * c)) & 1023u) / 1023.0f;
            bottom_up[i * 4 + 3] = static_cast<float>(words[i] >> 30) / 3.0f;
        }
    } else {
        gl_.ReadPixels(0, 0, target.width, target.height, GL_RGBA, GL_FLOAT, bottom_up.data());
    }
    picture.rgba.resize(count);
    for (std::size_t y = 0; y < static_cast<std::size_t>(target.height); ++y) {
        std::copy_n(
            bottom_up.begin() + static_cast<std::ptrdiff_t>((static_cast<std::size_t>(target.height) - 1 - y) * row),
            row, picture.rgba.begin() + static_cast<std::ptrdiff_t>(y * row));
    }
    return picture;
}

std::vector<CensusRow> Renderer::census() {
    expect(plan_.census, "census() needs a plan made with Wishes::census: an 8-bit target stores NaN as 0");
    std::vector<CensusRow> rows;
    for (std::size_t i = 0; i < plan_.targets.size(); ++i) {
        // A NaN or an inf in one sample is one in the resolved target.
        if (gl::is_depth(plan_.targets[i].format) || plan_.targets[i].samples > 1) continue;
        CensusRow row{.target = plan_.targets[i].name};
        for (const float value : read_target(static_cast<int>(i)).rgba) {
            ++row.values;
            if (std::isnan(value)) ++row.nan;
            else if (std::isinf(value)) ++row.inf;
            else if (value < 0.0f) ++row.negative;
        }
        rows.push_back(row);
    }
    return rows;
}

std::uint32_t Renderer::texture(const Texture& texture, const TextureUse& use) {
    const std::uint32_t texture_name = textures_->get(*scene_, texture, use, notices_);
    texture_bytes_ = textures_->bytes();
    return texture_name;
}

std::uint32_t Renderer::packed_texture(const Texture& normals, const Texture& metallic_roughness) {
    const std::uint32_t texture_name = textures_->get_packed(*scene_, normals, metallic_roughness, notices_);
    texture_bytes_ = textures_->bytes();
    return texture_name;
}

std::vector<std::string> Renderer::notices() const {
    std::vector<std::string> all = notices_;
    if (const std::string sentence = textures_->compression(); !sentence.empty()) all.push_back(sentence);
    all.insert(all.end(), programs_.notices().begin(), programs_.notices().end());
    return all;
}

std::uint32_t Renderer::target_texture(int target_index) const {
    return targets_->textures[static_cast<std::size_t>(target_index)].name();
}

Tier Renderer::tier_of(std::string_view effect) const {
    const EffectDecision* decision = plan_.find(effect);
    expect(decision != nullptr, "tier_of() of an effect the plan does not know");
    return decision->tier;
}

gl::Program& Renderer::program(const EffectCard& card, int variant, std::span<const std::string_view> defines) {
    const Tier tier = tier_of(card.name);
    const auto& shaders = card.tiers[static_cast<std::size_t>(tier)].shaders;
    expect(variant >= 0 && static_cast<std::size_t>(variant) < shaders.size(),
           "a shader variant the card does not have");
    gl::ProgramDescription description = describe_variant(card, shaders[static_cast<std::size_t>(variant)], tier,
                                                          plan_.arithmetic, caps_.fragment_highp, defines);
    const std::string prefix = insertion_prefix(shaders[static_cast<std::size_t>(variant)]);
    for (const EffectDecision& decision : plan_.effects) {
        for (const gl::Insertion& insertion : decision.insertions) {
            if (std::string_view(insertion.point).starts_with(prefix)) description.insertions.push_back(insertion);
        }
    }
    gl::Program& made = programs_.get(description);
    adopt_insertions(prefix, made);
    return made;
}

void Renderer::use(const gl::Program& program) {
    if (state_->program == program.name()) return;
    state_->program = program.name();
    gl_.UseProgram(program.name());
    if (view_ == nullptr) return;  // preparing
    for (const Adoption& adoption : adoptions_) {
        if (adoption.program == program.name()) adoption.work->feed(*this, *view_, adoption.adopted);
    }
}

void Renderer::bind_texture(int unit, std::uint32_t texture) { bind(GL_TEXTURE_2D, unit, texture); }

void Renderer::bind_cube(int unit, std::uint32_t texture) { bind(GL_TEXTURE_CUBE_MAP, unit, texture); }

void Renderer::bind(std::uint32_t target, int unit, std::uint32_t texture) {
    std::uint32_t& bound = state_->textures[static_cast<std::size_t>(unit)];
    if (bound == texture && texture != 0) return;
    bound = texture;
    if (state_->active_unit != unit) gl_.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    state_->active_unit = unit;
    gl_.BindTexture(target, texture);
}

void Renderer::resolve(int from_target, int to_target) {
    const Target& to = plan_.targets[static_cast<std::size_t>(to_target)];
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, targets_->framebuffer_of_color(from_target));
    gl_.BlitFramebuffer(0, 0, to.width, to.height, 0, 0, to.width, to.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void Renderer::draw_full_screen() {
    if (targets_->triangle_array) {
        if (state_->array != targets_->triangle_array.name()) gl_.BindVertexArray(targets_->triangle_array.name());
        state_->array = targets_->triangle_array.name();
    } else {
        state_->vertex_buffer = targets_->triangle.name();
        gl_.BindBuffer(GL_ARRAY_BUFFER, state_->vertex_buffer);
        gl_.VertexAttribPointer(kPosition, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
        enable_attributes(1u << kPosition);
    }
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

// An array left on from another mesh would be read past the end of its buffer.
void Renderer::enable_attributes(unsigned wanted) {
    for (int attribute = 0; attribute < kVertexAttributes; ++attribute) {
        const unsigned bit = 1u << attribute;
        if ((state_->attributes & bit) == (wanted & bit) && state_->attributes_known) continue;
        if ((wanted & bit) != 0) gl_.EnableVertexAttribArray(static_cast<GLuint>(attribute));
        else gl_.DisableVertexAttribArray(static_cast<GLuint>(attribute));
    }
    state_->attributes = wanted;
    state_->attributes_known = true;
}

void Renderer::draw_mesh(const DrawMesh& mesh) {
    for (const DrawPart& part : mesh.parts) {
        if (part.array) {
            if (state_->array != part.array.name()) gl_.BindVertexArray(part.array.name());
            state_->array = part.array.name();
        } else if (state_->vertex_buffer != part.vertices.name()) {
            state_->vertex_buffer = part.vertices.name();
            gl_.BindBuffer(GL_ARRAY_BUFFER, part.vertices.name());
            set_vertex_layout(gl_, mesh.layout);
            unsigned wanted = 0;
            for (int i = 0; i < mesh.layout.count; ++i)
                wanted |= 1u << mesh.layout.streams[static_cast<std::size_t>(i)].attribute;
            enable_attributes(wanted);
            if (part.indices) gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, part.indices.name());
        }
        if (part.indices) {
            gl_.DrawElements(mesh.mode, part.count, part.index_type, nullptr);
        } else {
            gl_.DrawArrays(mesh.mode, 0, part.count);
        }
    }
}

void Renderer::set_depth(bool test, bool write, std::uint32_t function) {
    if (state_->depth_test != int{test}) set_capability(gl_, GL_DEPTH_TEST, test);
    if (state_->depth_write != int{write}) gl_.DepthMask(write ? GL_TRUE : GL_FALSE);
    if (state_->depth_function != function) gl_.DepthFunc(function);
    state_->depth_test = test;
    state_->depth_write = write;
    state_->depth_function = function;
}

void Renderer::set_cull(bool on) {
    if (state_->cull != int{on}) set_capability(gl_, GL_CULL_FACE, on);
    state_->cull = on;
}

void Renderer::set_blend(Blend blend) {
    const bool on = blend != Blend::none;
    if (state_->blend != int{on}) set_capability(gl_, GL_BLEND, on);
    state_->blend = on;
    if (!on || state_->blend_kind == blend) return;
    state_->blend_kind = blend;
    switch (blend) {
        case Blend::none: break;
        case Blend::alpha:
            gl_.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
            break;
        case Blend::add: gl_.BlendFuncSeparate(GL_ONE, GL_ONE, GL_ONE, GL_ONE); break;
        case Blend::screen: gl_.BlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_COLOR, GL_ZERO, GL_ONE); break;
        case Blend::multiply: gl_.BlendFuncSeparate(GL_DST_COLOR, GL_ZERO, GL_ZERO, GL_ONE); break;
    }
}

void Renderer::set_color_mask(bool on) {
    const GLboolean mask = on ? GL_TRUE : GL_FALSE;
    if (state_->color_mask != int{on}) gl_.ColorMask(mask, mask, mask, mask);
    state_->color_mask = on;
}

}  // namespace halfframe
