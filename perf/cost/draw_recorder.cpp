// One file because the hooks see what nobody else may. They are plain functions, because that is what a loader hands
// out: they find the recorder of their thread. State is asked from GL at each draw instead of being followed, so that
// nothing can be followed wrongly.
#include "perf/cost/draw_recorder.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "engine/error.h"

namespace halfframe::cost {
namespace {

// Desktop GL, not in the headers of ES 3.0.
constexpr GLenum kSamplesPassed = 0x8914;
constexpr GLenum kTextureWidth = 0x1000;
constexpr GLenum kTextureHeight = 0x1001;
constexpr GLenum kTextureInternalFormat = 0x1003;
constexpr GLenum kSampler3D = GL_SAMPLER_3D;

thread_local DrawRecorder* recorder_of_thread = nullptr;

}  // namespace

/// The real functions.
struct DrawRecorder::Functions {
    template <typename Function>
    void load(const gl::Loader& loader, Function*& function, const char* name) {
        void* address = loader(name);
        expect(address != nullptr, [&] { return std::string("a desktop context without ") + name; });
        std::memcpy(&function, &address, sizeof(function));
    }

    explicit Functions(const gl::Loader& loader) {
#define HALFFRAME_LOAD(name) load(loader, name, "gl" #name);
        HALFFRAME_LOAD(DrawArrays)
        HALFFRAME_LOAD(DrawElements)
        HALFFRAME_LOAD(BlitFramebuffer)
        HALFFRAME_LOAD(BufferData)
        HALFFRAME_LOAD(BufferSubData)
        HALFFRAME_LOAD(CreateShader)
        HALFFRAME_LOAD(ShaderSource)
        HALFFRAME_LOAD(AttachShader)
        HALFFRAME_LOAD(BindAttribLocation)
        HALFFRAME_LOAD(CompileShader)
        HALFFRAME_LOAD(CreateProgram)
        HALFFRAME_LOAD(LinkProgram)
        HALFFRAME_LOAD(DeleteProgram)
        HALFFRAME_LOAD(DeleteShader)
        HALFFRAME_LOAD(UseProgram)
        HALFFRAME_LOAD(GetProgramiv)
        HALFFRAME_LOAD(GetActiveUniform)
        HALFFRAME_LOAD(GetUniformLocation)
        HALFFRAME_LOAD(GetUniformfv)
        HALFFRAME_LOAD(GetUniformiv)
        HALFFRAME_LOAD(Uniform1fv)
        HALFFRAME_LOAD(Uniform2fv)
        HALFFRAME_LOAD(Uniform3fv)
        HALFFRAME_LOAD(Uniform4fv)
        HALFFRAME_LOAD(Uniform1iv)
        HALFFRAME_LOAD(UniformMatrix3fv)
        HALFFRAME_LOAD(UniformMatrix4fv)
        HALFFRAME_LOAD(GetIntegerv)
        HALFFRAME_LOAD(GetBooleanv)
        HALFFRAME_LOAD(IsEnabled)
        HALFFRAME_LOAD(ColorMask)
        HALFFRAME_LOAD(ActiveTexture)
        HALFFRAME_LOAD(GetTexLevelParameteriv)
        HALFFRAME_LOAD(GetTexParameteriv)
        HALFFRAME_LOAD(GetFramebufferAttachmentParameteriv)
        HALFFRAME_LOAD(GetTextureLevelParameteriv)
        HALFFRAME_LOAD(GetNamedRenderbufferParameteriv)
        HALFFRAME_LOAD(CreateRenderbuffers)
        HALFFRAME_LOAD(DeleteRenderbuffers)
        HALFFRAME_LOAD(NamedRenderbufferStorageMultisample)
        HALFFRAME_LOAD(CopyImageSubData)
        HALFFRAME_LOAD(GenQueries)
        HALFFRAME_LOAD(DeleteQueries)
        HALFFRAME_LOAD(BeginQuery)
        HALFFRAME_LOAD(EndQuery)
        HALFFRAME_LOAD(GetQueryObjectui64v)
        HALFFRAME_LOAD(Flush)
#undef HALFFRAME_LOAD
    }

