// Counting one view of a scene or many: every camera, several tiers, several processes.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/frame/budget.h"
#include "perf/cli/counting_device.h"
#include "perf/cli/scene_options.h"
#include "perf/cost/frame_cost.h"
#include "perf/report/budget_table.h"

namespace halfframe::cli {

struct CostRequest {
    std::string input;
    SceneOptions options;
    std::vector<cost::Profile> profiles;
    gl::Arithmetic arithmetic = gl::Arithmetic::half;
    std::function<void(const std::string&)> between;  ///< hears a word for the user, and throws to stop
};

/// One of the views that were asked for.
struct CostView {
    std::string camera;              ///< empty: that of the options
    std::vector<std::string> tiers;  ///< as --tier takes them
};

/// Opens the scene once; counts views of it one after the other on one context.
class ViewCounter {
public:
    explicit ViewCounter(CostRequest request);

    /// Cameras of the scene; one empty name where it has none.
    [[nodiscard]] std::vector<std::string> cameras() const;
    /// What the view's frame is, without its shaders' counts; the library holds these.
    [[nodiscard]] cost::CountedFrame counted(const CostView& view);
    [[nodiscard]] cost::FrameCost cost_of(const CostView& view);
    [[nodiscard]] cost::ShaderLibrary& library() { return library_; }
    /// Who hears a word for the user from now on.
    void between(std::function<void(const std::string&)> hears) { request_.between = std::move(hears); }

private:
    void look(const CostView& view);

    CostRequest request_;
    CountingDevice device_;
    OpenedScene opened_;
    cost::ShaderLibrary library_;
};

/// Shaders compiled by this very build are found again in `cache`; empty: nowhere.
[[nodiscard]] cost::ShaderLibrary kept_library(const std::filesystem::path& cache);

/// `budget` held against a cost; nothing for none.
[[nodiscard]] std::optional<perf::BudgetTable> judged(const cost::FrameCost& cost, const std::optional<Budget>& budget);

/// A part of a list: every `of`th, from `part` on, from 1.
struct Part {
    int part = 1;
    int of = 1;
    [[nodiscard]] bool takes(std::size_t index) const {
        return index % static_cast<std::size_t>(of) == static_cast<std::size_t>(part - 1);
    }
};
/// "2/3"; anything else: Error(usage).
[[nodiscard]] Part parse_part(const std::string& words);

/// Standard output of several children of this program at once, in order. The first that fails: its error, with its
/// fault. A budget that a child found exceeded (1, with output) is no failure: `exceeded` says so.
struct ChildOutputs {
    std::vector<std::string> outputs;
    std::string errors;  ///< what all of them told the user
    bool exceeded = false;
};
[[nodiscard]] ChildOutputs outputs_of_own(const std::vector<std::vector<std::string>>& arguments,
                                          const std::function<void(const std::string&)>& between);

}  // namespace halfframe::cli
