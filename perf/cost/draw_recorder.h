// Stands between the engine and a desktop GL context, and writes down every draw: fragments, vertices, textures, state.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/gl/entry_points.h"

namespace halfframe::cost {

struct RecordedTexture {
    std::string sampler;  ///< name of the uniform, without "[0]"
    std::uint32_t texture = 0;
    std::uint32_t internal_format = 0;
    bool trilinear = false;
    double texels = 0.0;  ///< of all levels and faces
};

struct RecordedDraw {
    std::string pass;
    std::uint32_t program = 0;         ///< 0: a copy between targets
    std::uint64_t samples_shaded = 0;  ///< that pass the depth test where no shader discards
    std::uint64_t samples_written = 0;
    std::uint64_t vertices = 0;     ///< submitted
    std::uint64_t transformed = 0;  ///< of these, not found in a cache of kVertexCache, first in first out
    std::uint64_t triangles = 0;
    bool blends = false;
    bool additive = false;  ///< source + destination
    bool writes_color = true;
    bool writes_depth = false;
    bool tests_depth = false;
    std::vector<RecordedTexture> textures;
};

/// Vertices that a post-transform cache holds: the RSX's.
inline constexpr int kVertexCache = 63;

/// One at a time on a thread. The context is a desktop one of at least GL 4.3, current while this lives.
class DrawRecorder {
public:
    explicit DrawRecorder(gl::Loader loader);
    ~DrawRecorder();
    DrawRecorder(const DrawRecorder&) = delete;
    DrawRecorder& operator=(const DrawRecorder&) = delete;

    /// What the engine loads its functions through.
    [[nodiscard]] gl::Loader loader() const;

    /// From now on draws are recorded, and counted by queries. `pass_name` is asked at each, `discards` once for each
    /// program: those that discard are drawn twice, first with a fragment stage that keeps everything.
    void start(std::function<std::string()> pass_name, std::function<bool(std::uint32_t program)> discards);
    /// Waits for the queries.
    [[nodiscard]] std::vector<RecordedDraw> finish();

    struct Functions;
    struct Hooks;

private:
    friend struct Hooks;
    class KeptDepth;
    struct Stages {
        std::map<std::uint32_t, std::string> source;                  ///< by shader
        std::map<std::uint32_t, std::vector<std::uint32_t>> shaders;  ///< by program
        std::map<std::uint32_t, std::vector<std::pair<std::uint32_t, std::string>>> attributes;
        std::map<std::uint32_t, std::uint32_t> stage;  ///< by shader: GL_VERTEX_SHADER or GL_FRAGMENT_SHADER
    };
    RecordedDraw& begin_draw(std::uint32_t mode, int count);
    void read_state(RecordedDraw& draw);
    void read_textures(RecordedDraw& draw);
    std::uint32_t count(const std::function<void()>& submit);  ///< name of the query
    void draw(RecordedDraw& draw, const std::function<void()>& submit);
    /// The same vertex stage with a fragment stage that writes nothing and keeps everything; 0: the program keeps all
    /// its fragments as it is.
    std::uint32_t keeping_program(std::uint32_t program);
    void copy_uniforms(std::uint32_t from, std::uint32_t to);
    void count_vertices(RecordedDraw& draw, int count, std::uint32_t index_type, std::uint64_t offset);

    gl::Loader loader_;
    std::unique_ptr<Functions> gl_;
    std::function<std::string()> pass_name_;
    std::function<bool(std::uint32_t)> discards_;
    bool recording_ = false;
    std::vector<RecordedDraw> draws_;
    struct Queries {
        std::uint32_t shaded = 0;
        std::uint32_t written = 0;
    };
    std::vector<Queries> queries_;
    Stages stages_;
    std::map<std::uint32_t, std::uint32_t> keeping_;
    std::map<std::uint32_t, std::vector<std::uint8_t>> indices_;  ///< by buffer
};

}  // namespace halfframe::cost