    [[nodiscard]] std::uint32_t integer(GLenum name) const {
        GLint value = 0;
        GetIntegerv(name, &value);
        return static_cast<std::uint32_t>(value);
    }
    [[nodiscard]] bool boolean(GLenum name) const {
        GLboolean value = GL_FALSE;
        GetBooleanv(name, &value);
        return value == GL_TRUE;
    }

    void (*DrawArrays)(GLenum, GLint, GLsizei);
    void (*DrawElements)(GLenum, GLsizei, GLenum, const void*);
    void (*BlitFramebuffer)(GLint, GLint, GLint, GLint, GLint, GLint, GLint, GLint, GLbitfield, GLenum);
    void (*BufferData)(GLenum, GLsizeiptr, const void*, GLenum);
    void (*BufferSubData)(GLenum, GLintptr, GLsizeiptr, const void*);
    GLuint (*CreateShader)(GLenum);
    void (*ShaderSource)(GLuint, GLsizei, const GLchar* const*, const GLint*);
    void (*AttachShader)(GLuint, GLuint);
    void (*BindAttribLocation)(GLuint, GLuint, const GLchar*);
    void (*CompileShader)(GLuint);
    GLuint (*CreateProgram)();
    void (*LinkProgram)(GLuint);
    void (*DeleteProgram)(GLuint);
    void (*DeleteShader)(GLuint);
    void (*UseProgram)(GLuint);
    void (*GetProgramiv)(GLuint, GLenum, GLint*);
    void (*GetActiveUniform)(GLuint, GLuint, GLsizei, GLsizei*, GLint*, GLenum*, GLchar*);
    GLint (*GetUniformLocation)(GLuint, const GLchar*);
    void (*GetUniformfv)(GLuint, GLint, GLfloat*);
    void (*GetUniformiv)(GLuint, GLint, GLint*);
    void (*Uniform1fv)(GLint, GLsizei, const GLfloat*);
    void (*Uniform2fv)(GLint, GLsizei, const GLfloat*);
    void (*Uniform3fv)(GLint, GLsizei, const GLfloat*);
    void (*Uniform4fv)(GLint, GLsizei, const GLfloat*);
    void (*Uniform1iv)(GLint, GLsizei, const GLint*);
    void (*UniformMatrix3fv)(GLint, GLsizei, GLboolean, const GLfloat*);
    void (*UniformMatrix4fv)(GLint, GLsizei, GLboolean, const GLfloat*);
    void (*GetIntegerv)(GLenum, GLint*);
    void (*GetBooleanv)(GLenum, GLboolean*);
    GLboolean (*IsEnabled)(GLenum);
    void (*ColorMask)(GLboolean, GLboolean, GLboolean, GLboolean);
    void (*ActiveTexture)(GLenum);
    void (*GetTexLevelParameteriv)(GLenum, GLint, GLenum, GLint*);
    void (*GetTexParameteriv)(GLenum, GLenum, GLint*);
    void (*GetFramebufferAttachmentParameteriv)(GLenum, GLenum, GLenum, GLint*);
    void (*GetTextureLevelParameteriv)(GLuint, GLint, GLenum, GLint*);
    void (*GetNamedRenderbufferParameteriv)(GLuint, GLenum, GLint*);
    void (*CreateRenderbuffers)(GLsizei, GLuint*);
    void (*DeleteRenderbuffers)(GLsizei, const GLuint*);
    void (*NamedRenderbufferStorageMultisample)(GLuint, GLsizei, GLenum, GLsizei, GLsizei);
    void (*CopyImageSubData)(GLuint, GLenum, GLint, GLint, GLint, GLint, GLuint, GLenum, GLint, GLint, GLint, GLint,
                             GLsizei, GLsizei, GLsizei);
    void (*GenQueries)(GLsizei, GLuint*);
    void (*DeleteQueries)(GLsizei, const GLuint*);
    void (*BeginQuery)(GLenum, GLuint);
    void (*EndQuery)(GLenum);
    void (*GetQueryObjectui64v)(GLuint, GLenum, GLuint64*);
    void (*Flush)();
};

/// What the engine gets in the place of the real functions.
struct DrawRecorder::Hooks {
    static DrawRecorder& recorder() { return *recorder_of_thread; }

