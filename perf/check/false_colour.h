// A scene in false colours: grey where the charts are kept, a colour for each rule that is broken.
#pragma once

#include <array>
#include <vector>

#include "engine/frame/image.h"
#include "engine/frame/scene.h"
#include "perf/check/check.h"
#include "perf/report/lettering.h"

namespace halfframe::check {

/// Display codes that a broken texel rule is shown in.
[[nodiscard]] perf::Rgb colour_of(RuleId texel_rule);

/// The texel rules that `report` has warnings or errors of, in their order. Only these are shown: a few texels on a
/// border between two materials are nobody's fault.
[[nodiscard]] std::vector<RuleId> shown_rules(const Report& report);

/// Swaps the materials of `scene` for false colours: a matt grey that is lit as before, and over it the first rule that
/// a texel breaks, shining by itself so that no light changes its colour. `exposure` is the view's. Nothing else
/// changes.
void show_broken_rules(Scene& scene, const Report& report, const Thresholds& thresholds, float exposure);

/// Draws what the colours mean into the upper left corner.
void draw_legend(Picture& picture, const std::vector<RuleId>& rules, const perf::Lettering& lettering);

}  // namespace halfframe::check
