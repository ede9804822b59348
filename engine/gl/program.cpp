// Uniforms of a linked program: asked for by name while preparing.
#include "engine/gl/program.h"

#include <algorithm>

#include "engine/error.h"

namespace halfframe::gl {
namespace {

std::string names_of(std::span<const Program::Uniform> uniforms) {
    std::string names;
    for (const Program::Uniform& uniform : uniforms) names += (names.empty() ? "" : ", ") + uniform.name;
    return names.empty() ? "none" : names;
}

}  // namespace

int Program::uniform(std::string_view uniform_name) {
    const int location = uniform_if_used(uniform_name);
    expect(location >= 0, [&] {
        return "program \"" + description_.name + "\" has no uniform \"" + std::string(uniform_name) +
               "\"; it has: " + names_of(uniforms_);
    });
    return location;
}

int Program::uniform_if_used(std::string_view uniform_name) {
    const auto found =
        std::find_if(uniforms_.begin(), uniforms_.end(), [&](const Uniform& one) { return one.name == uniform_name; });
    if (found == uniforms_.end()) return -1;
    found->claimed = true;
    return found->location;
}

void Program::expect_all_uniforms_claimed() const {
    std::vector<Uniform> unclaimed;
    std::copy_if(uniforms_.begin(), uniforms_.end(), std::back_inserter(unclaimed),
                 [](const Uniform& one) { return !one.claimed; });
    expect(unclaimed.empty(), [&] {
        return "nobody sets these uniforms of program \"" + description_.name +
               "\", they would stay 0: " + names_of(unclaimed);
    });
}

}  // namespace halfframe::gl