    static void draw_arrays(GLenum mode, GLint first, GLsizei count) {
        DrawRecorder& one = recorder();
        if (!one.recording_) return one.gl_->DrawArrays(mode, first, count);
        RecordedDraw& draw = one.begin_draw(mode, count);
        draw.transformed = draw.vertices;
        one.draw(draw, [&] { one.gl_->DrawArrays(mode, first, count); });
    }

    static void draw_elements(GLenum mode, GLsizei count, GLenum type, const void* offset) {
        DrawRecorder& one = recorder();
        if (!one.recording_) return one.gl_->DrawElements(mode, count, type, offset);
        RecordedDraw& draw = one.begin_draw(mode, count);
        one.count_vertices(draw, count, type, reinterpret_cast<std::uintptr_t>(offset));
        one.draw(draw, [&] { one.gl_->DrawElements(mode, count, type, offset); });
    }

    static void blit(GLint a, GLint b, GLint c, GLint d, GLint left, GLint bottom, GLint right, GLint top,
                     GLbitfield mask, GLenum filter) {
        DrawRecorder& one = recorder();
        one.gl_->BlitFramebuffer(a, b, c, d, left, bottom, right, top, mask, filter);
        if (!one.recording_) return;
        const auto width = static_cast<std::uint64_t>(std::abs(right - left));
        const auto height = static_cast<std::uint64_t>(std::abs(top - bottom));
        one.draws_.push_back({.pass = one.pass_name_(), .samples_written = width * height});
        one.queries_.push_back({});
    }

    static void buffer_data(GLenum target, GLsizeiptr size, const void* data, GLenum usage) {
        DrawRecorder& one = recorder();
        one.gl_->BufferData(target, size, data, usage);
        if (target != GL_ELEMENT_ARRAY_BUFFER) return;
        std::vector<std::uint8_t>& copy = one.indices_[one.gl_->integer(GL_ELEMENT_ARRAY_BUFFER_BINDING)];
        copy.assign(static_cast<std::size_t>(size), 0);
        if (data != nullptr) std::memcpy(copy.data(), data, copy.size());
    }

    static void buffer_sub_data(GLenum target, GLintptr offset, GLsizeiptr size, const void* data) {
        DrawRecorder& one = recorder();
        one.gl_->BufferSubData(target, offset, size, data);
        if (target != GL_ELEMENT_ARRAY_BUFFER) return;
        std::vector<std::uint8_t>& copy = one.indices_[one.gl_->integer(GL_ELEMENT_ARRAY_BUFFER_BINDING)];
        if (static_cast<std::size_t>(offset + size) <= copy.size())
            std::memcpy(copy.data() + offset, data, static_cast<std::size_t>(size));
    }

    static GLuint create_shader(GLenum stage) {
        const GLuint shader = recorder().gl_->CreateShader(stage);
        recorder().stages_.stage[shader] = stage;
        return shader;
    }

    static void shader_source(GLuint shader, GLsizei count, const GLchar* const* text, const GLint* length) {
        recorder().gl_->ShaderSource(shader, count, text, length);
        std::string& source = recorder().stages_.source[shader];
        source.clear();
        for (GLsizei i = 0; i < count; ++i) {
            const bool counted = length != nullptr && length[i] >= 0;
            source += counted ? std::string(text[i], static_cast<std::size_t>(length[i])) : std::string(text[i]);
        }
    }

    static void attach_shader(GLuint program, GLuint shader) {
        recorder().gl_->AttachShader(program, shader);
        recorder().stages_.shaders[program].push_back(shader);
    }

    static void bind_attribute(GLuint program, GLuint index, const GLchar* name) {
        recorder().gl_->BindAttribLocation(program, index, name);
        recorder().stages_.attributes[program].emplace_back(index, name);
    }

