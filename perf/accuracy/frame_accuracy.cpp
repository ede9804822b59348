// Draws pairs of frames and compares them.
#include "perf/accuracy/frame_accuracy.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <tuple>

#include <fmt/format.h>

#include "engine/error.h"

namespace halfframe::accuracy {
namespace {

Picture part_of(const Picture& picture, const std::optional<Part>& wanted) {
    if (!wanted) return picture;
    expect(wanted->x >= 0 && wanted->y >= 0 && wanted->x + wanted->width <= picture.width &&
               wanted->y + wanted->height <= picture.height,
           "a part that is compared lies outside its picture");
    Picture part{.width = wanted->width, .height = wanted->height, .rgba = {}};
    for (int y = wanted->y; y < wanted->y + wanted->height; ++y) {
        const auto first = picture.rgba.begin() + 4 * (static_cast<std::ptrdiff_t>(y) * picture.width + wanted->x);
        part.rgba.insert(part.rgba.end(), first, first + 4 * wanted->width);
    }
    return part;
}

/// Largest error of a pixel's channels.
int pixel_error(const std::uint8_t* plain, const std::uint8_t* changed, Relation relation) {
    int error = 0;
    for (int channel = 0; channel < 4; ++channel) {
        const int missing = plain[channel] - changed[channel];
        error = std::max(error, relation == Relation::same ? std::abs(missing) : missing);
    }
    return error;
}

/// Share of pixels that differ at all, and the largest difference.
std::pair<double, int> distance(const Picture& plain, const Picture& changed, Relation relation) {
    expect(plain.width == changed.width && plain.height == changed.height,
           "the compared parts of a pair of frames differ in size");
    std::size_t bad = 0;
    int largest = 0;
    for (std::size_t at = 0; at < plain.rgba.size(); at += 4) {
        const int error = pixel_error(&plain.rgba[at], &changed.rgba[at], relation);
        bad += error > 0 ? 1 : 0;
        largest = std::max(largest, error);
    }
    return {static_cast<double>(bad) / static_cast<double>(plain.rgba.size() / 4), largest};
}

void judge(FrameAccuracy& found, double least_covered) {
    const std::string subject =
        fmt::format("{}: {} ({}, {})", found.kind, found.change, name(found.tier), name(found.arithmetic));
    const auto demand = [&](bool holds, const std::string& sentence) {
        if (!holds) found.violations.push_back(subject + ": " + sentence);
    };
    demand(found.covered >= least_covered,
           fmt::format("surfaces decide {:.0f} % of the picture, too little to judge it", 100.0 * found.covered));
    demand(found.census_values > 0, "the census looked at nothing");
    demand(found.not_finite == 0, fmt::format("{} values are NaN or infinite", found.not_finite));
    demand(found.max_channel_error <= found.bound.max_channel_error,
           fmt::format("max_channel_error {} is over {} ({})", found.max_channel_error, found.bound.max_channel_error,
                       found.bound.reason));
    demand(found.bad_fraction <= found.bound.max_bad_fraction,
           fmt::format("bad_fraction {:.5f} is over {:.5f} ({})", found.bad_fraction, found.bound.max_bad_fraction,
                       found.bound.reason));
}

}  // namespace

FrameBench::FrameBench(gl::EntryPoints& gl, const gl::Caps& caps, std::span<const EffectCard* const> cards)
    : caps_(caps), cards_(cards), renderer_(gl, caps, {.program_cache_folder = {}, .effects = cards}) {}

Picture FrameBench::draw(const Shot& shot, const Wishes& wishes) {
    View view = view_of(shot.camera, shot.width, shot.height);
    view.exposure = shot.camera.exposure;
    renderer_.prepare(shot.scene, plan_frame(shot.scene, view, wishes, caps_, cards_));
    renderer_.draw(view);
    Picture picture = renderer_.read_display();
    if (const std::string error = renderer_.first_gl_error(); !error.empty()) {
        throw Error(Fault::check, fmt::format("GL reports {} after drawing {} on {}; try another --context", error,
                                              shot.scene.name, caps_.renderer));
    }
    return picture;
}

FrameAccuracy FrameBench::measure(const FrameCase& pair, Tier tier, Arithmetic arithmetic) {
    FrameAccuracy found{.kind = pair.kind,
                        .change = pair.change,
                        .tier = tier,
                        .arithmetic = arithmetic,
                        .relation = pair.relation,
                        .bound = bound_of(pair, tier, arithmetic)};
    Wishes wishes{.tier = tier, .arithmetic = arithmetic};
    if (!pair.whole) {
        for (const EffectCard* card : cards_) {
            if (card->name == "shadow" || card->name == "bloom" || card->name == "anti_alias")
                wishes.effect_switches.emplace_back(card->name, false);
        }
    }
    const Shot plain = pair.plain();
    Shot changed = pair.changed();
    found.plain = part_of(draw(plain, wishes), pair.plain_part);
    found.changed = part_of(draw(changed, wishes), pair.changed_part);
    found.storage = renderer_.plan().storage;
    std::tie(found.bad_fraction, found.max_channel_error) = distance(found.plain, found.changed, pair.relation);

    wishes.census = true;
    (void)draw(changed, wishes);
    for (const CensusRow& row : renderer_.census()) {
        found.census_values += row.values;
        found.not_finite += row.nan + row.inf;
    }
    wishes.census = false;
    changed.scene.surfaces.clear();
    found.covered = distance(part_of(draw(changed, wishes), pair.changed_part), found.changed, Relation::same).first;
    judge(found, pair.least_covered);
    return found;
}

}  // namespace halfframe::accuracy
