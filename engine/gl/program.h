// Programs: dialect prelude + variant defines + text, linked, reflected and cached.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/gl/caps.h"
#include "engine/gl/object.h"

namespace halfframe::gl {

/// One file of shaders_es/, compiled into the library. `path` is relative to shaders_es/, e.g. "surface/surface.frag".
struct ShaderFile {
    const char* path;
    std::string_view text;
};

/// Every file of shaders_es/ (generated at build time, sorted by path).
[[nodiscard]] std::span<const ShaderFile> shader_files();
[[nodiscard]] const ShaderFile* find_shader_file(std::string_view path);

enum class Dialect : std::uint8_t { es100, es300 };
enum class Stage : std::uint8_t { vertex, fragment };
enum class Arithmetic : std::uint8_t { half, full };

using Define = std::pair<std::string, std::string>;

/// Code a material effect adds to another effect's shader at a named point.
struct Insertion {
    const char* point;  ///< name of the insertion point, e.g. "color" for //@insert color
    const char* file;   ///< file with the functions the code calls, e.g. "tone_map/tone_map.glsl"; may be nullptr
    const char* code;   ///< one or more statements, e.g. "color = tone_map(color);"
    const char* only_with = nullptr;  ///< left out of programs without this define; nullptr: in all
};

/// All that decides a program's text.
struct ProgramDescription {
    std::string name;      ///< for errors, labels and reports, e.g. "surface"
    std::string vertex;    ///< path in shaders_es
    std::string fragment;  ///< path in shaders_es
    Dialect dialect = Dialect::es300;
    Arithmetic arithmetic = Arithmetic::full;
    bool fragment_highp = true;  ///< false: the word highp never reaches the fragment stage
    bool uniforms_by_vertex = false;  ///< the vertex stage hands the fragment stage's uniforms on: same picture
    std::vector<Define> defines;
    std::vector<Insertion> insertions;
    /// Attribute locations, bound before linking.
    std::vector<std::pair<std::string, int>> attributes;
};

/// The #line directives of a stage number line 7 of file n as n * kLinesPerFile + 7, source string n. Workaround
/// mesa_forgets_source_string: Mesa reports every error after the syntax check in source string 0, so the line number
/// alone has to tell the file.
inline constexpr int kLinesPerFile = 10000;

/// One stage as the compiler gets it.
struct StageText {
    std::string text;
    std::vector<std::string> files;  ///< files[n] is the path behind file n of the #line directives; 0 is "<prelude>"
};

/// Puts a stage together: #version, precision defaults, defines (STAGE_VERTEX or STAGE_FRAGMENT, ARITHMETIC_HALF or
/// ARITHMETIC_FULL, FRAGMENT_HIGHP, then the description's), dialect/<dialect>.glsl, then the file with its
/// #include "path" lines resolved (each file once) and each `//@insert point` line replaced by the code of the
/// insertions that name it, in order. The files of these insertions come, once each, at the line `//@insert_functions`.
/// With uniforms_by_vertex the vertex stage ends in what hands the fragment stage's uniforms on.
/// Pure. `files` are all there is to include. Throws Error(input) for a missing file; Mistake for an insertion whose
/// point exists in neither stage, for files that include each other in a circle, and for full arithmetic without
/// fragment highp.
[[nodiscard]] StageText assemble_stage(const ProgramDescription& description, Stage stage,
                                       std::span<const ShaderFile> files = shader_files());

/// Rewrites a driver's log so that the positions of Mesa ("0:20012(5): "), NVIDIA ("0(20012) : ") and glslang
/// ("ERROR: 0:20012: ") read as "surface/surface.frag:12".
[[nodiscard]] std::string translate_log(std::string_view log, const StageText& stage);

/// A linked program. Uniform locations are looked up once by name while preparing, never in a frame.
class Program {
public:
    struct Uniform {
        std::string name;  ///< without "[0]" and kHandedOn
        int location = -1;
        std::uint32_t type = 0;
        int size = 1;
        bool claimed = false;
    };

    [[nodiscard]] std::uint32_t name() const { return program_.name(); }
    [[nodiscard]] const ProgramDescription& description() const { return description_; }
    /// Location of a uniform the linked program really uses. Unknown: Mistake with the names that exist.
    int uniform(std::string_view uniform_name);
    /// Location, or -1 when this variant does not use it.
    int uniform_if_used(std::string_view uniform_name);
    /// Mistake when the program has an active uniform nobody asked for: it would silently stay 0.
    void expect_all_uniforms_claimed() const;
    [[nodiscard]] std::span<const Uniform> uniforms() const { return uniforms_; }

private:
    friend class ProgramCache;
    ProgramName program_;
    ProgramDescription description_;
    std::vector<Uniform> uniforms_;
};

/// Owns every program of a renderer, keyed by dialect + defines + text. Binaries go to disk where the driver allows,
/// keyed by the driver string too; a bad or foreign file is ignored and rewritten; a folder that cannot be written
/// costs one notice and nothing else.
class ProgramCache {
public:
    /// `folder` empty: nothing on disk. `caps` decides program_binary.
    /// `files`: what the programs are made of; another list than the built-in one must outlive the cache.
    ProgramCache(EntryPoints& gl, const Caps& caps, std::filesystem::path folder,
                 std::span<const ShaderFile> files = shader_files());

    /// The program, compiled and linked now if it is new. A shader that does not compile: Error(check) whose message
    /// names our file and line, the driver's words, and the variant.
    Program& get(const ProgramDescription& description);

    struct Statistics {
        int compiled = 0;      ///< programs compiled from text
        int from_disk = 0;     ///< programs that came back from a binary
        int shared = 0;        ///< get() calls answered from memory
        int disk_ignored = 0;  ///< files present but unusable
    };
    [[nodiscard]] const Statistics& statistics() const { return statistics_; }
    /// One-sentence notices for the user ("the program cache folder X cannot be written: ..."), each once.
    [[nodiscard]] const std::vector<std::string>& notices() const { return notices_; }
    [[nodiscard]] std::vector<const Program*> programs() const;  ///< in the order they were made

private:
    bool compile(Program& program, const StageText& vertex, const StageText& fragment);
    Program* find_or_make(const ProgramDescription& description);
    bool load_binary(Program& program, const std::string& key);
    void save_binary(const Program& program, const std::string& key);
    [[nodiscard]] std::filesystem::path binary_path(const std::string& key) const;
    void notice(const std::string& sentence);

    EntryPoints& gl_;
    const Caps& caps_;
    std::filesystem::path folder_;
    std::span<const ShaderFile> files_;
    std::string driver_;  ///< vendor, renderer and version: binaries of another driver mean nothing
    std::vector<std::unique_ptr<Program>> programs_;
    std::map<std::string, Program*> by_key_;
    Statistics statistics_;
    std::vector<std::string> notices_;
};

}  // namespace halfframe::gl