    /// Names are given anew: what was known of the old ones is forgotten.
    static void link_program(GLuint program) {
        DrawRecorder& one = recorder();
        one.gl_->LinkProgram(program);
        one.keeping_.erase(program);
    }

    static GLuint create_program() {
        const GLuint program = recorder().gl_->CreateProgram();
        recorder().stages_.shaders[program].clear();
        recorder().stages_.attributes[program].clear();
        return program;
    }
};

DrawRecorder::DrawRecorder(gl::Loader loader) : loader_(std::move(loader)) {
    expect(recorder_of_thread == nullptr, "two recorders of draws on one thread");
    gl_ = std::make_unique<Functions>(loader_);
    recorder_of_thread = this;
}

DrawRecorder::~DrawRecorder() { recorder_of_thread = nullptr; }

gl::Loader DrawRecorder::loader() const {
    return [loader = loader_](const char* name) -> void* {
        const auto address = [](auto* function) {
            void* result = nullptr;
            std::memcpy(&result, &function, sizeof(result));
            return result;
        };
        const std::string wanted = name;
        if (wanted == "glDrawArrays") return address(&Hooks::draw_arrays);
        if (wanted == "glDrawElements") return address(&Hooks::draw_elements);
        if (wanted == "glBlitFramebuffer") return address(&Hooks::blit);
        if (wanted == "glBufferData") return address(&Hooks::buffer_data);
        if (wanted == "glBufferSubData") return address(&Hooks::buffer_sub_data);
        if (wanted == "glCreateShader") return address(&Hooks::create_shader);
        if (wanted == "glShaderSource") return address(&Hooks::shader_source);
        if (wanted == "glAttachShader") return address(&Hooks::attach_shader);
        if (wanted == "glBindAttribLocation") return address(&Hooks::bind_attribute);
        if (wanted == "glLinkProgram") return address(&Hooks::link_program);
        if (wanted == "glCreateProgram") return address(&Hooks::create_program);
        return loader(name);
    };
}

void DrawRecorder::start(std::function<std::string()> pass_name, std::function<bool(std::uint32_t)> discards) {
    pass_name_ = std::move(pass_name);
    discards_ = std::move(discards);
    draws_.clear();
    queries_.clear();
    recording_ = true;
}

std::vector<RecordedDraw> DrawRecorder::finish() {
    recording_ = false;
    for (std::size_t i = 0; i < draws_.size(); ++i) {
        const auto answer = [&](std::uint32_t query) {
            GLuint64 samples = 0;
            gl_->GetQueryObjectui64v(query, GL_QUERY_RESULT, &samples);
            gl_->DeleteQueries(1, &query);
            return static_cast<std::uint64_t>(samples);
        };
        if (queries_[i].written != 0) draws_[i].samples_written = answer(queries_[i].written);
        if (queries_[i].shaded != 0) draws_[i].samples_shaded = answer(queries_[i].shaded);
        else if (draws_[i].program != 0) draws_[i].samples_shaded = draws_[i].samples_written;
    }
    for (const auto& [program, keeping] : keeping_)
        if (keeping != 0) gl_->DeleteProgram(keeping);
    keeping_.clear();
    return std::move(draws_);
}

RecordedDraw& DrawRecorder::begin_draw(std::uint32_t mode, int count) {
    draws_.push_back({.pass = pass_name_(), .program = gl_->integer(GL_CURRENT_PROGRAM)});
    queries_.push_back({});
    RecordedDraw& draw = draws_.back();
    draw.vertices = static_cast<std::uint64_t>(count);
    const std::uint64_t strip = draw.vertices >= 2 ? draw.vertices - 2 : 0;
    draw.triangles = mode == GL_TRIANGLES                                   ? draw.vertices / 3
                     : mode == GL_TRIANGLE_STRIP || mode == GL_TRIANGLE_FAN ? strip
                                                                            : draw.vertices;
    read_state(draw);
    read_textures(draw);
    return draw;
}

void DrawRecorder::read_state(RecordedDraw& draw) {
    draw.blends = gl_->IsEnabled(GL_BLEND) == GL_TRUE;
    draw.additive = draw.blends && gl_->integer(GL_BLEND_SRC_RGB) == GL_ONE && gl_->integer(GL_BLEND_DST_RGB) == GL_ONE;
    std::array<GLboolean, 4> mask{};
    gl_->GetBooleanv(GL_COLOR_WRITEMASK, mask.data());
    draw.writes_color = mask[0] == GL_TRUE;
    draw.tests_depth = gl_->IsEnabled(GL_DEPTH_TEST) == GL_TRUE;
    draw.writes_depth = draw.tests_depth && gl_->boolean(GL_DEPTH_WRITEMASK);
}

void DrawRecorder::read_textures(RecordedDraw& draw) {
    const std::uint32_t active = gl_->integer(GL_ACTIVE_TEXTURE);
    GLint uniforms = 0;
    gl_->GetProgramiv(draw.program, GL_ACTIVE_UNIFORMS, &uniforms);
    for (GLint i = 0; i < uniforms; ++i) {
        std::array<GLchar, 256> name{};
        GLint size = 0;
        GLenum type = 0;
        gl_->GetActiveUniform(draw.program, static_cast<GLuint>(i), name.size(), nullptr, &size, &type, name.data());
        const bool cube = type == GL_SAMPLER_CUBE || type == GL_SAMPLER_CUBE_SHADOW;
        const bool flat = type == GL_SAMPLER_2D || type == GL_SAMPLER_2D_SHADOW;
        if (!cube && !flat && type != kSampler3D) continue;
        GLint unit = 0;
        gl_->GetUniformiv(draw.program, gl_->GetUniformLocation(draw.program, name.data()), &unit);
        gl_->ActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + unit));
        const GLenum target = cube ? GL_TEXTURE_CUBE_MAP : flat ? GL_TEXTURE_2D : GL_TEXTURE_3D;
        const GLenum binding = cube   ? GL_TEXTURE_BINDING_CUBE_MAP
                               : flat ? GL_TEXTURE_BINDING_2D
                                      : GL_TEXTURE_BINDING_3D;
        const GLenum level_target = cube ? GL_TEXTURE_CUBE_MAP_POSITIVE_X : target;
        RecordedTexture texture{.sampler = name.data(), .texture = gl_->integer(binding)};
        texture.sampler = texture.sampler.substr(0, texture.sampler.find('['));
        GLint format = 0, filter = 0, width = 0, height = 0;
        gl_->GetTexLevelParameteriv(level_target, 0, kTextureInternalFormat, &format);
        gl_->GetTexLevelParameteriv(level_target, 0, kTextureWidth, &width);
        gl_->GetTexLevelParameteriv(level_target, 0, kTextureHeight, &height);
        gl_->GetTexParameteriv(target, GL_TEXTURE_MIN_FILTER, &filter);
        texture.internal_format = static_cast<std::uint32_t>(format);
        texture.trilinear = filter == GL_LINEAR_MIPMAP_LINEAR;
        const bool levels = filter != GL_LINEAR && filter != GL_NEAREST;
        // Smaller levels add a third.
        texture.texels = 1.0 * width * height * (cube ? 6.0 : 1.0) * (levels ? 4.0 / 3.0 : 1.0);
        draw.textures.push_back(texture);
    }
    gl_->ActiveTexture(active);
}

