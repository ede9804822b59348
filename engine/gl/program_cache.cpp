// Compiles, links and reflects programs, and keeps them in memory and on disk.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>

#include "engine/cache_file.h"
#include "engine/error.h"
#include "engine/gl/entry_points.h"
#include "engine/gl/fingerprint.h"
#include "engine/gl/program.h"
#include "engine/gl/uniforms_by_vertex.h"

namespace halfframe::gl {
namespace {

// A program file: this header, the driver's name, the driver's binary. The file is only ever read on the machine that
// wrote it, so the numbers are in its own byte order.
constexpr std::array<char, 8> kMagic = {'H', 'F', 'P', 'R', 'O', 'G', '0', '1'};

struct FileHeader {
    std::array<char, 8> magic = kMagic;
    std::array<char, 32> key{};
    std::uint64_t driver_size = 0;  // bytes
    std::uint64_t binary_size = 0;  // bytes
    std::uint64_t binary_hash = 0;
    std::uint32_t binary_format = 0;
    std::uint32_t unused = 0;
};

struct StoredProgram {
    std::uint32_t format = 0;
    std::string binary;
};

/// What `content` holds if it is whole and of this key and driver.
std::optional<StoredProgram> parse_file(std::string_view content, std::string_view key, std::string_view driver) {
    FileHeader header;
    if (content.size() < sizeof header) return std::nullopt;
    std::memcpy(&header, content.data(), sizeof header);
    content.remove_prefix(sizeof header);
    if (header.magic != kMagic || std::string_view(header.key.data(), header.key.size()) != key) return std::nullopt;
    if (header.driver_size != driver.size() || !content.starts_with(driver)) return std::nullopt;
    content.remove_prefix(driver.size());
    if (header.binary_size != content.size() || header.binary_hash != fingerprint(content)) return std::nullopt;
    return StoredProgram{header.binary_format, std::string(content)};
}

std::string file_content(const StoredProgram& program, std::string_view key, std::string_view driver) {
    FileHeader header;
    std::copy(key.begin(), key.end(), header.key.begin());
    header.driver_size = driver.size();
    header.binary_size = program.binary.size();
    header.binary_hash = fingerprint(program.binary);
    header.binary_format = program.format;
    std::string content(sizeof header, '\0');
    std::memcpy(content.data(), &header, sizeof header);
    return content + std::string(driver) + program.binary;
}

/// 32 hexadecimal digits over all that decides a program: two independent fingerprints.
std::string key_of(const ProgramDescription& description, const StageText& vertex, const StageText& fragment) {
    // The dialect, the defines and the arithmetic are in the texts.
    std::string all = vertex.text + '\0' + fragment.text + '\0';
    for (const auto& [name, location] : description.attributes) all += fmt::format("{}={}\n", name, location);
    constexpr std::uint64_t kSecondStart = 0x9e3779b97f4a7c15ULL;
    return fmt::format("{:016x}{:016x}", fingerprint(all), fingerprint(all, kSecondStart));
}

/// "program "surface" (es300, half, FOG 1)": what a person needs to find the variant again.
std::string variant(const ProgramDescription& description) {
    std::string out = fmt::format("program \"{}\" ({}, {}", description.name,
                                  description.dialect == Dialect::es100 ? "es100" : "es300",
                                  description.arithmetic == Arithmetic::half ? "half" : "full");
    for (const auto& [name, value] : description.defines) out += fmt::format(", {} {}", name, value);
    return out + ")";
}

Shader compile_stage(EntryPoints& gl, const ProgramDescription& description, Stage stage, const StageText& text) {
    const bool is_vertex = stage == Stage::vertex;
    Shader shader(gl, gl.CreateShader(is_vertex ? GL_VERTEX_SHADER : GL_FRAGMENT_SHADER));
    if (!shader) throw Error(Fault::context, "the driver made no shader object: the context is lost or out of memory");
    const char* source = text.text.c_str();
    gl.ShaderSource(shader.name(), 1, &source, nullptr);
    gl.CompileShader(shader.name());
    const std::string& path = is_vertex ? description.vertex : description.fragment;
    label(gl, shader, path.c_str());
    GLint compiled = 0;
    gl.GetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_TRUE) return shader;
    GLint length = 0;
    gl.GetShaderiv(shader.name(), GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    GLsizei written = 0;
    gl.GetShaderInfoLog(shader.name(), static_cast<GLsizei>(log.size()), &written, log.data());
    log.resize(static_cast<std::size_t>(written));
    throw Error(Fault::check,
                fmt::format("the {} shader {} of {} does not compile:\n{}", is_vertex ? "vertex" : "fragment", path,
                            variant(description), translate_log(log, text)));
}

bool is_linked(EntryPoints& gl, GLuint program) {
    GLint linked = 0;
    gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
    return linked == GL_TRUE;
}

std::vector<Program::Uniform> read_uniforms(EntryPoints& gl, GLuint program) {
    GLint count = 0;
    GLint longest = 0;
    gl.GetProgramiv(program, GL_ACTIVE_UNIFORMS, &count);
    gl.GetProgramiv(program, GL_ACTIVE_UNIFORM_MAX_LENGTH, &longest);
    std::vector<Program::Uniform> uniforms;
    std::string name;
    for (GLint i = 0; i < count; ++i) {
        name.assign(static_cast<std::size_t>(std::max(longest, 1)), '\0');
        GLsizei length = 0;
        Program::Uniform uniform;
        GLenum type = 0;
        gl.GetActiveUniform(program, static_cast<GLuint>(i), static_cast<GLsizei>(name.size()), &length, &uniform.size,
                            &type, name.data());
        name.resize(static_cast<std::size_t>(length));
        if (name.starts_with("gl_")) continue;  // gl_DepthRange and the like belong to GL
        uniform.location = gl.GetUniformLocation(program, name.c_str());
        if (name.ends_with("[0]")) name.resize(name.size() - 3);
        if (name.starts_with(kHandedOn)) name.erase(0, kHandedOn.size());
        uniform.name = name;
        uniform.type = type;
        uniforms.push_back(uniform);
    }
    // Drivers differ in the order; reports and messages must not.
    std::sort(uniforms.begin(), uniforms.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    return uniforms;
}

/// Does the text declare a uniform of this name? The text is before the preprocessor, so ask only of active ones.
bool declares_uniform(std::string_view text, std::string_view name) {
    const auto is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    for (std::size_t at = text.find("uniform "); at != text.npos; at = text.find("uniform ", at + 1)) {
        const std::string_view declaration = text.substr(at, text.find(';', at) - at);
        const std::size_t found = declaration.rfind(name);
        if (found == declaration.npos || found == 0 || is_word(declaration[found - 1])) continue;
        const std::size_t end = found + name.size();
        if (end == declaration.size() || !is_word(declaration[end])) return true;
    }
    return false;
}

/// Samplers one stage of a linked program uses.
int samplers_in(const std::vector<Program::Uniform>& uniforms, std::string_view text) {
    int samplers = 0;
    for (const Program::Uniform& uniform : uniforms) {
        const bool is_sampler =
            uniform.type == GL_SAMPLER_2D || uniform.type == GL_SAMPLER_CUBE || uniform.type == GL_SAMPLER_3D;
        if (is_sampler && declares_uniform(text, uniform.name)) samplers += uniform.size;
    }
    return samplers;
}

/// A driver links what a poorer device would not: the sampler limits of `caps` are held here. Uniform vectors and
/// varyings cannot be told apart by stage from outside; the plan refuses a device that has fewer than a tier promises
/// to live with.
void expect_within_limits(const Caps& caps, const ProgramDescription& description,
                          const std::vector<Program::Uniform>& uniforms, const StageText& vertex,
                          const StageText& fragment) {
    const int in_vertex = samplers_in(uniforms, vertex.text);
    const int in_fragment = samplers_in(uniforms, fragment.text);
    const auto expect_limit = [&](int used, int limit, const char* what) {
        if (used <= limit) return;
        throw Error(Fault::context, fmt::format("{} takes {} {} and {} has {}; use a lower --tier or another --device",
                                                variant(description), used, what, caps.device, limit));
    };
    expect_limit(in_vertex, caps.max_vertex_samplers, "vertex samplers");
    expect_limit(in_fragment, caps.max_fragment_samplers, "fragment samplers");
    expect_limit(in_vertex + in_fragment, caps.max_combined_samplers, "samplers together");
}

/// Takes away what an attempt left in glGetError, so that nobody takes it for his own.
bool had_error(EntryPoints& gl) {
    bool had = false;
    for (int i = 0; i < 16 && gl.GetError() != GL_NO_ERROR; ++i) had = true;
    return had;
}

}  // namespace

ProgramCache::ProgramCache(EntryPoints& gl, const Caps& caps, std::filesystem::path folder,
                           std::span<const ShaderFile> files)
    : gl_(gl),
      caps_(caps),
      folder_(std::move(folder)),
      files_(files),
      driver_(caps.vendor + "\n" + caps.renderer + "\n" + caps.version) {
    if (!caps_.program_binary) folder_.clear();
}

Program& ProgramCache::get(const ProgramDescription& asked) {
    ProgramDescription description = asked;
    if (caps_.gathers_uniforms && caps_.fragment_highp) {
        description.uniforms_by_vertex = true;
        if (Program* program = find_or_make(description)) return *program;
        description.uniforms_by_vertex = false;  // more than the varyings hold
    }
    Program* program = find_or_make(description);
    expect(program != nullptr, "a program that does not link was not reported");
    return *program;
}

Program* ProgramCache::find_or_make(const ProgramDescription& description) {
    const StageText vertex = assemble_stage(description, Stage::vertex, files_);
    const StageText fragment = assemble_stage(description, Stage::fragment, files_);
    const std::string key = key_of(description, vertex, fragment);
    if (const auto known = by_key_.find(key); known != by_key_.end()) {
        if (known->second != nullptr) ++statistics_.shared;
        return known->second;
    }
    auto program = std::make_unique<Program>();
    program->description_ = description;
    if (load_binary(*program, key)) {
        ++statistics_.from_disk;
    } else {
        if (!compile(*program, vertex, fragment)) return by_key_[key] = nullptr;
        ++statistics_.compiled;
        save_binary(*program, key);
    }
    label(gl_, program->program_, description.name.c_str());
    program->uniforms_ = read_uniforms(gl_, program->name());
    expect_within_limits(caps_, description, program->uniforms_, vertex, fragment);
    programs_.push_back(std::move(program));
    return by_key_[key] = programs_.back().get();
}

/// False where it does not link because too much is handed on; every other failure is thrown.
bool ProgramCache::compile(Program& program, const StageText& vertex_text, const StageText& fragment_text) {
    const ProgramDescription& description = program.description_;
    const Shader vertex = compile_stage(gl_, description, Stage::vertex, vertex_text);
    const Shader fragment = compile_stage(gl_, description, Stage::fragment, fragment_text);
    program.program_ = create<Kind::program>(gl_);
    const GLuint name = program.name();
    gl_.AttachShader(name, vertex.name());
    gl_.AttachShader(name, fragment.name());
    for (const auto& [attribute, location] : description.attributes) {
        gl_.BindAttribLocation(name, static_cast<GLuint>(location), attribute.c_str());
    }
    // Without the hint a driver may keep no binary; glProgramParameteri came with ES 3.0.
    if (!folder_.empty() && caps_.es_version >= 30) {
        gl_.ProgramParameteri(name, GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE);
    }
    gl_.LinkProgram(name);
    if (!is_linked(gl_, name)) {
        if (description.uniforms_by_vertex) return false;
        GLint length = 0;
        gl_.GetProgramiv(name, GL_INFO_LOG_LENGTH, &length);
        std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
        GLsizei written = 0;
        gl_.GetProgramInfoLog(name, static_cast<GLsizei>(log.size()), &written, log.data());
        log.resize(static_cast<std::size_t>(written));
        throw Error(Fault::check, fmt::format("{} and {} of {} do not link:\n{}", description.vertex,
                                              description.fragment, variant(description), log));
    }
    gl_.DetachShader(name, vertex.name());
    gl_.DetachShader(name, fragment.name());
    return true;
}

std::filesystem::path ProgramCache::binary_path(const std::string& key) const {
    return folder_ / fmt::format("{:016x}.program", fingerprint(driver_, fingerprint(key)));
}

bool ProgramCache::load_binary(Program& program, const std::string& key) {
    if (folder_.empty()) return false;
    std::ifstream file(binary_path(key), std::ios::binary);
    if (!file) return false;
    const std::string content{std::istreambuf_iterator<char>(file), {}};
    if (const auto stored = parse_file(content, key, driver_)) {
        ProgramName name = create<Kind::program>(gl_);
        gl_.ProgramBinary(name.name(), stored->format, stored->binary.data(),
                          static_cast<GLsizei>(stored->binary.size()));
        // An updated driver may refuse its own old binary, by an error or by not linking.
        if (!had_error(gl_) && is_linked(gl_, name.name())) {
            program.program_ = std::move(name);
            return true;
        }
    }
    ++statistics_.disk_ignored;
    return false;
}

void ProgramCache::save_binary(const Program& program, const std::string& key) {
    if (folder_.empty()) return;
    GLint size = 0;
    gl_.GetProgramiv(program.name(), GL_PROGRAM_BINARY_LENGTH, &size);
    if (size <= 0) return;
    StoredProgram stored;
    stored.binary.resize(static_cast<std::size_t>(size));
    GLsizei written = 0;
    gl_.GetProgramBinary(program.name(), size, &written, &stored.format, stored.binary.data());
    if (had_error(gl_) || written <= 0) return;
    stored.binary.resize(static_cast<std::size_t>(written));

    const std::error_code error = write_cache_file(binary_path(key), file_content(stored, key, driver_));
    if (!error) return;
    notice(
        fmt::format("the program cache folder {} cannot be written ({}): programs are compiled anew in every run; give "
                    "another folder or make this one writable",
                    folder_.string(), error.message()));
}

void ProgramCache::notice(const std::string& sentence) {
    if (std::find(notices_.begin(), notices_.end(), sentence) == notices_.end()) notices_.push_back(sentence);
}

std::vector<const Program*> ProgramCache::programs() const {
    std::vector<const Program*> all;
    all.reserve(programs_.size());
    for (const auto& program : programs_) all.push_back(program.get());
    return all;
}

}  // namespace halfframe::gl
