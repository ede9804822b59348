// Accessors, views and the two chunks of a GLB (glTF 2.0, section 4).
#include "content/glb_writer.h"

#include <algorithm>

#include "engine/frame/scene.h"

namespace halfframe::content {

using nlohmann::json;

json array_of(const glm::mat4& matrix) {
    json array = json::array();
    for (int i = 0; i < 16; ++i) array.push_back(static_cast<double>(matrix[i / 4][i % 4]));
    return array;
}

GlbWriter::GlbWriter() : document({{"asset", {{"version", "2.0"}, {"generator", "halfframe"}}}}) {}

json& GlbWriter::extension(json& owner, const std::string& name) {
    used_.insert(name);
    return owner["extensions"][name];
}

std::size_t GlbWriter::append(const char* list, json entry) {
    json& entries = document[list];
    entries.push_back(std::move(entry));
    return entries.size() - 1;
}

std::size_t GlbWriter::add_view(const void* bytes, std::size_t count) {
    binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
    const std::size_t offset = binary_.size();
    binary_.append(static_cast<const char*>(bytes), count);
    return append("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", count}});
}

std::size_t GlbWriter::add_bounded(const std::vector<glm::vec3>& values) {
    const std::size_t index = add_accessor(values, kFloatComponents, "VEC3");
    Box box;
    for (const glm::vec3& value : values) box.add(value);
    document["accessors"][index]["min"] = array_of(box.low);
    document["accessors"][index]["max"] = array_of(box.high);
    return index;
}

std::size_t GlbWriter::add_shared(const std::vector<float>& values, const char* type, std::size_t components) {
    const auto [known, is_new] = shared_.try_emplace({type, values}, 0);
    if (!is_new) return known->second;
    const std::size_t index = add_accessor(values, kFloatComponents, type);
    json& accessor = document["accessors"][index];
    accessor["count"] = values.size() / components;
    if (components == 1) {  // times of keys must have bounds
        accessor["min"] = json::array({static_cast<double>(*std::ranges::min_element(values))});
        accessor["max"] = json::array({static_cast<double>(*std::ranges::max_element(values))});
    }
    return known->second = index;
}

std::string GlbWriter::bytes() {
    const auto append_u32 = [](std::string& bytes, std::size_t value) {
        for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>((value >> shift) & 0xFFu);
    };
    if (!used_.empty()) document["extensionsUsed"] = used_;
    binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
    if (!binary_.empty()) document["buffers"] = json::array({{{"byteLength", binary_.size()}}});
    std::string text = document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string result = "glTF";
    append_u32(result, 2);
    append_u32(result, 12 + 8 + text.size() + (binary_.empty() ? 0 : 8 + binary_.size()));
    append_u32(result, text.size());
    result += "JSON" + text;
    if (!binary_.empty()) {
        append_u32(result, binary_.size());
        result += std::string("BIN\0", 4) + binary_;
    }
    return result;
}

}  // namespace halfframe::content