/// llvmpipe (Mesa 22.3) writes the start and the end of a query into a list of every tile. Where its memory for lists,
/// 36 MiB, is used up in the middle of that, it draws what it has, and counts for the query what was counted before in
/// those tiles that have no start yet, or have an end already; the answer may then be asked for before the last tile
/// has ended, and the query be deleted under it. So the lists are handed over before either: both stand in lists that
/// are empty.
std::uint32_t DrawRecorder::count(const std::function<void()>& submit) {
    GLuint query = 0;
    gl_->GenQueries(1, &query);
    gl_->Flush();
    gl_->BeginQuery(kSamplesPassed, query);
    submit();
    gl_->Flush();
    gl_->EndQuery(kSamplesPassed);
    return query;
}

/// The depth attachment of the bound framebuffer, kept aside while a draw that must leave no trace writes to it.
class DrawRecorder::KeptDepth {
public:
    explicit KeptDepth(const Functions& gl) : gl_(gl) {
        const auto attached = [&](GLenum parameter) {
            GLint value = 0;
            gl_.GetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, parameter, &value);
            return value;
        };
        const GLint kind = attached(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE);
        if (kind == GL_NONE) return;
        name_ = static_cast<GLuint>(attached(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME));
        is_texture_ = kind == GL_TEXTURE;
        const auto parameter = [&](GLenum of_texture, GLenum of_renderbuffer) {
            GLint value = 0;
            if (is_texture_) gl_.GetTextureLevelParameteriv(name_, 0, of_texture, &value);
            else gl_.GetNamedRenderbufferParameteriv(name_, of_renderbuffer, &value);
            return value;
        };
        width_ = parameter(kTextureWidth, GL_RENDERBUFFER_WIDTH);
        height_ = parameter(kTextureHeight, GL_RENDERBUFFER_HEIGHT);
        const GLint format = parameter(kTextureInternalFormat, GL_RENDERBUFFER_INTERNAL_FORMAT);
        const GLint samples = is_texture_ ? 0 : parameter(0, GL_RENDERBUFFER_SAMPLES);
        gl_.CreateRenderbuffers(1, &copy_);
        gl_.NamedRenderbufferStorageMultisample(copy_, samples, static_cast<GLenum>(format), width_, height_);
        copy(name_, target(), copy_, GL_RENDERBUFFER);
    }
    ~KeptDepth() {
        if (copy_ == 0) return;
        copy(copy_, GL_RENDERBUFFER, name_, target());
        gl_.DeleteRenderbuffers(1, &copy_);
    }
    KeptDepth(const KeptDepth&) = delete;
    KeptDepth& operator=(const KeptDepth&) = delete;

