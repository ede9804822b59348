// What a user's shader costs, in the three precisions, for people and machines.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "perf/cost/model.h"
#include "perf/cost/user_shader.h"

namespace halfframe::cost {

struct UserShaderRequest {
    std::string file;
    std::string text;
    std::vector<Profile> profiles;
    std::vector<UserTexture> textures;
    TargetWork target;
};

/// One precision: the counts, and a cost for each profile.
struct UserShaderVariant {
    Precisions precisions = Precisions::as_written;
    CountedStage stage;
    PassWork work;
    std::vector<PassCost> costs;
};

struct UserShaderCost {
    std::string file;
    TargetWork target;
    std::vector<Profile> profiles;
    std::vector<UserShaderVariant> variants;
    std::string compiler;
};

[[nodiscard]] UserShaderCost user_shader_cost(const UserShaderRequest& request);
[[nodiscard]] std::string user_shader_text(const UserShaderCost& cost);
[[nodiscard]] std::string user_shader_listing(const UserShaderCost& cost, const std::string& text);
[[nodiscard]] std::string user_shader_csv(const UserShaderCost& cost);
[[nodiscard]] nlohmann::ordered_json user_shader_json(const UserShaderCost& cost);

}  // namespace halfframe::cost
