// Budgets: the built-in files in content/budgets, or a file of the user's.
#include <algorithm>
#include <array>
#include <set>

#include "content/content.h"
#include "content/data_lookup.h"
#include "content/nearest.h"
#include "engine/frame/tier.h"

namespace halfframe::content {
namespace {

constexpr const char* kAdvice = "content/README.md and content/schemas/budget.schema.json describe a budget file";
constexpr double kLongest_ms = 1e6;
constexpr double kMost_mib = 1e6;
constexpr double kMostCounted = 1e15;

std::optional<double> number_or_none(const JsonPlace& owner, const char* key, double highest) {
    return owner.has(key) ? std::optional<double>(owner.at(key).number(0.0, highest)) : std::nullopt;
}

std::string text_or_empty(const JsonPlace& owner, const char* key) {
    return owner.has(key) ? owner.at(key).text() : std::string();
}

/// One of `words`; anything else fails with the nearest of them.
template <typename Words>
std::string word_at(const JsonPlace& place, const Words& words) {
    const std::string& word = place.text();
    std::vector<std::string> known;
    std::string list;
    for (const auto& one : words) {
        known.emplace_back(one);
        list += (list.empty() ? "" : ", ") + known.back();
    }
    if (std::find(known.begin(), known.end(), word) == known.end())
        place.fail("unknown word '" + word + "'" + did_you_mean(word, known), "write one of " + list);
    return word;
}

BudgetLevel level_at(const JsonPlace& place) {
    const std::string word = word_at(place, std::array{"off", "warn", "error"});
    return word == "off" ? BudgetLevel::off : word == "warn" ? BudgetLevel::warn : BudgetLevel::error;
}

std::string column_at(const JsonPlace& place) {
    if (place.text().empty()) place.fail("is empty", "write a profile, as ps3, x360 or es2_class, or measured");
    return place.text();
}

BudgetRow row_from(const JsonPlace& place) {
    place.expect_only(
        {"name", "published_ms", "published_high_ms", "ours_ms", "platforms", "source", "note", "columns", "level"});
    BudgetRow row;
    row.name = place.at("name").text();
    row.published_ms = number_or_none(place, "published_ms", kLongest_ms);
    row.published_high_ms = number_or_none(place, "published_high_ms", kLongest_ms);
    row.ours_ms = number_or_none(place, "ours_ms", kLongest_ms);
    row.platforms = text_or_empty(place, "platforms");
    row.source = place.at("source").text();
    row.note = text_or_empty(place, "note");
    if (place.has("columns")) {
        const JsonPlace columns = place.at("columns");
        for (std::size_t i = 0; i < columns.size(); ++i) row.columns.push_back(column_at(columns.at(i)));
        if (row.columns.empty()) columns.fail("is empty", "leave it out, or write \"level\": \"off\"");
    }
    if (place.has("level")) row.level = level_at(place.at("level"));
    if (!row.published_ms && !row.ours_ms) {
        place.fail("has neither published_ms nor ours_ms");
    }
    if (row.published_high_ms && (!row.published_ms || *row.published_high_ms < *row.published_ms)) {
        place.at("published_high_ms").fail("must be the upper end of a range that begins with published_ms");
    }
    if (row.source.empty()) {
        place.at("source").fail("is empty: a figure needs a source or a reasoning");
    }
    return row;
}

/// The figure of a limit; one that is off needs none.
double most_at(const JsonPlace& place, const char* key, double highest, BudgetLevel level) {
    if (level == BudgetLevel::off && !place.has(key)) return 0.0;
    return place.at(key).number(0.0, highest);
}

/// One entry of "limits": what it fits, and the limits in it.
class LimitsReader {
public:
    explicit LimitsReader(std::vector<BudgetLimit>& limits) : limits_(limits) {}

