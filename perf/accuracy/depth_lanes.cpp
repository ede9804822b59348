// The lanes of depth, and their drawing.
#include "perf/accuracy/depth_lanes.h"

#include <array>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "engine/error.h"
#include "engine/frame/camera_space.h"
#include "perf/accuracy/lane_canvas.h"

namespace halfframe::accuracy {
namespace {

constexpr int kSide = 64;  ///< [pixels]: each camera has a quarter of the rows
constexpr int kCameras = 4;
constexpr int kLanesEach = kSide * kSide / kCameras;

/// A surface that is turned and stands away from the origin, as surfaces do.
glm::mat4 world_from_local() {
    return glm::rotate(glm::translate(glm::mat4(1.0f), {3.0f, -1.5f, 7.25f}), 0.7f,
                       glm::normalize(glm::vec3(1.0f, 2.0f, 0.5f)));
}

Camera camera_of(int number) {
    Camera camera = camera_looking({12.0f, 4.5f, -6.0f}, {3.0f, 1.0f, 8.0f}, 0.9f, Box{});
    constexpr float kNear_m[kCameras]{0.1f, 0.05f, 1.0f, 0.1f}, kFar_m[kCameras]{100.0f, 1000.0f, 10000.0f, 100.0f};
    camera.near_m = kNear_m[number];
    camera.far_m = kFar_m[number];
    camera.orthographic = number == 3;
    camera.half_height_m = 5.0f;
    return camera;
}

/// Local place that a pixel's point (x, y in pixels) shows at a distance, before it is rounded.
glm::dvec3 place(const Camera& camera, double x, double y, double along_m) {
    const double half_height = camera.orthographic ? static_cast<double>(camera.half_height_m)
                                                   : along_m * std::tan(0.5 * static_cast<double>(camera.fov_y_rad));
    const glm::dvec4 in_view((2.0 * x / kSide - 1.0) * half_height, (2.0 * y / kSide - 1.0) * half_height, -along_m,
                             1.0);
    return glm::dvec3(glm::inverse(glm::dmat4(world_from_local())) * (glm::dmat4(camera.world_from_view) * in_view));
}

double along_of(const Camera& camera, int lane) {
    const double near_m = camera.near_m, far_m = camera.far_m;
    const double inside = 0.001 + 0.998 * (lane % kLanesEach) / (kLanesEach - 1.0);  // the ends would be clipped
    return near_m * std::pow(far_m / near_m, inside);
}

glm::mat4 clip_from_local_of(const Camera& camera) {
    const ViewSpace space = view_space(view_of(camera, kSide, kSide));
    return clip_from_stored(space, eye_from_stored(space, world_from_local(), StoredPositions{}));
}

/// Three corners inside the pixel for every lane, or its centre.
std::vector<glm::vec3> places(bool as_triangles) {
    constexpr std::array<glm::dvec2, 3> kCorners{{{-0.4, -0.4}, {0.4, -0.4}, {0.0, 0.4}}};
    std::vector<glm::vec3> all;
    for (int lane = 0; lane < kCameras * kLanesEach; ++lane) {
        const Camera camera = camera_of(lane / kLanesEach);
        const double x = lane % kSide + 0.5, y = lane / kSide + 0.5;
        const double along_m = along_of(camera, lane);
        if (!as_triangles) all.emplace_back(place(camera, x, y, along_m));
        else
            for (const glm::dvec2& corner : kCorners)
                all.emplace_back(place(camera, x + corner.x, y + corner.y, along_m));
    }
    return all;
}

/// Keeps what the rasteriser says of a pixel.
constexpr const char* kDepthHere = "void main() { fragment_color = vec4(gl_FragCoord.z, 0.0, 0.0, 1.0); }\n";
constexpr const char* kDepthStored =
    "uniform highp sampler2D depth;\n"
    "void main() { fragment_color = vec4(texelFetch(depth, ivec2(gl_FragCoord.xy), 0).r, 0.0, 0.0, 1.0); }\n";

std::vector<double> reds(const std::vector<float>& pixels) {
    std::vector<double> values;
    for (std::size_t i = 0; i < pixels.size(); i += 4) values.push_back(pixels[i]);
    return values;
}

std::vector<gl::ShaderFile> with_own(std::span<const gl::ShaderFile> files) {
    std::vector<gl::ShaderFile> all(files.begin(), files.end());
    all.push_back({"<depth here>", kDepthHere});
    all.push_back({"<depth stored>", kDepthStored});
    return all;
}

}  // namespace

std::vector<Argument> depth_arguments() {
    std::vector<Argument> arguments{{"position", shader_ir::Columns(3)}, {"clip_from_local", shader_ir::Columns(16)}};
    const std::vector<glm::vec3> positions = places(false);
    for (int lane = 0; lane < static_cast<int>(positions.size()); ++lane) {
        const glm::mat4 matrix = clip_from_local_of(camera_of(lane / kLanesEach));
        for (int s = 0; s < 3; ++s)
            arguments[0].values[static_cast<std::size_t>(s)].push_back(positions[static_cast<std::size_t>(lane)][s]);
        for (int s = 0; s < 16; ++s) arguments[1].values[static_cast<std::size_t>(s)].push_back(matrix[s / 4][s % 4]);
    }
    return arguments;
}

const std::vector<DepthTruth>& depth_truths() {
    static const std::vector<DepthTruth> all = [] {
        std::vector<DepthTruth> truths;
        for (const glm::vec3& position : places(false)) {
            const Camera camera = camera_of(static_cast<int>(truths.size()) / kLanesEach);
            const glm::dvec3 world(glm::dmat4(world_from_local()) * glm::dvec4(position, 1.0));
            const glm::dvec3 forward = -glm::normalize(glm::dvec3(camera.world_from_view[2]));
            truths.push_back({{camera.near_m, camera.far_m, camera.orthographic},
                              glm::dot(world - glm::dvec3(camera.world_from_view[3]), forward)});
        }
        return truths;
    }();
    return all;
}

gl::ProgramDescription description_of(DepthStage stage) {
    gl::ProgramDescription made;
    made.name = "depth";
    made.vertex = stage == DepthStage::prepass ? "depth_prepass/depth_prepass.vert" : "surface/surface.vert";
    made.fragment = "depth_prepass/depth_prepass.frag";
    made.defines = {{"TIER_CONSOLE", "1"}};
    if (stage == DepthStage::surface) made.defines.emplace_back("UNLIT", "1");
    made.attributes = LaneCanvas::attributes();
    return made;
}

DepthCanvas::DepthCanvas(gl::EntryPoints& gl, const gl::Caps& caps, std::span<const gl::ShaderFile> files)
    : gl_(gl), caps_(caps), files_(with_own(files)), programs_(gl, caps, {}, files_) {}

gl::Framebuffer DepthCanvas::draw(DepthStage stage, const char* fragment, const gl::Texture& color,
                                  const gl::Texture& depth) {
    gl::ProgramDescription description = description_of(stage);
    description.fragment = fragment;
    gl::Program& program = programs_.get(description);
    const std::vector<glm::vec3> corners = places(true);
    const gl::Buffer buffer = gl::create<gl::Kind::buffer>(gl_);
    gl_.BindBuffer(GL_ARRAY_BUFFER, buffer.name());
    gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners.size() * sizeof(glm::vec3)), corners.data(),
                   GL_STATIC_DRAW);
    gl_.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    gl::Framebuffer framebuffer = gl::create<gl::Kind::framebuffer>(gl_);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color.name(), 0);
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth.name(), 0);
    if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw Error(Fault::context, "a target with depth as a texture cannot be drawn to; try another --context");
    gl_.Viewport(0, 0, kSide, kSide);
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DepthMask(GL_TRUE);
    gl_.DepthFunc(GL_ALWAYS);  // one triangle a pixel
    gl_.ClearDepthf(1.0f);
    gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl_.UseProgram(program.name());
    for (int camera = 0; camera < kCameras; ++camera) {
        const glm::mat4 matrix = clip_from_local_of(camera_of(camera));
        gl_.UniformMatrix4fv(program.uniform("clip_from_local"), 1, GL_FALSE, &matrix[0][0]);
        gl_.DrawArrays(GL_TRIANGLES, camera * kLanesEach * 3, kLanesEach * 3);
    }
    gl_.Disable(GL_DEPTH_TEST);
    return framebuffer;
}

