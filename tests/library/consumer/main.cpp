// A program of somebody else: its own EGL context, its own scene in memory, halfframe to draw it.
// Prints what it drew; exit code 1 when the picture is not what the scene says.
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include "content/content.h"
#include "engine/frame/renderer.h"
#include "engine/gl/entry_points.h"

using namespace halfframe;

namespace {

constexpr int kSize = 64;  // pixels

/// A current ES 3 context without a window, by plain EGL calls.
class OwnContext {
public:
    OwnContext() {
        display_ = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        require(eglInitialize(display_, nullptr, nullptr), "eglInitialize");
        require(eglBindAPI(EGL_OPENGL_ES_API), "eglBindAPI");
        const EGLint wish[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        require(eglChooseConfig(display_, wish, &config, 1, &count) && count > 0, "eglChooseConfig");
        const EGLint attributes[] = {EGL_CONTEXT_CLIENT_VERSION, 3, EGL_NONE};
        context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, attributes);
        require(eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_), "eglMakeCurrent");
    }
    ~OwnContext() {
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display_, context_);
        // The display stays until exit: ending it unloads the driver, and a leak checker can then no longer tell the
        // driver's leaks from ours.
    }
    OwnContext(const OwnContext&) = delete;
    OwnContext& operator=(const OwnContext&) = delete;

private:
    static void require(bool holds, const char* call) {
        if (!holds) throw std::runtime_error(std::string(call) + " failed");
    }
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

/// Two triangles: a square of 1 m, facing +Z, in a bright sun and before a dark background.
Scene square_of_two_triangles() {
    Scene scene;
    scene.name = "square";
    Mesh mesh;
    mesh.name = "square";
    mesh.positions = {{-0.5f, -0.5f, 0}, {0.5f, -0.5f, 0}, {0.5f, 0.5f, 0}, {-0.5f, 0.5f, 0}};
    mesh.normals.assign(4, {0, 0, 1});
    mesh.indices = {0, 1, 2, 0, 2, 3};
    scene.meshes.push_back(mesh);
    Material material;
    material.name = "chalk";
    material.metallic = 0.0f;
    scene.materials.push_back(material);
    scene.surfaces.push_back({.name = "square", .mesh = 0, .material = 0});
    scene.lights.push_back({.kind = LightKind::sun, .name = "sun", .color = {1, 1, 1}, .direction = {0, 0, -1}});
    scene.background = {0, 0, 0};
    return scene;
}

/// Straight from the front, 2 m high and wide: the square is the middle quarter of the picture.
View front_view() {
    Camera camera;
    camera.orthographic = true;
    camera.half_height_m = 1.0f;
    camera.world_from_view[3] = {0, 0, 2, 1};  // 2 m towards the viewer
    return view_of(camera, kSize, kSize);
}

/// Draws the square and counts the lit pixels; the right number is exactly a quarter of all.
bool draw_square(gl::EntryPoints& entry_points, const gl::Caps& caps) {
    const Scene scene = square_of_two_triangles();
    const View view = front_view();
    const FramePlan plan = plan_frame(scene, view, {}, caps, all_effects());
    Renderer renderer(entry_points, caps);
    renderer.prepare(scene, plan);
    renderer.draw(view);
    const Picture picture = renderer.read_display();
    const std::string error = renderer.first_gl_error();

    int lit = 0;
    for (std::size_t pixel = 0; pixel < picture.rgba.size(); pixel += 4) lit += picture.rgba[pixel] > 64 ? 1 : 0;
    std::printf("device %s, tier %s: %dx%d pixels, %d lit of %d expected, GL error '%s'\n", caps.device.c_str(),
                name(plan.tier), picture.width, picture.height, lit, kSize * kSize / 4, error.c_str());
    return picture.width == kSize && picture.height == kSize && lit == kSize * kSize / 4 && error.empty();
}

}  // namespace

int main() {
    try {
        const OwnContext context;
        const gl::Loader loader = [](const char* name) { return reinterpret_cast<void*>(eglGetProcAddress(name)); };
        bool right = true;
        {
            gl::EntryPoints entry_points(loader);
            const gl::Caps caps = gl::read_caps(entry_points);
            std::printf("%s, %s\n", caps.version.c_str(), caps.renderer.c_str());
            right = draw_square(entry_points, caps);
        }
        {
            // The same on the poorest device, from the data inside the content library.
            gl::EntryPoints entry_points(loader);
            const gl::Caps caps = gl::masked(gl::read_caps(entry_points), content::device_profile("es2-minimum"));
            entry_points.restrict_to(caps);
            right = draw_square(entry_points, caps) && right;
        }
        std::printf(right ? "the pictures are right\n" : "a picture is wrong\n");
        return right ? EXIT_SUCCESS : EXIT_FAILURE;
    } catch (const std::exception& error) {
        std::printf("%s\n", error.what());
        return EXIT_FAILURE;
    }
}
