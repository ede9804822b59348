// A picture's shadows beside rays cast in double through the same scene.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/effects/shadow/shadow_fit.h"
#include "shaders_es/shadow/shadow_limits.h"
#include "tests/effects/shadow/shadow_scenes.h"

namespace halfframe::tests {

inline std::vector<ShadowBody> bodies_of(const Scene& scene) {
    std::vector<ShadowBody> bodies;
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(scene.surfaces[i].mesh)];
        bodies.push_back(shadow_body(scene, static_cast<int>(i), local_box(mesh)));
    }
    return bodies;
}

/// Side of one texel of the map that is drawn for `view` [m].
inline double texel_m(const Scene& scene, const View& view, Tier tier) {
    const auto fit = fit_shadow(scene, bodies_of(scene), scene.lights.front().direction, view);
    EXPECT_TRUE(fit.has_value());
    return fit ? shadow_texel_m(*fit, tier == Tier::reference ? SHADOW_MAP_SIZE_REFERENCE : SHADOW_MAP_SIZE_CONSOLE)
               : 0.0;
}

/// What a picture has against the rays. Shares of light, 0..1.
struct TracedGap {
    int edges = 0;            ///< pixels where part of the sun is seen
    double rms = 0.0;         ///< over the edges, against a box as wide as the filter
    double filter_rms = 0.0;  ///< the same, with the rays starting where the step along the normal leads
    double darkest = 1.0;     ///< share where no ray of a wide beam is stopped: below 1 is acne
    double lightest = 0.0;    ///< share where every ray of a wide beam is stopped: above 0 is a leak
    int lit = 0, dark = 0;    ///< pixels of those two kinds
};

struct TracedScene {
    std::vector<reference::Triangle> triangles;
    reference::Point toward_sun, across, third;
};

inline reference::Point point_of(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

/// The scene for rays; the sun's axes are made here, by Gram and Schmidt.
inline TracedScene traced_scene(const Scene& scene, const glm::vec3& sun_direction) {
    TracedScene traced;
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
        const auto more = triangles_of(scene, i);
        traced.triangles.insert(traced.triangles.end(), more.begin(), more.end());
    }
    const glm::dvec3 sun = -glm::normalize(glm::dvec3(sun_direction));
    const glm::dvec3 guess(0.6, 0.3, 0.74);
    const glm::dvec3 across = glm::normalize(guess - sun * glm::dot(guess, sun));
    traced.toward_sun = point_of(sun);
    traced.across = point_of(across);
    traced.third = point_of(glm::cross(sun, across));
    return traced;
}

/// The nearest triangle before the eye at a pixel, and where.
struct SeenPlace {
    bool found = false;
    reference::Point at{};
    reference::Point normal{};
};
inline SeenPlace seen_place(const TracedScene& traced, const View& view, int x, int y) {
    glm::dvec3 from(view.eye);
    reference::Point ray = pixel_ray(view, x, y);
    if (view.orthographic) {
        const glm::dmat3 world_from_view = glm::inverse(glm::dmat3(view.view_from_world));
        const double u = (2.0 * (x + 0.5) / view.width - 1.0) / view.clip_from_view[0][0];
        const double v = (1.0 - 2.0 * (y + 0.5) / view.height) / view.clip_from_view[1][1];
        from += world_from_view * glm::dvec3(u, v, 0.0);
        ray = point_of(world_from_view * glm::dvec3(0.0, 0.0, -1.0));
    }
    double nearest = std::numeric_limits<double>::infinity();
    SeenPlace place;
    for (const reference::Triangle& triangle : traced.triangles) {
        const double distance = reference::distance_to(triangle, point_of(from), ray);
        if (!(distance < nearest)) continue;
        nearest = distance;
        place.found = true;
        const auto corner = [&](std::size_t i) {
            return glm::dvec3(triangle.corners[i][0], triangle.corners[i][1], triangle.corners[i][2]);
        };
        place.normal = point_of(glm::normalize(glm::cross(corner(1) - corner(0), corner(2) - corner(0))));
        place.at = point_of(from + distance * glm::dvec3(ray[0], ray[1], ray[2]));
    }
    return place;
}

/// `scene` of flat faces, drawn and traced. `sun_direction`: of the traced sun; another than the scene's plants a wrong
/// formula.
inline TracedGap traced_gap(harness::Ground& ground, const Scene& scene, const View& view, Tier tier,
                            Arithmetic arithmetic, const glm::vec3& sun_direction, std::optional<Tier> surface = {}) {
    const Shares drawn = shares(ground, scene, view, tier, arithmetic, surface);
    const TracedScene traced = traced_scene(scene, sun_direction);
    const double texel = texel_m(scene, view, tier);
    const double filter = (tier == Tier::reference ? 6.0 : 3.25) * texel;  // the box that the taps stand for
    // The taps and their filters reach 2.5 texels (5), the step off the surface as far again, both ways.
    const double wide = (tier == Tier::reference ? 20.0 : 10.0) * texel;
    TracedGap gap;
    const double reach = (tier == Tier::reference ? SHADOW_REACH_REFERENCE : SHADOW_REACH_CONSOLE) * texel;
    double squares = 0.0, filter_squares = 0.0;
    int filter_edges = 0;
    for (int y = 0; y < view.height; ++y) {
        for (int x = 0; x < view.width; ++x) {
            const double share = drawn.at(x, y);
            const SeenPlace place = seen_place(traced, view, x, y);
            if (share < 0.0 || !place.found) continue;
            const auto traced_share = [&](const reference::Point& at, double width, int rays) {
                return reference::lit_share(traced.triangles, at, place.normal, traced.toward_sun, traced.across,
                                            traced.third, width, 1e-2 * texel, rays);
            };
            const double around = traced_share(place.at, wide, 5);
            if (around == 1.0) {
                gap.darkest = std::min(gap.darkest, share);
                ++gap.lit;
                continue;
            }
            if (around == 0.0) {
                gap.lightest = std::max(gap.lightest, share);
                ++gap.dark;
                continue;
            }
            reference::Point stepped = place.at;
            double cosine = 0.0;
            for (std::size_t axis = 0; axis < 3; ++axis) cosine += place.normal[axis] * traced.toward_sun[axis];
            const double lift = reference::plane_lift(std::acos(std::min(std::abs(cosine), 1.0)), reach);
            for (std::size_t axis = 0; axis < 3; ++axis) stepped[axis] += place.normal[axis] * lift;
            if (const double expected = traced_share(place.at, filter, 12); expected > 0.0 && expected < 1.0) {
                squares += (share - expected) * (share - expected);
                ++gap.edges;
            }
            if (const double expected = traced_share(stepped, filter, 12); expected > 0.0 && expected < 1.0) {
                filter_squares += (share - expected) * (share - expected);
                ++filter_edges;
            }
        }
    }
    gap.filter_rms = filter_edges > 0 ? std::sqrt(filter_squares / filter_edges) : 1.0;
    gap.rms = gap.edges > 0 ? std::sqrt(squares / gap.edges) : 0.0;
    return gap;
}

inline TracedGap traced_gap(harness::Ground& ground, const Scene& scene, const View& view, Tier tier,
                            Arithmetic arithmetic) {
    return traced_gap(ground, scene, view, tier, arithmetic, scene.lights.front().direction);
}

}  // namespace halfframe::tests
