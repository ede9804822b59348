// halfframe_load_bench: what loading a glTF file costs beside decoding its images and reading its buffers, what
// bringing it to the device costs, and how time and memory grow with size. Prints medians and ratios, judges nothing,
// is no test.
//
// Files are those named, or made by the exporter in a folder of its own, so they are in the page cache. Loads and bare reads take
// turns. Times are those of the process, whatever else the machine does. Memory is what the process held at most above
// what it held before, in a child that loads once.
#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <stb/stb_image.h>
#include <stb/stb_image_write.h>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "content/content.h"
#include "engine/error.h"
#include "engine/frame/frame_plan.h"
#include "engine/frame/renderer.h"
#include "perf/report/text_table.h"
#include "platform/context.h"

namespace halfframe::bench {
namespace {

namespace fs = std::filesystem;

double process_ms() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

constexpr double kMiB = 1048576.0;

double median(std::vector<double> values) {
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
    return values[values.size() / 2];
}

/// The least that any loader does: the file's bytes, each buffer view copied once, each image decoded to RGBA.
std::size_t read_bare(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::string bytes(fs::file_size(file), '\0');
    stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    std::uint32_t json_bytes = 0;
    std::memcpy(&json_bytes, &bytes[12], sizeof json_bytes);
    const auto document = nlohmann::json::parse(bytes.substr(20, json_bytes));
    const char* binary = &bytes[20 + json_bytes + 8];
    std::size_t sum = 0;
    std::vector<bool> is_image(document["bufferViews"].size());
    for (const auto& image : document.value("images", nlohmann::json::array())) {
        int width = 0, height = 0, channels = 0;
        stbi_uc* pixels = nullptr;
        if (image.contains("uri")) {
            const fs::path beside = file.parent_path() / image["uri"].get<std::string>();
            pixels = stbi_load(beside.c_str(), &width, &height, &channels, 4);
        } else {
            const std::size_t index = image["bufferView"];
            is_image[index] = true;
            const auto& view = document["bufferViews"][index];
            pixels =
                stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(binary + view.value("byteOffset", std::size_t{0})),
                                      view["byteLength"].get<int>(), &width, &height, &channels, 4);
        }
        if (pixels == nullptr) continue;
        sum += static_cast<std::size_t>(pixels[0]) + static_cast<std::size_t>(width);
        stbi_image_free(pixels);
    }
    for (std::size_t i = 0; i < is_image.size(); ++i) {
        if (is_image[i]) continue;
        const auto& view = document["bufferViews"][i];
        const char* start = binary + view.value("byteOffset", std::size_t{0});
        const std::vector<char> copy(start, start + view["byteLength"].get<std::size_t>());
        sum += copy.empty() ? 0u : static_cast<unsigned char>(copy.front());
    }
    return sum;
}

/// A line of /proc/self/status [KiB].
long status_kib(const std::string& key) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        if (line.starts_with(key)) return std::atol(line.c_str() + key.size() + 1);
    }
    return 0;
}

/// Most memory above that before, while a child loads the file [MiB]; not a number where it cannot be told.
double peak_mib(const fs::path& file) {
    int ends[2];
    if (pipe(ends) != 0) return std::nan("");
    const pid_t child = fork();
    if (child == 0) {
        malloc_trim(0);                                 // what the parent has freed is not there to be used again
        std::ofstream("/proc/self/clear_refs") << "5";  // the high-water mark begins anew
        const long before = status_kib("VmRSS:");
        const Scene scene = content::load_gltf(file);
        const double peak = static_cast<double>(status_kib("VmHWM:") - before) / 1024.0;
        const bool written = write(ends[1], &peak, sizeof peak) == sizeof peak;
        _exit(written ? 0 : 1);
    }
    close(ends[1]);
    double peak = std::nan("");
    const bool is_read = read(ends[0], &peak, sizeof peak) == sizeof peak;
    close(ends[0]);
    if (child > 0) waitpid(child, nullptr, 0);
    return is_read ? peak : std::nan("");
}

/// A plane of side x side vertices, wavy so that nothing of it is the same.
Mesh wavy(int side) {
    Mesh mesh;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const glm::vec2 at(static_cast<float>(x) / static_cast<float>(side),
                               static_cast<float>(y) / static_cast<float>(side));
            mesh.positions.emplace_back(at.x, 0.05f * std::sin(20.0f * at.x) * std::cos(17.0f * at.y), at.y);
            mesh.normals.push_back(glm::normalize(glm::vec3(0.1f * std::sin(9.0f * at.x), 1.0f, 0.0f)));
            mesh.tangents.emplace_back(1.0f, 0.0f, 0.0f, 1.0f);
            mesh.uv.push_back(at);
            if (x + 1 == side || y + 1 == side) continue;
            const auto here = static_cast<std::uint32_t>(y * side + x), below = here + static_cast<std::uint32_t>(side);
            mesh.indices.insert(mesh.indices.end(), {here, below, here + 1, here + 1, below, below + 1});
        }
    }
    return mesh;
}

