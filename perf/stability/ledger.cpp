// The ledger as text, and what changed in it.
#include "perf/stability/ledger.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/error.h"

namespace halfframe::stability {
namespace {

using Json = nlohmann::ordered_json;

std::string key(const LedgerRow& row) { return row.function + ", " + row.model; }

std::string reason_of(const FunctionStability& function, const Tally& tally) {
    const Exemption* exemption = function.function.exemption(tally.model);
    if (exemption != nullptr) return exemption->bound() + ": " + exemption->reason;
    return "4 times what rounding the inputs must cause, and 2 steps of the result";
}

/// JSON has no inf and no NaN: these go as words.
Json number(double x) { return std::isfinite(x) ? Json(x) : Json(fmt::format("{}", x)); }
double number(const Json& json) {
    if (json.is_number()) return json.get<double>();
    const std::string word = json.get<std::string>();
    return word == "inf" ? HUGE_VAL : word == "-inf" ? -HUGE_VAL : std::nan("");
}

bool near(double a, double b, const std::string& model) {
    if (a == b || (std::isnan(a) && std::isnan(b))) return true;
    const double size = std::max(std::fabs(a), std::fabs(b));
    return std::fabs(a - b) <= (model == "float" ? 0x1p-19 * size : std::max(0x1p-10 * size, 0x1p-24));
}

}  // namespace

std::vector<LedgerRow> ledger_rows(const std::vector<FunctionStability>& functions) {
    std::vector<LedgerRow> rows;
    for (const FunctionStability& function : functions) {
        for (const Tally& tally : function.tallies) {
            if (tally.arithmetic.ends_with("here") || tally.worst.ratio < 0.0) continue;
            rows.push_back({.function = function.function.file + " " + function.title,
                            .model = tally.arithmetic,
                            .input = input_text(function.function, tally.worst.input),
                            .expected = tally.worst.expected,
                            .got = tally.worst.got,
                            .tolerance = tally.worst.allowed * tally.at_most,
                            .reason = reason_of(function, tally)});
        }
    }
    return rows;
}

std::string ledger_text(const std::vector<LedgerRow>& rows) {
    std::string text = "[\n";
    for (const LedgerRow& row : rows) {
        const Json json{{"case", row.function},   {"model", row.model},
                        {"input", row.input},     {"expected", number(row.expected)},
                        {"got", number(row.got)}, {"tolerance", number(row.tolerance)},
                        {"reason", row.reason}};
        text += json.dump() + (&row == &rows.back() ? "\n" : ",\n");
    }
    return text + "]\n";
}

std::vector<LedgerRow> read_ledger(const std::string& text, const std::string& path) {
    std::vector<LedgerRow> rows;
    try {
        for (const Json& json : Json::parse(text)) {
            rows.push_back({json.at("case"), json.at("model"), json.at("input"), number(json.at("expected")),
                            number(json.at("got")), number(json.at("tolerance")), json.at("reason")});
        }
    } catch (const Json::exception& error) {
        throw Error(Fault::input, fmt::format("{} is no ledger of hard cases: {}; write it anew with --write-ledger",
                                              path, error.what()));
    }
    return rows;
}

std::vector<std::string> differences(const std::vector<LedgerRow>& kept, const std::vector<LedgerRow>& found) {
    std::vector<std::string> sentences;
    std::map<std::string, const LedgerRow*> known;
    for (const LedgerRow& row : kept) known[key(row)] = &row;
    for (const LedgerRow& row : found) {
        const auto old = known.find(key(row));
        if (old == known.end()) {
            sentences.push_back(key(row) + ": is not in the ledger");
            continue;
        }
        const LedgerRow& was = *old->second;
        if (was.input != row.input) {
            sentences.push_back(fmt::format("{}: is worst at {}, was at {}", key(row), row.input, was.input));
        } else if (!near(was.got, row.got, row.model) || !near(was.expected, row.expected, "float")) {
            sentences.push_back(fmt::format("{}: gives {:.9g} for {:.9g}, gave {:.9g} for {:.9g}", key(row), row.got,
                                            row.expected, was.got, was.expected));
        } else if (!near(was.tolerance, row.tolerance, row.model) || was.reason != row.reason) {
            sentences.push_back(fmt::format("{}: may be off by {:.3g} ({}), was {:.3g} ({})", key(row), row.tolerance,
                                            row.reason, was.tolerance, was.reason));
        }
        known.erase(old);
    }
    for (const auto& [name, row] : known) sentences.push_back(name + ": is in the ledger and was not found any more");
    return sentences;
}

}  // namespace halfframe::stability
