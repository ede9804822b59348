// Budgets: the built-in files in content/budgets, or a file of the user's.
#include "content/content.h"

#include <set>

#include "content/data_lookup.h"

namespace halfframe::content {
namespace {

constexpr const char* kAdvice = "content/README.md shows a budget file";
constexpr double kLongest_ms = 1e6;
constexpr double kMost_mib = 1e6;

std::optional<double> number_or_none(const JsonPlace& owner, const char* key, double highest) {
    return owner.has(key) ? std::optional<double>(owner.at(key).number(0.0, highest)) : std::nullopt;
}

std::string text_or_empty(const JsonPlace& owner, const char* key) {
    return owner.has(key) ? owner.at(key).text() : std::string();
}

BudgetRow row_from(const JsonPlace& place) {
    place.expect_only({"name", "published_ms", "published_high_ms", "ours_ms", "platforms", "source", "note"});
    BudgetRow row;
    row.name = place.at("name").text();
    row.published_ms = number_or_none(place, "published_ms", kLongest_ms);
    row.published_high_ms = number_or_none(place, "published_high_ms", kLongest_ms);
    row.ours_ms = number_or_none(place, "ours_ms", kLongest_ms);
    row.platforms = text_or_empty(place, "platforms");
    row.source = place.at("source").text();
    row.note = text_or_empty(place, "note");
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

Budget budget_from(const JsonPlace& root) {
    root.expect_only({"name", "source", "frame_ms", "target_mib", "texture_mib", "draws", "rows"});
    Budget result;
    result.name = root.at("name").text();
    (void)text_or_empty(root, "source");
    result.frame_ms = root.at("frame_ms").number(1e-3, kLongest_ms);
    result.target_mib = number_or_none(root, "target_mib", kMost_mib);
    result.texture_mib = number_or_none(root, "texture_mib", kMost_mib);
    if (root.has("draws")) {
        result.draws = static_cast<int>(root.at("draws").whole(0, 1000000));
    }
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
