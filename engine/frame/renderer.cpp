// Prepares a plan, draws it and reads it back.
#include "engine/frame/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "engine/error.h"
#include "engine/frame/render_targets.h"
#include "shaders_es/common/mesh_vertex_limits.h"

namespace halfframe {

namespace {

/// One triangle that covers the target: no diagonal is shaded twice.
constexpr std::array<float, 6> kFullScreenTriangle = {-1.0f, -1.0f, 3.0f, -1.0f, -1.0f, 3.0f};

/// Does an insertion go into the shaders whose points begin with `prefix`, made with `defines`?
bool belongs(const gl::Insertion& insertion, const std::string& prefix, const std::vector<gl::Define>& defines) {
    return std::string_view(insertion.point).starts_with(prefix) &&
           (insertion.only_with == nullptr ||
            std::ranges::any_of(defines, [&](const gl::Define& one) { return one.first == insertion.only_with; }));
}

}  // namespace

Renderer::Renderer(gl::EntryPoints& gl, const gl::Caps& caps, RendererDescription description)
    : gl_(gl),
      caps_(caps),
      description_(std::move(description)),
      programs_(gl, caps, description_.program_cache_folder),
      state_(gl),
      textures_(std::make_unique<TextureStore>(gl, caps, TextureCompression::none)) {}

Renderer::~Renderer() = default;

void Renderer::prepare(const Scene& scene, const FramePlan& plan) {
    if (const auto broken = broken_rule(plan, caps_))
        throw Mistake("the plan of " + plan.scene + " breaks a rule: " + *broken);
    works_.clear();
    work_of_pass_.clear();
    adoptions_.clear();
    uses_.clear();
    asked_programs_.clear();
    targets_ = std::make_unique<RenderTargets>(gl_, caps_);
    state_.forget();
    moving_.reset();
    meshes_.clear();
    notices_.clear();
    textures_ = std::make_unique<TextureStore>(gl_, caps_, plan.textures);
    textures_->fit(scene, notices_);
    texture_bytes_ = 0;
    own_texture_bytes_ = 0;
    scene_ = &scene;
    plan_ = plan;
    change_materials();
    textures_->add_images(changes_.images, changes_.instead_of);
    while (gl_.GetError() != GL_NO_ERROR) {}  // what came before is not ours
    set_known_transfer_state(gl_, caps_);
    if (caps_.core_profile) {
        loose_array_ = gl::create<gl::Kind::vertex_array>(gl_);
        gl_.BindVertexArray(loose_array_.name());
    }
    targets_->allocate(plan_);
    make_full_screen_triangle();
    const auto storages = plan_vertex_storage(scene, plan_.vertices, notices_);
    const std::vector<bool> orders = meshes_to_order(scene);
    for (std::size_t i = 0; i < scene.meshes.size(); ++i)
        meshes_.push_back(upload_mesh(gl_, caps_, scene.meshes[i], storages[i], orders[i]));
    // Surfaces choose the dialect: every effect that draws them has their tier, or one of the same language.
    const bool low = plan_.tier == Tier::low || std::ranges::any_of(plan_.effects, [](const EffectDecision& decision) {
                         return decision.in && decision.tier == Tier::low;
                     });
    moving_ = std::make_unique<MovingMeshes>(gl_, caps_, scene, meshes_, low, description_.skinning);
    if (moving_->empty()) moving_.reset();
    else if (const std::string sentence = moving_->notice(); !sentence.empty()) notices_.push_back(sentence);
    make_works();
    textures_->add_images({}, {});  // all of them are on the device
    changes_.images.clear();
    changes_.images.shrink_to_fit();
    if (const std::uint32_t error = gl_.GetError(); error != GL_NO_ERROR) {
        throw Error(Fault::context,
                    fmt::format("preparing {} left {} on {}; the scene may be too large for this device", plan.scene,
                                gl::error_name(error), caps_.renderer));
    }
    gl_.BindBuffer(GL_ARRAY_BUFFER, 0);
    state_.forget();
}

void Renderer::make_full_screen_triangle() {
    if (caps_.vertex_array_objects || caps_.core_profile) {
        triangle_array_ = gl::create<gl::Kind::vertex_array>(gl_);
        gl_.BindVertexArray(triangle_array_.name());
    }
    triangle_ = gl::create<gl::Kind::buffer>(gl_);
    gl_.BindBuffer(GL_ARRAY_BUFFER, triangle_.name());
    gl_.BufferData(GL_ARRAY_BUFFER, sizeof(kFullScreenTriangle), kFullScreenTriangle.data(), GL_STATIC_DRAW);
    if (!triangle_array_) return;
    gl_.VertexAttribPointer(kPosition, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
    gl_.EnableVertexAttribArray(kPosition);
    gl_.BindVertexArray(loose_array_.name());
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
            return belongs(insertion, prefix, program.description().defines);
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
    state_.begin_frame(caps_);  // the host may have used the context since the last frame
    view_ = &view;
    update_moving_meshes();
    if (timer) timer->begin_frame();
    for (std::size_t i = 0; i < plan_.passes.size(); ++i) {
        const Pass& pass = plan_.passes[i];
        // A timed frame leaves nothing out: a budget has to hold in the frame that does all the work.
        if (!timer && work_of_pass_[i] && work_of_pass_[i]->still_holds(*this, view, pass.phase)) continue;
        const gl::PassScope scope(gl_, pass.name.c_str());
        if (timer) timer->begin_pass(static_cast<int>(i));
        begin(pass, targets_->framebuffer_of_pass(i));
        if (work_of_pass_[i]) work_of_pass_[i]->draw(*this, view, pass.phase);
        if (timer) timer->end_pass(static_cast<int>(i));
    }
    if (timer) timer->end_frame();
    view_ = nullptr;
    finish_frame();
}

void Renderer::update_moving_meshes() {
    if (!moving_) return;
    if (moving_->writes_textures()) {
        set_known_transfer_state(gl_, caps_);
        gl_.BindSampler(kJointUnit, 0);
    }
    moving_->update(*scene_);
}

void Renderer::begin(const Pass& pass, std::uint32_t framebuffer) {
    unflushed_triangles_ = 0;
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
    if (loose_array_) gl_.BindVertexArray(loose_array_.name());
    const std::uint32_t error = gl_.GetError();
    if (error == gl::kContextLost) {
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
    return gl::error_name(error);
}

Picture Renderer::read_display() {
    if (plan_.census) {  // the display is a float target then
        const FloatPicture floats = read_target(plan_.display);
        Picture picture{.width = floats.width, .height = floats.height, .rgba = {}};
        picture.rgba.reserve(floats.rgba.size());
        for (const float value : floats.rgba) {
            picture.rgba.push_back(
                static_cast<std::uint8_t>(std::lround((value > 0.0f ? std::min(value, 1.0f) : 0.0f) * 255.0f)));
        }
        return picture;
    }
    return targets_->read_bytes(plan_.display);
}

FloatPicture Renderer::read_target(int target_index) { return targets_->read_floats(target_index); }

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

std::uint32_t Renderer::packed_texture(const Texture& first, const Texture& second, const TextureUse& use) {
    const std::uint32_t texture_name = textures_->get_packed(*scene_, first, second, use, notices_);
    texture_bytes_ = textures_->bytes();
    return texture_name;
}

std::optional<glm::vec3> Renderer::mask_of(const Texture& emission) { return textures_->mask_of(*scene_, emission); }

std::vector<std::string> Renderer::notices() const {
    std::vector<std::string> all = notices_;
    if (const std::string sentence = textures_->compression(); !sentence.empty()) all.push_back(sentence);
    all.insert(all.end(), programs_.notices().begin(), programs_.notices().end());
    return all;
}

std::uint32_t Renderer::target_texture(int target_index) const { return targets_->texture(target_index); }

Tier Renderer::tier_of(std::string_view effect) const {
    const EffectDecision* decision = plan_.find(effect);
    expect(decision != nullptr, "tier_of() of an effect the plan does not know");
    return decision->tier;
}

// Kept by what it was asked with, because to ask the cache is to put the whole text together, and effects ask for every
// surface.
gl::Program& Renderer::program(const EffectCard& card, int variant, std::span<const std::string_view> defines) {
    const auto known = std::ranges::find_if(asked_programs_, [&](const AskedProgram& asked) {
        return asked.card == &card && asked.variant == variant && std::ranges::equal(asked.defines, defines);
    });
    if (known != asked_programs_.end()) return *known->program;
    gl::Program& made = make_program(card, variant, defines);
    asked_programs_.push_back({&card, variant, {defines.begin(), defines.end()}, &made});
    return made;
}

gl::Program& Renderer::make_program(const EffectCard& card, int variant, std::span<const std::string_view> defines) {
    const Tier tier = tier_of(card.name);
    const auto& shaders = card.tiers[static_cast<std::size_t>(tier)].shaders;
    expect(variant >= 0 && static_cast<std::size_t>(variant) < shaders.size(),
           "a shader variant the card does not have");
    gl::ProgramDescription description = describe_variant(card, shaders[static_cast<std::size_t>(variant)], tier,
                                                          plan_.arithmetic, caps_.fragment_highp, defines);
    const std::string prefix = insertion_prefix(shaders[static_cast<std::size_t>(variant)]);
    for (const EffectDecision& decision : plan_.effects) {
        for (const gl::Insertion& insertion : decision.insertions) {
            if (belongs(insertion, prefix, description.defines)) description.insertions.push_back(insertion);
        }
    }
    gl::Program& made = programs_.get(description);
    note_program(card.name, prefix, made);
    adopt_insertions(prefix, made);
    return made;
}

void Renderer::note_program(std::string_view effect, const std::string& prefix, const gl::Program& program) {
    if (std::ranges::find(uses_, program.name(), &NotedUse::program) != uses_.end()) return;
    ProgramUse use{.effect = std::string(effect), .defines = {}, .insertions = {}, .users = {}};
    const auto add = [](std::string& words, std::string_view word) {
        words += words.empty() ? "" : " ";
        words += word;
    };
    const auto& defines = program.description().defines;
    for (const auto& [word, value] : defines) {
        if (!word.starts_with("TIER_")) add(use.defines, word);
    }
    for (const EffectDecision& decision : plan_.effects) {
        const auto is_here = [&](const gl::Insertion& insertion) { return belongs(insertion, prefix, defines); };
        if (std::ranges::any_of(decision.insertions, is_here)) add(use.insertions, decision.effect);
    }
    uses_.push_back({program.name(), std::move(use), {}});
}

void Renderer::note_use(const gl::Program& program, const std::string& material_name) {
    const auto noted = std::ranges::find(uses_, program.name(), &NotedUse::program);
    if (noted == uses_.end()) return;
    ++noted->use.draws;
    if (noted->users.insert(material_name).second) noted->use.users.push_back(material_name);
}

std::vector<ProgramUse> Renderer::program_uses() const {
    std::vector<ProgramUse> uses;
    for (const NotedUse& noted : uses_) uses.push_back(noted.use);
    return uses;
}

void Renderer::feed_material(const gl::Program& program, int material) {
    for (const Adoption& adoption : adoptions_) {
        if (adoption.program == program.name()) adoption.work->feed_material(*this, adoption.adopted, material);
    }
}

void Renderer::add_defines(int surface, std::vector<std::string_view>& defines) const {
    for (const EffectDecision& decision : plan_.effects) {
        if (decision.insertions.empty()) continue;
        const auto card = std::ranges::find(description_.effects, std::string_view(decision.effect), &EffectCard::name);
        if (card != description_.effects.end() && (*card)->add_defines != nullptr)
            (*card)->add_defines(*this, surface, defines);
    }
}

const Material& Renderer::material(int index) const {
    const auto at = static_cast<std::size_t>(index);
    return changes_.materials.empty() ? scene_->materials[at] : changes_.materials[at];
}

void Renderer::change_materials() {
    changes_ = {};
    for (const EffectDecision& decision : plan_.effects) {
        const auto card = std::ranges::find(description_.effects, std::string_view(decision.effect), &EffectCard::name);
        if (!decision.in || card == description_.effects.end() || (*card)->change_materials == nullptr) continue;
        if (changes_.materials.empty()) changes_.materials = scene_->materials;
        (*card)->change_materials(*scene_, plan_, changes_);
    }
}

void Renderer::use(const gl::Program& program) {
    if (!state_.use(program.name()) || view_ == nullptr) return;  // no view: preparing
    for (const Adoption& adoption : adoptions_) {
        if (adoption.program == program.name()) adoption.work->feed(*this, *view_, adoption.adopted);
    }
}

void Renderer::bind_texture(int unit, std::uint32_t texture) { state_.bind_texture(GL_TEXTURE_2D, unit, texture); }

void Renderer::bind_cube(int unit, std::uint32_t texture) { state_.bind_texture(GL_TEXTURE_CUBE_MAP, unit, texture); }

void Renderer::resolve(int from_target, int to_target) {
    const Target& to = plan_.targets[static_cast<std::size_t>(to_target)];
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, targets_->framebuffer_of_color(from_target));
    gl_.BlitFramebuffer(0, 0, to.width, to.height, 0, 0, to.width, to.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void Renderer::draw_full_screen() {
    if (triangle_array_) {
        state_.bind_array(triangle_array_.name());
    } else {
        if (state_.bind_vertices(triangle_.name()))
            gl_.VertexAttribPointer(kPosition, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
        state_.enable_attributes(1u << kPosition);
    }
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

void Renderer::draw_mesh(const DrawMesh& mesh, const glm::mat4* clip_from_stored) {
    for (const DrawPart& part : mesh.parts) {
        if (part.array) {
            state_.bind_array(part.array.name());
        } else if (state_.bind_vertices(part.vertices.name())) {
            set_vertex_layout(gl_, mesh.layout);
            unsigned wanted = 0;
            for (int i = 0; i < mesh.layout.count; ++i)
                wanted |= 1u << mesh.layout.streams[static_cast<std::size_t>(i)].attribute;
            state_.enable_attributes(wanted);
            if (part.indices) gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, part.indices.name());
        }
        if (clip_from_stored != nullptr && !part.facing.groups.empty() && state_.culls())
            draw_fronts(mesh, part, *clip_from_stored);
        else draw_part(mesh, part);
    }
}

void Renderer::draw_fronts(const DrawMesh& mesh, const DrawPart& part, const glm::mat4& clip_from_stored) {
    const std::size_t index_bytes = part.index_type == GL_UNSIGNED_SHORT ? 2 : 4;
    std::array<TriangleRange, kMostRanges> ranges;
    const std::size_t count = visible_ranges(part.facing, clip_from_stored, ranges);
    for (const TriangleRange& range : std::span(ranges).first(count)) {
        unflushed_triangles_ += range.count;
        gl_.DrawElements(mesh.mode, static_cast<GLsizei>(3 * range.count), part.index_type,
                         reinterpret_cast<const void*>(3 * range.first * index_bytes));
    }
}

void Renderer::draw_part(const DrawMesh& mesh, const DrawPart& part) {
    unflushed_triangles_ += part.triangles;
    if (part.indices) {
        gl_.DrawElements(mesh.mode, part.count, part.index_type, nullptr);
    } else {
        gl_.DrawArrays(mesh.mode, 0, part.count);
    }
}

void Renderer::flush() {
    gl_.Flush();
    unflushed_triangles_ = 0;
}

void Renderer::draw_surface(int surface, int skin_location, const glm::mat4* clip_from_stored) {
    const DrawMesh& drawn = mesh(scene_->surfaces[static_cast<std::size_t>(surface)].mesh);
    const MovingMeshes::Moving* moving = moving_ ? moving_->find(surface) : nullptr;
    if (moving == nullptr) return draw_mesh(drawn, clip_from_stored);
    if (moving->skinned && moving->way == Skinning::texture) bind_texture(kJointUnit, moving->palette_texture.name());
    if (moving->skinned && moving->way == Skinning::uniforms && skin_location >= 0)
        gl_.Uniform4fv(skin_location, static_cast<GLsizei>(3 * moving->palette.size()), &moving->palette[0][0].x);
    for (std::size_t part = 0; part < drawn.parts.size(); ++part) {
        const std::uint32_t array = moving_->bind(*moving, drawn, part);
        state_.bind_array(array);
        if (array == 0) {
            state_.enable_attributes(moving_->attributes(*moving, drawn));
            state_.forget_vertices();  // the next mesh points them anew
        }
        draw_part(drawn, drawn.parts[part]);
    }
}

const Box& Renderer::box(int surface) const {
    const MovingMeshes::Moving* moving = moving_ ? moving_->find(surface) : nullptr;
    return moving != nullptr ? moving->box : mesh(scene_->surfaces[static_cast<std::size_t>(surface)].mesh).box;
}

std::uint32_t Renderer::shape(int surface) const {
    const MovingMeshes::Moving* moving = moving_ ? moving_->find(surface) : nullptr;
    return moving != nullptr ? moving->shape : 0;
}

std::string_view Renderer::skin_define(int surface) const {
    const MovingMeshes::Moving* moving = moving_ ? moving_->find(surface) : nullptr;
    if (moving == nullptr || !moving->skinned || moving->way == Skinning::cpu) return {};
    if (moving->way == Skinning::texture) return "SKIN_TEXTURE";
    return moving->palette.size() <= JOINTS_SMALL ? "SKIN_SMALL" : "SKIN_LARGE";
}

int Renderer::claim_skin(gl::Program& program) {
    use(program);
    if (const int map = program.uniform_if_used("joint_map"); map >= 0) gl_.Uniform1i(map, kJointUnit);
    return program.uniform_if_used("joint_palette");
}

}  // namespace halfframe
