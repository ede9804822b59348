// Finding a row of a budget, and the limits that fit a frame.
#include "engine/frame/budget.h"

#include <algorithm>
#include <array>

namespace halfframe {

const char* name(BudgetLevel level) {
    switch (level) {
        case BudgetLevel::off: return "off";
        case BudgetLevel::warn: return "warn";
        case BudgetLevel::error: return "error";
    }
    return "error";
}

std::span<const std::string_view> budget_counters() {
    static constexpr std::array<std::string_view, 8> kCounters{
        "draws",           "vertices", "triangles",       "fragments_shaded",
        "samples_written", "programs", "target_switches", "resolves"};
    return kCounters;
}

bool BudgetLimit::speaks_of_the_same(const BudgetLimit& other) const {
    return of == other.of && name == other.name && pass == other.pass && column == other.column;
}

const BudgetRow* Budget::find(const std::string& row) const {
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const BudgetRow& each) { return each.name == row; });
    return found == rows.end() ? nullptr : &*found;
}

std::vector<BudgetLimit> Budget::limits_for(std::string_view scene, std::string_view camera,
                                            std::string_view tier) const {
    using Of = BudgetLimit::Of;
    std::vector<BudgetLimit> fitting{{.of = Of::frame_ms, .column = kMeasuredColumn, .most = frame_ms}};
    if (target_mib) fitting.push_back({.of = Of::target_mib, .most = *target_mib});
    if (texture_mib) fitting.push_back({.of = Of::texture_mib, .most = *texture_mib});
    if (draws) fitting.push_back({.of = Of::counter, .name = "draws", .most = static_cast<double>(*draws)});
    for (const BudgetLimit& limit : limits) {
        if (!matches_pattern(limit.scene, scene) || !matches_pattern(limit.camera, camera) ||
            !matches_pattern(limit.tier, tier))
            continue;
        const auto before =
            std::ranges::find_if(fitting, [&](const BudgetLimit& one) { return one.speaks_of_the_same(limit); });
        if (before != fitting.end()) *before = limit;
        else fitting.push_back(limit);
    }
    return fitting;
}

bool matches_pattern(std::string_view pattern, std::string_view text) {
    // The last star takes one letter more whenever what follows it does not fit: no recursion, no blow-up.
    std::size_t at = 0, from = 0;
    std::size_t star = std::string_view::npos, taken = 0;
    while (from < text.size()) {
        if (at < pattern.size() && pattern[at] == '*') {
            star = at++;
            taken = from;
        } else if (at < pattern.size() && pattern[at] == text[from]) {
            ++at;
            ++from;
        } else if (star != std::string_view::npos) {
            at = star + 1;
            from = ++taken;
        } else {
            return false;
        }
    }
    while (at < pattern.size() && pattern[at] == '*') ++at;
    return at == pattern.size();
}

}  // namespace halfframe
