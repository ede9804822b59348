// A device as the cost model knows it: constants, each with its unit, its tag and its source.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace halfframe::cost {

/// Raised when a formula or a constant of a built-in profile changes: figures of two versions are not compared.
inline constexpr int kModelVersion = 1;

enum class ModelKind {
    rsx,    ///< pipes with two vec4 units and a texture unit, registers that cost threads
    xenos,  ///< unified units with vec4 and scalar issue, targets in EDRAM, resolves
    tiler,  ///< a phone that keeps a tile of the target on the chip
};
[[nodiscard]] const char* name(ModelKind kind);

struct ConstantValue {
    std::string key;
    double value = 0.0;
    std::string unit;
    std::string tag;  ///< S read in a public source, D arithmetic on such figures, M measured, A assumption
    std::string source;
};

struct Profile {
    std::string name;
    std::string device;
    ModelKind model = ModelKind::rsx;
    std::vector<ConstantValue> constants;  ///< exactly those of the model, in its order
    /// Mistake for a constant that the model does not have.
    [[nodiscard]] double at(std::string_view key) const;
};

/// "ps3", "x360", "es2_class", or the path of a .json file. Error(input) with the file, the place and the nearest
/// spelling: an unknown key, a constant that the model lacks or is missing, another unit, an empty source, a value out
/// of range, another model version.
[[nodiscard]] Profile load_profile(const std::string& name_or_path);

/// The three built-in ones: ps3, x360, es2_class.
[[nodiscard]] std::vector<Profile> built_in_profiles();

}  // namespace halfframe::cost