private:
    [[nodiscard]] GLenum target() const { return is_texture_ ? GL_TEXTURE_2D : GL_RENDERBUFFER; }
    void copy(GLuint from, GLenum from_target, GLuint to, GLenum to_target) const {
        gl_.CopyImageSubData(from, from_target, 0, 0, 0, 0, to, to_target, 0, 0, 0, 0, width_, height_, 1);
    }

    const Functions& gl_;
    GLuint name_ = 0;
    GLuint copy_ = 0;
    bool is_texture_ = false;
    GLint width_ = 0;
    GLint height_ = 0;
};

/// Fragments that a draw hides from itself are hidden in both counts, so depth is written in both.
void DrawRecorder::draw(RecordedDraw& draw, const std::function<void()>& submit) {
    Queries& queries = queries_.back();
    if (const std::uint32_t keeping = keeping_program(draw.program); keeping != 0) {
        const KeptDepth depth(*gl_);
        std::array<GLboolean, 4> mask{};
        gl_->GetBooleanv(GL_COLOR_WRITEMASK, mask.data());
        gl_->UseProgram(keeping);
        copy_uniforms(draw.program, keeping);
        gl_->ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        queries.shaded = count(submit);
        gl_->ColorMask(mask[0], mask[1], mask[2], mask[3]);
        gl_->UseProgram(draw.program);
    }
    queries.written = count(submit);
}

std::uint32_t DrawRecorder::keeping_program(std::uint32_t program) {
    if (const auto known = keeping_.find(program); known != keeping_.end()) return known->second;
    std::string vertex;
    for (const std::uint32_t shader : stages_.shaders[program])
        if (stages_.stage[shader] == GL_VERTEX_SHADER) vertex = stages_.source[shader];
    if (!discards_(program) || vertex.empty()) return keeping_[program] = 0;
    const std::string version = vertex.substr(0, vertex.find('\n') + 1);
    const std::string fragment = version + "void main() {}\n";
    const GLuint made = gl_->CreateProgram();
    for (const auto& [stage, text] : {std::pair<GLenum, const std::string*>{GL_VERTEX_SHADER, &vertex},
                                      std::pair<GLenum, const std::string*>{GL_FRAGMENT_SHADER, &fragment}}) {
        const GLuint shader = gl_->CreateShader(stage);
        const GLchar* source = text->c_str();
        gl_->ShaderSource(shader, 1, &source, nullptr);
        gl_->CompileShader(shader);
        gl_->AttachShader(made, shader);
        gl_->DeleteShader(shader);
    }
    for (const auto& [index, name] : stages_.attributes[program]) gl_->BindAttribLocation(made, index, name.c_str());
    gl_->LinkProgram(made);
    GLint linked = GL_FALSE;
    gl_->GetProgramiv(made, GL_LINK_STATUS, &linked);
    expect(linked == GL_TRUE, "a vertex stage does not link with a fragment stage that keeps everything");
    return keeping_[program] = made;
}

