// One context, one scene, many views; and several processes that share them out.
#include "perf/cli/cost_views.h"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <future>

#include <fmt/format.h>

#include "engine/error.h"
#include "perf/cli/cache_folder.h"
#include "perf/cli/scene_fit.h"
#include "perf/cost/cost_report.h"
#include "perf/process/child_process.h"

namespace halfframe::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kLongestChild_s = 86400.0;

fs::path own_program() {
    std::error_code unknown;
    const fs::path self = fs::read_symlink("/proc/self/exe", unknown);
    if (unknown)
        throw Error(Fault::environment, "/proc/self/exe cannot be read, so halfframe cannot run itself as a child");
    return self;
}

/// Tells one build from the next.
std::string build_stamp() {
    std::error_code unknown;
    const auto size = fs::file_size("/proc/self/exe", unknown);
    const auto time = fs::last_write_time("/proc/self/exe", unknown);
    return unknown ? std::string() : fmt::format("{} {}", size, time.time_since_epoch().count());
}

/// The sentence that a child ended with, without the name of the command.
std::string last_words(const process::ChildResult& result) {
    constexpr std::string_view kStart = "halfframe: ";
    std::string words = result.errors;
    if (const std::size_t at = words.rfind(kStart); at != std::string::npos) words.erase(0, at + kStart.size());
    while (words.ends_with('\n')) words.pop_back();
    return words.empty() ? result.story() : words;
}

}  // namespace

cost::ShaderLibrary kept_library(const fs::path& cache) {
    const std::string stamp = build_stamp();
    if (cache.empty() || stamp.empty()) return cost::ShaderLibrary();
    return cost::ShaderLibrary(shader_ir::StageCache(cache / "counting", stamp));
}

ViewCounter::ViewCounter(CostRequest request)
    : request_(std::move(request)),
      device_(request_.options.device.device, cache_folder(request_.options.cache)),
      opened_(open_with_options(request_.input, request_.options, device_.caps(), request_.between)),
      library_(kept_library(cache_folder(request_.options.cache))) {}

std::vector<std::string> ViewCounter::cameras() const {
    std::vector<std::string> names = camera_names(opened_.scene);
    if (names.empty()) names.emplace_back();
    return names;
}

void ViewCounter::look(const CostView& view) {
    if (view.camera.empty() && view.tiers.empty()) return;
    SceneOptions options = request_.options;
    if (!view.tiers.empty()) options.tiers = view.tiers;
    wish(opened_, options);
    if (!view.camera.empty()) look_through(opened_, options, view.camera);
    fit_to_budget(opened_, options, device_.caps());
}

cost::CountedFrame ViewCounter::counted(const CostView& view) {
    look(view);
    request_.between("counting fragments");
    return cost::count_frame(device_.recorder(), device_.gl(), device_.caps(), opened_.scene, opened_.view,
                             opened_.wishes, library_);
}

cost::FrameCost ViewCounter::cost_of(const CostView& view) {
    const std::size_t notices_before = opened_.scene.notices.size();
    const cost::CountedFrame frame = counted(view);
    request_.between("counting instructions");
    cost::FrameCost cost = cost::frame_cost(frame, library_, request_.arithmetic, request_.profiles);
    cost.scene = opened_.label;
    cost.camera = camera_name(opened_);
    cost.notices.insert(cost.notices.begin(), opened_.scene.notices.begin(), opened_.scene.notices.end());
    opened_.scene.notices.resize(std::min(notices_before, opened_.scene.notices.size()));
    return cost;
}

std::optional<perf::BudgetTable> judged(const cost::FrameCost& cost, const std::optional<Budget>& budget) {
    if (!budget) return std::nullopt;
    return perf::budget_table(cost::report_of(cost), *budget, false);
}

Part parse_part(const std::string& words) {
    Part part;
    const char* begin = words.data();
    const char* end = begin + words.size();
    const auto first = std::from_chars(begin, end, part.part);
    if (first.ec == std::errc() && first.ptr != end && *first.ptr == '/') {
        const auto second = std::from_chars(first.ptr + 1, end, part.of);
        constexpr int kMostParts = 1000;
        if (second.ec == std::errc() && second.ptr == end && part.part >= 1 && part.part <= part.of &&
            part.of <= kMostParts)
            return part;
    }
    throw Error(Fault::usage, fmt::format("--part {}: write PART/PARTS, for example 1/2, each 1 to 1000", words));
}

ChildOutputs outputs_of_own(const std::vector<std::vector<std::string>>& arguments,
                            const std::function<void(const std::string&)>& between) {
    std::vector<std::future<process::ChildResult>> children;
    std::atomic<bool> stop = false;
    struct Stopped {};
    for (const std::vector<std::string>& words : arguments) {
        process::ChildCommand command{.arguments = {own_program().string()}, .limit_s = kLongestChild_s};
        command.arguments.insert(command.arguments.end(), words.begin(), words.end());
        command.between = [&stop](int) {
            if (stop) throw Stopped{};
        };
        children.push_back(std::async(std::launch::async, [command] { return process::run_child(command); }));
    }
    ChildOutputs all;
    std::exception_ptr failure;
    for (auto& child : children) {
        try {
            while (child.wait_for(std::chrono::milliseconds(100)) != std::future_status::ready)
                if (!failure) between(fmt::format("counting in {} processes", children.size()));
            const process::ChildResult result = child.get();
            all.errors += result.errors;
            if (result.exit_code == 1 && !result.output.empty()) all.exceeded = true;
            else if (result.exit_code != 0)
                throw Error(
                    result.exit_code > 0 && result.exit_code <= 5 ? static_cast<Fault>(result.exit_code) : Fault::check,
                    last_words(result));
            all.outputs.push_back(result.output);
        } catch (...) {
            if (!failure) failure = std::current_exception();
            stop = true;
            if (child.valid()) child.wait();
        }
    }
    if (failure) std::rethrow_exception(failure);
    return all;
}

}  // namespace halfframe::cli
