// A GLB file in the making: its JSON, and the accessors and views of its binary chunk. Floats are written as they are.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

namespace halfframe::content {

template <typename Vector>
[[nodiscard]] nlohmann::json array_of(const Vector& value) {
    nlohmann::json array = nlohmann::json::array();
    for (int i = 0; i < Vector::length(); ++i) array.push_back(static_cast<double>(value[i]));
    return array;
}
[[nodiscard]] nlohmann::json array_of(const glm::mat4& matrix);

/// Component types of accessors (glTF 2.0, section 3.6.2.2).
inline constexpr int kFloatComponents = 5126, kUint32Components = 5125, kUint16Components = 5123;

class GlbWriter {
public:
    GlbWriter();

    nlohmann::json document;

    /// The object of an extension that `owner` uses; the file then says that it uses it.
    nlohmann::json& extension(nlohmann::json& owner, const std::string& name);
    /// Appends to document[list]; its place there.
    std::size_t append(const char* list, nlohmann::json entry);

    std::size_t add_view(const void* bytes, std::size_t count);
    template <typename T>
    std::size_t add_accessor(const std::vector<T>& values, int component_type, const char* type) {
        return append("accessors", {{"bufferView", add_view(values.data(), values.size() * sizeof(T))},
                                    {"componentType", component_type},
                                    {"type", type},
                                    {"count", values.size()}});
    }
    /// With the bounds that glTF asks for of positions and of their offsets.
    std::size_t add_bounded(const std::vector<glm::vec3>& values);
    /// `values` as elements of `type` with `components` each; equal ones are written once.
    std::size_t add_shared(const std::vector<float>& values, const char* type, std::size_t components);

    /// The file as it stands.
    [[nodiscard]] std::string bytes();

private:
    std::string binary_;
    std::set<std::string> used_;  ///< extensions
    std::map<std::pair<std::string, std::vector<float>>, std::size_t> shared_;
};

}  // namespace halfframe::content