void DrawRecorder::copy_uniforms(std::uint32_t from, std::uint32_t to) {
    GLint uniforms = 0;
    gl_->GetProgramiv(to, GL_ACTIVE_UNIFORMS, &uniforms);
    for (GLint i = 0; i < uniforms; ++i) {
        std::array<GLchar, 256> spelled{};
        GLint size = 0;
        GLenum type = 0;
        gl_->GetActiveUniform(to, static_cast<GLuint>(i), spelled.size(), nullptr, &size, &type, spelled.data());
        const std::string name = std::string(spelled.data()).substr(0, std::string(spelled.data()).find('['));
        for (GLint element = 0; element < size; ++element) {
            const std::string one = size > 1 ? name + '[' + std::to_string(element) + ']' : name;
            const GLint source = gl_->GetUniformLocation(from, one.c_str());
            const GLint target = gl_->GetUniformLocation(to, one.c_str());
            if (source < 0 || target < 0) continue;
            std::array<GLfloat, 16> floats{};
            GLint integer = 0;
            switch (type) {
                case GL_INT:
                case GL_BOOL:
                case GL_SAMPLER_2D:
                case GL_SAMPLER_CUBE:
                    gl_->GetUniformiv(from, source, &integer);
                    gl_->Uniform1iv(target, 1, &integer);
                    continue;
                default: gl_->GetUniformfv(from, source, floats.data()); break;
            }
            switch (type) {
                case GL_FLOAT: gl_->Uniform1fv(target, 1, floats.data()); break;
                case GL_FLOAT_VEC2: gl_->Uniform2fv(target, 1, floats.data()); break;
                case GL_FLOAT_VEC3: gl_->Uniform3fv(target, 1, floats.data()); break;
                case GL_FLOAT_VEC4: gl_->Uniform4fv(target, 1, floats.data()); break;
                case GL_FLOAT_MAT3: gl_->UniformMatrix3fv(target, 1, GL_FALSE, floats.data()); break;
                case GL_FLOAT_MAT4: gl_->UniformMatrix4fv(target, 1, GL_FALSE, floats.data()); break;
                default: throw Mistake("a uniform of a type that the recorder of draws does not copy: " + one);
            }
        }
    }
}

void DrawRecorder::count_vertices(RecordedDraw& draw, int count, std::uint32_t index_type, std::uint64_t offset) {
    const std::vector<std::uint8_t>& bytes = indices_[gl_->integer(GL_ELEMENT_ARRAY_BUFFER_BINDING)];
    const std::size_t width = index_type == GL_UNSIGNED_INT ? 4 : index_type == GL_UNSIGNED_SHORT ? 2 : 1;
    expect(offset + static_cast<std::size_t>(count) * width <= bytes.size(), "indices that were never uploaded");
    std::vector<std::uint64_t> entered;  // by index: which entry of the cache it was, from 1; 0: none yet
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        std::uint32_t index = 0;
        std::memcpy(&index, bytes.data() + offset + i * width, width);  // little-endian, as all machines here
        if (index >= entered.size()) entered.resize(std::size_t{index} + 1, 0);
        if (entered[index] != 0 && draw.transformed - entered[index] < kVertexCache) continue;
        entered[index] = ++draw.transformed;
    }
}

}  // namespace halfframe::cost