/// Patches of colour with a little noise: a PNG of it is half as large as its texels.
Image picture(int side, std::uint32_t seed) {
    Image image{.name = fmt::format("picture {}", seed), .width = side, .height = side, .srgb = true, .rgba = {}};
    image.rgba.resize(static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * 4);
    std::uint32_t state = seed * 2654435761u + 1;
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
        state = state * 1664525u + 1013904223u;
        const auto place = static_cast<std::uint32_t>(i / 256);
        image.rgba[i] = i % 4 == 3 ? 255 : static_cast<std::uint8_t>((place * 37u + seed * 11u) % 200u + (state >> 28));
    }
    return image;
}

Scene of_vertices(int side) {
    Scene scene;
    scene.name = "vertices";
    scene.meshes = {wavy(side)};
    scene.materials = {Material{}};
    scene.surfaces = {{.name = "plane"}};
    return scene;
}

Scene of_images(int side, int count) {
    Scene scene = of_vertices(8);
    scene.materials.clear();
    scene.surfaces.clear();
    for (int i = 0; i < count; ++i) {
        scene.images.push_back(picture(side, static_cast<std::uint32_t>(i)));
        Material material;
        material.base_color_texture.image = i;
        scene.materials.push_back(material);
        scene.surfaces.push_back({.name = fmt::format("plane {}", i), .material = i});
    }
    return scene;
}

/// `glb` with its images, which the exporter does not compress, as compressed PNG files beside it.
std::string with_compressed_images(const std::string& glb, const Scene& scene, const fs::path& folder) {
    if (scene.images.empty()) return glb;
    std::uint32_t json_bytes = 0;
    std::memcpy(&json_bytes, &glb[12], sizeof json_bytes);
    auto document = nlohmann::json::parse(glb.substr(20, json_bytes));
    std::vector<std::size_t> views;
    for (auto& image : document["images"]) {
        views.push_back(image["bufferView"]);
        const Image& source = scene.images.at(views.size() - 1);  // the exporter keeps the order of first use
        const std::string name = fmt::format("image{}.png", views.size() - 1);
        stbi_write_png((folder / name).c_str(), source.width, source.height, 4, source.rgba.data(), 4 * source.width);
        image = {{"uri", name}};
    }
    // The chunk without them; a view of four zeros stands where one was.
    const std::size_t start = 20 + json_bytes + 8;
    std::string binary;
    for (std::size_t i = 0; i < document["bufferViews"].size(); ++i) {
        auto& view = document["bufferViews"][i];
        const std::string bytes =
            glb.substr(start + view["byteOffset"].get<std::size_t>(), view["byteLength"].get<std::size_t>());
        view["byteOffset"] = binary.size();
        if (std::ranges::find(views, i) != views.end()) view["byteLength"] = 4;
        binary += std::ranges::find(views, i) != views.end() ? std::string(4, '\0') : bytes;
        binary.resize((binary.size() + 3) / 4 * 4, '\0');
    }
    document["buffers"][0]["byteLength"] = binary.size();
    std::string text = document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const auto word = [](std::size_t value) {
        const auto narrow = static_cast<std::uint32_t>(value);
        return std::string(reinterpret_cast<const char*>(&narrow), 4);
    };
    return "glTF" + word(2) + word(28 + text.size() + binary.size()) + word(text.size()) + "JSON" + text +
           word(binary.size()) + std::string("BIN\0", 4) + binary;
}

Scene of_nodes(int count) {
    Scene scene = of_vertices(8);
    scene.surfaces.assign(static_cast<std::size_t>(count), scene.surfaces.front());
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i)
        scene.surfaces[i].world_from_local[3] = glm::vec4(static_cast<float>(i), 0.0f, 0.0f, 1.0f);
    return scene;
}

/// As many meshes, surfaces and materials, each its own; in a field, so that none hides another.
Scene of_meshes(int count) {
    Scene scene;
    scene.name = "meshes";
    const int side = static_cast<int>(std::ceil(std::sqrt(count)));
    for (int i = 0; i < count; ++i) {
        const glm::vec3 at(static_cast<float>(i % side), 0.0f, static_cast<float>(i / side));
        Mesh mesh{.name = fmt::format("triangle {}", i),
                  .positions = {at, at + glm::vec3(0.0f, 0.0f, 0.7f), at + glm::vec3(0.7f, 0.0f, 0.0f)}};
        mesh.normals.assign(3, glm::vec3(0.0f, 1.0f, 0.0f));
        scene.meshes.push_back(std::move(mesh));
        Material material;
        material.name = fmt::format("material {}", i);
        material.roughness = 0.2f + 0.7f * static_cast<float>(i) / static_cast<float>(count);
        scene.materials.push_back(material);
        scene.surfaces.push_back({.name = fmt::format("surface {}", i), .mesh = i, .material = i});
    }
    return scene;
}

