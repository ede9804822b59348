// Device masks: "native", the built-in files in content/devices, or a file of the user's.
#include "content/content.h"

#include <array>

#include "content/data_lookup.h"

namespace halfframe::content {
namespace {

constexpr const char* kNative = "native";
constexpr const char* kAdvice = "content/README.md shows a device file";

/// Every limit, by its key. Highest: far above any machine, so that a slip of the keyboard shows.
struct Limit {
    const char* key;
    std::optional<int> gl::DeviceProfile::*field;
    std::uint64_t lowest;
};
constexpr std::uint64_t kHighestLimit = 1u << 20;
constexpr std::uint64_t kHighestBytes = std::uint64_t{1} << 40;
constexpr std::array<Limit, 13> kLimits{{
    {"max_texture_size", &gl::DeviceProfile::max_texture_size, 1},
    {"max_cube_map_size", &gl::DeviceProfile::max_cube_map_size, 1},
    {"max_renderbuffer_size", &gl::DeviceProfile::max_renderbuffer_size, 1},
    {"max_vertex_attributes", &gl::DeviceProfile::max_vertex_attributes, 1},
    {"max_vertex_uniform_vectors", &gl::DeviceProfile::max_vertex_uniform_vectors, 1},
    {"max_fragment_uniform_vectors", &gl::DeviceProfile::max_fragment_uniform_vectors, 1},
    {"max_varying_vectors", &gl::DeviceProfile::max_varying_vectors, 1},
    {"max_fragment_samplers", &gl::DeviceProfile::max_fragment_samplers, 0},
    {"max_vertex_samplers", &gl::DeviceProfile::max_vertex_samplers, 0},
    {"max_combined_samplers", &gl::DeviceProfile::max_combined_samplers, 0},
    {"max_draw_buffers", &gl::DeviceProfile::max_draw_buffers, 1},
    {"max_samples", &gl::DeviceProfile::max_samples, 0},
    {"max_texture_3d_size", &gl::DeviceProfile::max_texture_3d_size, 0},
}};

int es_version_at(const JsonPlace& place) {
    const std::uint64_t version = place.whole();
    if (version != 20 && version != 30 && version != 31 && version != 32) {
        place.fail("must be 20, 30, 31 or 32");
    }
    return static_cast<int>(version);
}

gl::DeviceProfile profile_from(const JsonPlace& root) {
    root.expect_only({"name",
                      "source",
                      "es_version",
                      "fragment_highp",
                      "extensions",
                      "max_texture_size",
                      "max_cube_map_size",
                      "max_renderbuffer_size",
                      "max_vertex_attributes",
                      "max_vertex_uniform_vectors",
                      "max_fragment_uniform_vectors",
                      "max_varying_vectors",
                      "max_fragment_samplers",
                      "max_vertex_samplers",
                      "max_combined_samplers",
                      "max_draw_buffers",
                      "max_samples",
                      "max_texture_3d_size",
                      "max_texture_bytes",
                      "prefers_s3tc"});
    gl::DeviceProfile profile;
    profile.name = root.at("name").text();
    profile.source = root.at("source").text();
    profile.es_version = es_version_at(root.at("es_version"));
    if (root.has("fragment_highp")) {
        profile.fragment_highp = root.at("fragment_highp").boolean();
    }
    if (root.has("extensions")) {
        const JsonPlace list = root.at("extensions");
        profile.extensions.emplace();
        for (std::size_t i = 0; i < list.size(); ++i) {
            const std::string& extension = list.at(i).text();
            if (!extension.starts_with("GL_")) {
                list.at(i).fail("'" + extension + "' does not start with GL_");
            }
            profile.extensions->push_back(extension);
        }
    }
    if (root.has("max_texture_bytes")) {
        profile.max_texture_bytes = root.at("max_texture_bytes").whole(1, kHighestBytes);
    }
    if (root.has("prefers_s3tc")) {
        profile.prefers_s3tc = root.at("prefers_s3tc").boolean();
    }
    for (const Limit& limit : kLimits) {
        if (root.has(limit.key)) {
            profile.*limit.field = static_cast<int>(root.at(limit.key).whole(limit.lowest, kHighestLimit));
        }
    }
    return profile;
}

}  // namespace

std::vector<std::string> device_profile_names() {
    std::vector<std::string> names = data_names("devices");
    names.insert(names.begin(), kNative);
    return names;
}

gl::DeviceProfile device_profile(const std::string& name_or_path) {
    if (name_or_path == kNative) {
        gl::DeviceProfile native;
        native.name = kNative;
        native.source = "the machine as it is";
        native.es_version = 32;  // the highest there is: a mask only takes away
        return native;
    }
    const DataDocument document = open_data("devices", name_or_path, {kNative}, kAdvice);
    return profile_from({document.json, document.source});
}

}  // namespace halfframe::content