    void read(const JsonPlace& place) {
        place.expect_only({"scene", "camera", "tier", "source", "frame", "passes", "effects", "counters", "targets",
                           "textures", "bytes_per_pixel"});
        fits_ = {};
        if (place.has("scene")) fits_.scene = place.at("scene").text();
        if (place.has("camera")) fits_.camera = place.at("camera").text();
        if (place.has("tier"))
            fits_.tier =
                word_at(place.at("tier"), std::array{"*", halfframe::name(Tier::low), halfframe::name(Tier::console),
                                                     halfframe::name(Tier::reference)});
        fits_.source = text_or_empty(place, "source");
        const std::size_t before = limits_.size();
        list(place, "frame", [&](const JsonPlace& one) { milliseconds(one, BudgetLimit::Of::frame_ms, nullptr); });
        list(place, "passes", [&](const JsonPlace& one) { milliseconds(one, BudgetLimit::Of::pass_ms, "pass"); });
        list(place, "effects", [&](const JsonPlace& one) { milliseconds(one, BudgetLimit::Of::effect_ms, "effect"); });
        list(place, "counters", [&](const JsonPlace& one) { counter(one); });
        single(place, "targets", BudgetLimit::Of::target_mib, "mib");
        single(place, "textures", BudgetLimit::Of::texture_mib, "mib");
        single(place, "bytes_per_pixel", BudgetLimit::Of::bytes_per_pixel, "most");
        if (limits_.size() == before)
            place.fail("limits nothing",
                       "write frame, passes, effects, counters, targets, textures or bytes_per_pixel");
    }

private:
    template <typename Read>
    void list(const JsonPlace& place, const char* key, Read read) {
        if (!place.has(key)) return;
        const JsonPlace all = place.at(key);
        const std::size_t first = limits_.size();
        for (std::size_t i = 0; i < all.size(); ++i) {
            read(all.at(i));
            for (std::size_t other = first; other + 1 < limits_.size(); ++other)
                if (limits_[other].speaks_of_the_same(limits_.back()))
                    all.at(i).fail("limits what an earlier one in this list limits; keep one");
        }
    }

    BudgetLimit started(const JsonPlace& place, BudgetLimit::Of of) const {
        BudgetLimit limit = fits_;
        limit.of = of;
        if (place.has("level")) limit.level = level_at(place.at("level"));
        if (place.has("source")) limit.source = place.at("source").text();
        return limit;
    }

    void milliseconds(const JsonPlace& place, BudgetLimit::Of of, const char* name_key) {
        if (name_key != nullptr) place.expect_only({name_key, "column", "ms", "level", "source"});
        else place.expect_only({"column", "ms", "level", "source"});
        BudgetLimit limit = started(place, of);
        if (name_key != nullptr) limit.name = place.at(name_key).text();
        limit.column = column_at(place.at("column"));
        limit.most = most_at(place, "ms", kLongest_ms, limit.level);
        limits_.push_back(limit);
    }

    void counter(const JsonPlace& place) {
        place.expect_only({"counter", "pass", "most", "level", "source"});
        BudgetLimit limit = started(place, BudgetLimit::Of::counter);
        limit.name = word_at(place.at("counter"), budget_counters());
        limit.pass = text_or_empty(place, "pass");
        limit.most = most_at(place, "most", kMostCounted, limit.level);
        limits_.push_back(limit);
    }

    void single(const JsonPlace& owner, const char* key, BudgetLimit::Of of, const char* number_key) {
        if (!owner.has(key)) return;
        const JsonPlace place = owner.at(key);
        place.expect_only({number_key, "level", "source"});
        BudgetLimit limit = started(place, of);
        limit.most = most_at(place, number_key, kMost_mib, limit.level);
        limits_.push_back(limit);
    }

    std::vector<BudgetLimit>& limits_;
    BudgetLimit fits_;
};

Budget budget_from(const JsonPlace& root) {
    root.expect_only({"name", "source", "frame_ms", "target_mib", "texture_mib", "draws", "rows", "limits"});
    Budget result;
    result.name = root.at("name").text();
    (void)text_or_empty(root, "source");
    result.frame_ms = root.at("frame_ms").number(1e-3, kLongest_ms);
    result.target_mib = number_or_none(root, "target_mib", kMost_mib);
    result.texture_mib = number_or_none(root, "texture_mib", kMost_mib);
    if (root.has("draws")) {
        result.draws = static_cast<int>(root.at("draws").whole(0, 1000000));
    }
    if (root.has("limits")) {
        const JsonPlace limits = root.at("limits");
        LimitsReader reader(result.limits);
        for (std::size_t i = 0; i < limits.size(); ++i) reader.read(limits.at(i));
    }
    if (!root.has("rows") && root.has("limits")) return result;
    std::set<std::string> names;
    const JsonPlace rows = root.at("rows");
    for (std::size_t i = 0; i < rows.size(); ++i) {
        result.rows.push_back(row_from(rows.at(i)));
        if (!names.insert(result.rows.back().name).second) {
            rows.at(i).at("name").fail("'" + result.rows.back().name + "' is the name of an earlier row");
        }
    }
    return result;
}

}  // namespace

Budget budget(const std::string& name_or_path) {
    const DataDocument document = open_data("budgets", name_or_path, {}, kAdvice);
    return budget_from({document.json, document.source});
}

}  // namespace halfframe::content