std::vector<double> DepthCanvas::rasterised(DepthStage stage) {
    LaneCanvas canvas(gl_, caps_, kSide * kSide);
    const gl::Texture color = canvas.target(gl::PixelFormat::rgba32f);
    const gl::Texture depth = canvas.target(gl::PixelFormat::depth16);
    const gl::Framebuffer drawn = draw(stage, "<depth here>", color, depth);
    return reds(canvas.read());
}

std::vector<double> DepthCanvas::stored(DepthStage stage, gl::PixelFormat format) {
    const auto drawn = [&] {
        LaneCanvas canvas(gl_, caps_, kSide * kSide);
        const gl::Texture color = canvas.target(gl::PixelFormat::rgba8);
        gl::Texture depth = canvas.target(format);
        const gl::Framebuffer framebuffer = draw(stage, "depth_prepass/depth_prepass.frag", color, depth);
        return depth;
    };
    const gl::Texture depth = drawn();
    LaneCanvas canvas(gl_, caps_, kSide * kSide);
    gl::ProgramDescription reading;
    reading.name = "depth stored";
    reading.vertex = "tone_map/tone_map.vert";
    reading.fragment = "<depth stored>";
    reading.attributes = LaneCanvas::attributes();
    gl::Program& program = programs_.get(reading);
    const gl::Texture target = canvas.target(gl::PixelFormat::rgba32f);
    gl_.UseProgram(program.name());
    gl_.Uniform1i(program.uniform("depth"), 0);
    gl_.BindTexture(GL_TEXTURE_2D, depth.name());
    canvas.draw_to(target);
    return reds(canvas.read());
}

}  // namespace halfframe::accuracy
