// The models of transparent: what an order by centres loses where panes cross, and what blending something else than
// light does.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/effects/tone_map/tone_map_reference.h"
#include "perf/accuracy/model_list.h"

namespace halfframe::accuracy {
namespace {

using reference::BlendedLayer;
using reference::Held;

constexpr double kCodes = 255.0;
constexpr double kHalfWidth_m = 0.5;
constexpr double kDistance_m = 2.0;

/// Two panes of a metre before a light of 0.5: a dark one that faces the eye, and a bright one behind, turned.
std::vector<ModelError> order_errors(PaneOrder order) {
    std::vector<ModelError> errors;
    for (int gap = 1; gap <= 10; ++gap) {
        for (int turn = 0; turn <= 16; ++turn) {
            for (int across = -20; across <= 20; ++across) {
                const double gap_m = 0.05 * gap, turn_deg = 5.0 * turn, x_m = kHalfWidth_m * across / 20.0;
                const double turn_rad = turn_deg * std::numbers::pi / 180.0;
                const double slope = x_m / kDistance_m;
                // Where the ray through x of the first pane meets the plane of the second, and how far out.
                const double meets_m = (kDistance_m + gap_m) / (1.0 - slope * std::tan(turn_rad));
                const bool hit = meets_m > 0.0 && std::fabs(meets_m * slope) <= kHalfWidth_m * std::cos(turn_rad);
                if (!hit) continue;
                const Pane facing{kDistance_m, 0.0, kHalfWidth_m}, turned{kDistance_m + gap_m, turn_rad, kHalfWidth_m};
                const auto shown = [&](double first_m, double second_m) {
                    const std::vector<BlendedLayer> panes{
                        {.light = glm::dvec3(0.05), .alpha = 0.5, .distance_m = first_m},
                        {.light = glm::dvec3(2.0), .alpha = 0.5, .distance_m = second_m}};
                    return kCodes * reference::shown_through(panes, glm::dvec3(0.5), Held::light).x;
                };
                errors.push_back(
                    {{turn_deg, gap_m, 2.0 * x_m}, shown(order(facing), order(turned)) - shown(kDistance_m, meets_m)});
            }
        }
    }
    return errors;
}

std::vector<ModelError> held_errors(Held held) {
    constexpr int kSteps = 16;
    std::vector<ModelError> errors;
    for (int behind = 0; behind <= kSteps; ++behind) {
        for (int pane = 0; pane <= kSteps; ++pane) {
            for (int alpha = 0; alpha <= 8; ++alpha) {
                const auto light = [](int step) {
                    return glm::dvec3(std::min(reference::inverse_tone_curve(static_cast<double>(step) / kSteps), 8.0));
                };
                const std::vector<BlendedLayer> panes{{.light = light(pane), .alpha = alpha / 8.0}};
                errors.push_back(
                    {{static_cast<double>(behind) / kSteps, static_cast<double>(pane) / kSteps, alpha / 8.0},
                     kCodes * (reference::shown_through(panes, light(behind), held).x -
                               reference::shown_through(panes, light(behind), Held::light).x)});
            }
        }
    }
    return errors;
}

}  // namespace

double centre_order(const Pane& pane) { return pane.centre_m; }

ModelEntry order_of_panes(PaneOrder order) {
    return {
        .effect = "transparent",
        .model = "order by centres",
        .truth =
            "every ray's own order: a pane of light 0.05 faces the eye, one of 2 is behind it and turned; alpha 1/2",
        .unit = "codes",
        .axes = {"turned [deg]", "behind by [m]", "across [half a pane]"},
        .errors = [order] { return order_errors(order); },
        .largest = {25.0, "two panes of alpha 1/2 change places where they cross: a quarter of the lights' difference"},
        .mean = {
            3.2,
            "3.06: a pane that is turned cuts the other one along a line, and on one side of it both are swapped"}};
}

ModelEntry blended_as(Held held) {
    const bool display = held == Held::display;
    return {
        .effect = "transparent",
        .model = display ? "display values blended" : "packed values blended",
        .truth = "linear light blended, then shown; one pane",
        .unit = "codes",
        .axes = {"behind [display]", "pane [display]", "alpha"},
        .errors = [held] { return held_errors(held); },
        .largest =
            display ? Bound{184.0, "an eighth of white over black is 32 codes, an eighth of a light of 8 is 214: -183"}
                    : Bound{121.0, "an eighth of its root is a light of 1/8, 95 codes instead of 214: -120"},
        .mean = display ? Bound{16.5, "16.0 over all display values, always too dark; 0 where both lights are alike"}
                        : Bound{7.7, "7.46 over all display values, always too dark"}};
}

}  // namespace halfframe::accuracy