/// Plan, upload, programs: all between a loaded scene and its first frame.
double prepare_ms(Scene scene) {
    const platform::Context context = platform::Context::create({});
    gl::EntryPoints gl(context.loader());
    const gl::Caps caps = gl::read_caps(gl);
    content::add_studio_rig(scene);
    const View view = view_of(camera_framing(world_box(scene), 1.0f), 64, 64);
    Renderer renderer(gl, caps);
    const double start = process_ms();
    renderer.prepare(scene, plan_frame(scene, view, Wishes{}, caps, all_effects()));
    return process_ms() - start;
}

void add_row(perf::TextTable& table, const fs::path& file, const std::string& name, double mib, int rounds) {
    const double memory = peak_mib(file);
    std::vector<double> load_ms, bare_ms;
    std::size_t kept = 0;  // so that nothing is optimised away
    for (int round = 0; round < rounds; ++round) {
        double start = process_ms();
        kept += content::load_gltf(file).surfaces.size();
        load_ms.push_back(process_ms() - start);
        start = process_ms();
        kept += read_bare(file);
        bare_ms.push_back(process_ms() - start);
    }
    const double prepare = prepare_ms(content::load_gltf(file));
    const double load = median(load_ms), bare = median(bare_ms);
    table.add_row({kept > 0 ? name : name + " (nothing)", fmt::format("{:.1f}", mib),
                   fmt::format("{:.2f}", load), fmt::format("{:.2f}", bare), fmt::format("{:.2f}", load / bare),
                   fmt::format("{:.0f}", memory), fmt::format("{:.0f}", prepare)});
}

void add_row(perf::TextTable& table, const fs::path& folder, const std::string& name, const Scene& scene, int rounds) {
    const fs::path file = folder / "file.glb";
    const std::string bytes = with_compressed_images(content::gltf_binary(scene), scene, folder);
    std::ofstream(file, std::ios::binary) << bytes;
    double mib = 0.0;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        mib += static_cast<double>(entry.file_size()) / kMiB;
    add_row(table, file, name, mib, rounds);
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) fs::remove(entry.path());
}

perf::TextTable headings() {
    using perf::Align;
    return perf::TextTable({{"a file of", Align::left},
                            {"MiB", Align::right},
                            {"load ms", Align::right},
                            {"bare ms", Align::right},
                            {"ratio", Align::right},
                            {"peak MiB", Align::right},
                            {"prepare ms", Align::right}});
}

void print(const perf::TextTable& table, int rounds) {
    fmt::print(
        "medians of {} loads; bare: the file read, its JSON parsed, its images decoded, its buffers copied; "
        "prepare: once, until the first frame\n\n{}\n",
        rounds, table.text());
}

void run_files(const std::vector<std::string>& files, int rounds) {
    perf::TextTable table = headings();
    for (const std::string& file : files) {
        std::string magic(4, '\0');
        std::ifstream(file, std::ios::binary).read(magic.data(), 4);
        if (magic != "glTF") throw Error(Fault::input, file + ": this is no GLB file; give .glb files");
        add_row(table, file, fs::path(file).filename().string(), static_cast<double>(fs::file_size(file)) / kMiB, rounds);
    }
    print(table, rounds);
}

void run(int rounds, bool small) {
    const fs::path folder = fs::temp_directory_path() / fmt::format("halfframe_load_bench_{}", getpid());
    fs::create_directories(folder);
    perf::TextTable table = headings();
    const int less = small ? 8 : 1;
    for (const int side : {512, 1024, 2048}) {
        const int here = side / less;
        add_row(table, folder, fmt::format("8 images of {0} x {0}", here), of_images(here, 8), rounds);
    }
    for (const int side : {256, 512, 1024}) {
        const int here = side / less;
        add_row(table, folder, fmt::format("{} vertices", here * here), of_vertices(here), rounds);
    }
    for (const int count : {1000, 10000, 50000, 120000})
        add_row(table, folder, fmt::format("{} nodes", count / less), of_nodes(count / less), rounds);
    for (const int count : {1000, 10000, 50000})
        add_row(table, folder, fmt::format("{} meshes and materials", count / less), of_meshes(count / less), rounds);
    if (!small) {
        Scene street = content::open_scene("street");
        street.environment.reset();  // made anew at every load: 32 texels a side, as long whatever the file
        add_row(table, folder, "the built-in street, without surroundings", street, rounds);
    }
    fs::remove_all(folder);
    print(table, rounds);
}

}  // namespace
}  // namespace halfframe::bench

int main(int argc, char** argv) {
    int rounds = 5;
    bool small = false;
    CLI::App app{"What loading a glTF file costs, and how that grows with its size"};
    app.add_option("--rounds", rounds, "Loads of every file")->check(CLI::Range(1, 1000));
    app.add_flag("--small", small, "Everything an eighth as large, and no street");
    std::vector<std::string> files;
    app.add_option("FILE.glb", files, "These files, and not those made here")->check(CLI::ExistingFile);
    CLI11_PARSE(app, argc, argv);
    try {
        if (files.empty()) halfframe::bench::run(rounds, small);
        else halfframe::bench::run_files(files, rounds);
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "halfframe_load_bench: {}\n", error.what());
        return 1;
    }
}
