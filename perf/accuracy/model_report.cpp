// Models in words and in JSON.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "perf/accuracy/accuracy_report.h"
#include "perf/report/text_table.h"

namespace halfframe::accuracy {
namespace {

using perf::Align;
using Json = nlohmann::ordered_json;

std::string figure(double value) { return value == 0.0 ? "0" : fmt::format("{:.2g}", value); }

std::string signed_figure(double value) { return value == 0.0 ? "0" : fmt::format("{:+.3g}", value); }

Json model_json(const ModelAccuracy& model) {
    const ModelEntry& entry = model.entry;
    Json place = Json::object();
    for (std::size_t axis = 0; axis < entry.axes.size(); ++axis) {
        place[entry.axes[axis]] = model.errors[model.worst].at[axis];
    }
    return {{"effect", entry.effect},
            {"model", entry.model},
            {"truth", entry.truth},
            {"unit", entry.unit},
            {"places", model.errors.size()},
            {"lowest", model.lowest},
            {"highest", model.highest},
            {"mean", model.mean},
            {"worst_place", place},
            {"largest_bound", entry.largest.at_most},
            {"largest_bound_reason", entry.largest.reason},
            {"mean_bound", entry.mean.at_most},
            {"mean_bound_reason", entry.mean.reason},
            {"violations", model.violations}};
}

}  // namespace

std::string models_text(const std::vector<ModelAccuracy>& models) {
    perf::TextTable table({{"effect", Align::left},
                           {"model", Align::left},
                           {"error", Align::left},
                           {"lowest", Align::right},
                           {"highest", Align::right},
                           {"mean", Align::right},
                           {"places", Align::right},
                           {"bounds", Align::left}});
    std::string places;
    for (const ModelAccuracy& model : models) {
        const ModelEntry& entry = model.entry;
        table.add_row({entry.effect, entry.model, entry.unit, signed_figure(model.lowest), signed_figure(model.highest),
                       figure(model.mean), std::to_string(model.errors.size()),
                       model.violations.empty() ? "hold" : "exceeded"});
        places += fmt::format("{}, {}\n  truth  {}\n  worst ", entry.effect, entry.model, entry.truth);
        for (std::size_t axis = 0; axis < entry.axes.size(); ++axis) {
            places += fmt::format(" {} {:g}", entry.axes[axis], model.errors[model.worst].at[axis]);
        }
        places += "\n";
    }
    return "Models against what they stand for, both in double: what is lost (lowest), what is gained (highest), and "
           "the\nmean size of the error.\n\n" +
           table.text() + "\n" + places;
}

Json models_json(const std::vector<ModelAccuracy>& models) {
    Json all = Json::array();
    for (const ModelAccuracy& model : models) all.push_back(model_json(model));
    return all;
}

}  // namespace halfframe::accuracy
