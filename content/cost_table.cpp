// The prices of effects: content/costs/prices.json, or a file of the same form.
#include <algorithm>
#include <array>

#include "content/content.h"
#include "content/data_lookup.h"
#include "engine/frame/cost_table.h"

namespace halfframe::content {
namespace {

constexpr const char* kAdvice = "write it anew with halfframe cost --refresh-tables content/costs/effects.json";
constexpr double kLongest_ms = 1e6;
constexpr double kMostViews = 1e6;

template <typename Parse>
auto word_at(const JsonPlace& place, Parse parse, const char* words) {
    const auto value = parse(place.text());
    if (!value) place.fail("is '" + place.text() + "' but must be " + words);
    return *value;
}

EffectPrice price_from(const JsonPlace& place, const std::string& device, const EffectPrice& of) {
    place.expect_only({"fixed_ms", "ms_per_mpixel", "least", "most"});
    EffectPrice price = of;
    price.device = device;
    price.fixed_ms = place.at("fixed_ms").number(-kLongest_ms, kLongest_ms);
    price.ms_per_mpixel = place.at("ms_per_mpixel").number(-kLongest_ms, kLongest_ms);
    price.least = place.at("least").number(0.0, 1.0);
    price.most = place.at("most").number(1.0, kLongest_ms);
    return price;
}

std::optional<Arithmetic> arithmetic_from(const std::string& word) {
    if (word == "half") return Arithmetic::half;
    if (word == "full") return Arithmetic::full;
    return std::nullopt;
}

}  // namespace

CostTable cost_table(const std::string& name_or_path) {
    const DataDocument document = open_data("costs", name_or_path, {}, kAdvice);
    const JsonPlace root(document.json, document.source);
    root.expect_only({"model_version", "compiler", "counts", "views", "prices"});
    CostTable table;
    table.model_version = static_cast<int>(root.at("model_version").whole(0, 1000000));
    table.compiler = root.at("compiler").text();
    const JsonPlace prices = root.at("prices");
    for (std::size_t i = 0; i < prices.size(); ++i) {
        const JsonPlace row = prices.at(i);
        row.expect_only({"effect", "tier", "arithmetic", "passes", "views", "devices"});
        const EffectPrice of{.effect = row.at("effect").text(),
                             .tier = word_at(row.at("tier"), tier_from_name, "low, console or reference"),
                             .arithmetic = word_at(row.at("arithmetic"), arithmetic_from, "half or full"),
                             .passes = row.at("passes").boolean(),
                             .views = static_cast<int>(row.at("views").number(1.0, kMostViews))};
        const JsonPlace each = row.at("devices");
        each.expect_object();
        // Those everybody knows first, in the order of every table; objects of JSON have none.
        constexpr std::array kFirst{"ps3", "x360", "es2_class"};
        for (const char* device : kFirst)
            if (each.has(device)) table.prices.push_back(price_from(each.at(device), device, of));
        for (const JsonMember& member : each.value().members())
            if (std::find(kFirst.begin(), kFirst.end(), *member.key) == kFirst.end())
                table.prices.push_back(price_from(each.at(*member.key), *member.key, of));
    }
    return table;
}

}  // namespace halfframe::content
