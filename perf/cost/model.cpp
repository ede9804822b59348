// The three models, one after the other: they share the norm over units, the band and the naming of what binds.
#include "perf/cost/model.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "engine/error.h"

namespace halfframe::cost {
namespace {

constexpr double kMsPerS = 1e3;

/// One way of shading, one packing: what the band and the branches vary.
struct Setting {
    double packing = 1.0;
    Way way = Way::weighted;
};

const FragmentWork& fragment_of(const DrawWork& draw, Way way) { return draw.fragment[static_cast<std::size_t>(way)]; }

double norm(std::span<const UnitTime> units, double exponent) {
    double sum = 0.0;
    for (const UnitTime& unit : units) sum += std::pow(unit.ms, exponent);
    return std::pow(sum, 1.0 / exponent);
}

bool is_float(gl::PixelFormat format) {
    return format == gl::PixelFormat::rgba32f || format == gl::PixelFormat::rgba16f ||
           format == gl::PixelFormat::r11g11b10f;
}

/// How much slower targets wider than 32 bits are written: `factor` for 64, its square for 128.
double width_factor(int bytes, double factor) { return bytes <= 4 ? 1.0 : bytes <= 8 ? factor : factor * factor; }

double vertex_instructions(const DrawWork& draw) {
    return std::max(co_issued(draw.vertex), static_cast<double>(draw.attributes));
}

class RsxModel {
public:
    RsxModel(const PassWork& pass, const Profile& profile) : pass_(pass), profile_(profile) {}

    std::vector<UnitTime> units(const Setting& setting) const {
        double shader_s = 0.0, target_s = 0.0, vertex_s = 0.0, triangle_s = 0.0;
        for (const DrawWork& draw : pass_.draws) {
            shader_s += draw.fragments_shaded * rsx_passes(fragment_of(draw, setting.way), profile_, setting.packing) *
                        pressure(draw) / (at("fragment_pipes") * at("core_clock"));
            target_s += draw.fragments_written * target_factor(draw) / (at("target_pixels") * at("core_clock"));
            vertex_s += draw.vertices * vertex_instructions(draw) / (at("vertex_pipes") * at("core_clock"));
            triangle_s += draw.triangles * at("triangle_clocks") / at("core_clock");
        }
        const double memory_s = bytes() / (at("memory_rate") * at("memory_efficiency"));
        return {{"shader", shader_s * kMsPerS, true},
                {"targets", target_s * kMsPerS},
                {"memory", memory_s * kMsPerS},
                {"vertices", vertex_s * kMsPerS},
                {"triangles", triangle_s * kMsPerS}};
    }

    double bytes() const {
        double sum = pass_.texture_bytes;
        for (const DrawWork& draw : pass_.draws) {
            if (pass_.color && draw.writes_color)
                sum += draw.fragments_written * gl::bytes_per_pixel(pass_.color->format) * (draw.blends ? 2.0 : 1.0);
            if (!pass_.depth) continue;
            const int depth_bytes = gl::bytes_per_pixel(pass_.depth->format);
            if (draw.tests_depth) sum += std::max(draw.fragments_shaded, draw.fragments_written) * depth_bytes;
            if (draw.writes_depth) sum += draw.fragments_written * depth_bytes;
        }
        return sum;
    }

private:
    [[nodiscard]] double at(const char* key) const { return profile_.at(key); }

    [[nodiscard]] double pressure(const DrawWork& draw) const {
        const double temporaries = draw.temporaries.weighted(at("half_temporary"));
        return std::max(1.0, std::pow(temporaries / at("full_thread_temporaries"), at("pressure_exponent")));
    }

    [[nodiscard]] double target_factor(const DrawWork& draw) const {
        if (!draw.writes_color || !pass_.color) return 1.0 / at("depth_only_factor");
        return width_factor(gl::bytes_per_pixel(pass_.color->format), at("wide_target_factor")) *
               (draw.blends ? at("blend_factor") : 1.0);
    }

    const PassWork& pass_;
    const Profile& profile_;
};

class XenosModel {
public:
    XenosModel(const PassWork& pass, const Profile& profile) : pass_(pass), profile_(profile) {
        for (const auto& target : {pass.color, pass.depth}) {
            if (target)
                tiles_ += edram_tiles(target->width, target->height, target->samples, bytes_on(target->format, profile),
                                      profile);
        }
        const double tile_bytes = at("edram_tile_width") * at("edram_tile_height") * 4.0;
        const double room = at("edram") / tile_bytes;
        replays_ = std::max(1, static_cast<int>(std::ceil(tiles_ / room)));
    }

    std::vector<UnitTime> units(const Setting& setting) const {
        double instructions = 0.0, texels = 0.0, target_s = 0.0, triangle_s = 0.0;
        for (const DrawWork& draw : pass_.draws) {
            const FragmentWork& fragment = fragment_of(draw, setting.way);
            instructions +=
                draw.fragments_shaded * co_issued(fragment.work) + replays_ * draw.vertices * co_issued(draw.vertex);
            for (const FetchWork& fetch : fragment.fetches)
                texels += draw.fragments_shaded * fetch.count * clocks(fetch);
            target_s += draw.fragments_written * target_factor(draw) / (at("target_pixels") * at("core_clock"));
            triangle_s += replays_ * draw.triangles * at("triangle_clocks") / at("core_clock");
        }
        const double shader_s = instructions / (at("shader_units") * at("core_clock") * setting.packing);
        const double texture_s = texels / (at("texels") * at("core_clock") * at("texture_efficiency"));
        const double memory_s = bytes() / (at("memory_rate") * at("memory_efficiency"));
        return {{"arithmetic", shader_s * kMsPerS, true},
                {"texture", texture_s * kMsPerS},
                {"targets", target_s * kMsPerS},
                {"memory", memory_s * kMsPerS},
                {"triangles", triangle_s * kMsPerS}};
    }

    /// Targets live in EDRAM: memory sees textures alone, and the resolves.
    [[nodiscard]] double bytes() const { return pass_.texture_bytes; }

    [[nodiscard]] double resolves_ms() const {
        double sum = 0.0;
        for (const auto& target : {pass_.color, pass_.depth})
            if (target && target->resolved)
                sum += resolve_ms(target->pixels(), bytes_on(target->format, profile_), profile_);
        return sum;
    }
    [[nodiscard]] int tiles() const { return tiles_; }
    [[nodiscard]] int replays() const { return replays_; }

private:
    [[nodiscard]] double at(const char* key) const { return profile_.at(key); }

    [[nodiscard]] double clocks(const FetchWork& fetch) const {
        double clocks = 1.0;
        switch (fetch.format) {
            case TexelFormat::narrow: break;
            case TexelFormat::packed: clocks = at("fetch_packed"); break;
            case TexelFormat::small_float:
            case TexelFormat::half_float: clocks = fetch.target ? at("fetch_packed") : at("fetch_half_float"); break;
            case TexelFormat::full_float: clocks = fetch.target ? at("fetch_packed") : at("fetch_128_bit"); break;
        }
        if (fetch.shape == SamplerUse::Shape::volume) clocks *= at("fetch_volume");
        return fetch.trilinear ? clocks * at("fetch_trilinear") : clocks;
    }

    [[nodiscard]] double target_factor(const DrawWork& draw) const {
        if (!draw.writes_color || !pass_.color) return 1.0;
        const bool blends_slowly = draw.blends && !(draw.additive && is_float(pass_.color->format));
        return width_factor(bytes_on(pass_.color->format, profile_), at("wide_target_factor")) *
               (blends_slowly ? at("blend_factor") : 1.0);
    }

    const PassWork& pass_;
    const Profile& profile_;
    int tiles_ = 0;
    int replays_ = 1;
};

class TilerModel {
public:
    TilerModel(const PassWork& pass, const Profile& profile) : pass_(pass), profile_(profile) {}

    std::vector<UnitTime> units(const Setting& setting) const {
        double pixels = 0.0, mads = 0.0, texels = 0.0, vertex_s = 0.0;
        for (const DrawWork& draw : pass_.draws) {
            const FragmentWork& fragment = fragment_of(draw, setting.way);
            pixels += std::max(draw.fragments_shaded, draw.fragments_written);
            mads += draw.fragments_shaded * fragment.work.mads;
            for (const FetchWork& fetch : fragment.fetches)
                texels += draw.fragments_shaded * fetch.count * clocks(fetch);
            vertex_s += draw.vertices * vertex_instructions(draw) / at("vertex_instructions");
        }
        const double core_rate = at("fragment_cores") * at("core_clock");
        const double arithmetic_s = mads / (at("mads") * at("core_clock") * setting.packing);
        return {{"arithmetic", arithmetic_s * kMsPerS, true},
                {"texture", texels / core_rate * kMsPerS},
                {"pixels", pixels / core_rate * kMsPerS},
                {"memory", bytes() / at("memory_rate") * kMsPerS},
                {"vertices", vertex_s * kMsPerS}};
    }

    /// Each target once a pass; samples of a pixel are averaged before they leave the tile.
    [[nodiscard]] double bytes() const {
        double sum = pass_.texture_bytes;
        for (const auto& target : {pass_.color, pass_.depth}) {
            if (!target) continue;
            const double once = target->pixels() * gl::bytes_per_pixel(target->format);
            sum += once * ((target->stored ? 1.0 : 0.0) + (target->loaded ? 1.0 : 0.0));
        }
        return sum;
    }

private:
    [[nodiscard]] double at(const char* key) const { return profile_.at(key); }
    [[nodiscard]] double clocks(const FetchWork& fetch) const {
        double clocks =
            fetch.format == TexelFormat::half_float || fetch.format == TexelFormat::full_float ? at("fetch_wide") : 1.0;
        if (fetch.shape == SamplerUse::Shape::volume) clocks *= at("fetch_volume");
        return fetch.trilinear ? clocks * at("fetch_trilinear") : clocks;
    }

    const PassWork& pass_;
    const Profile& profile_;
};

/// Work of a fragment in the currency of the device, as a mean over the fragments of the pass.
double mean_work(const PassWork& pass, const Profile& profile) {
    double sum = 0.0, fragments = 0.0;
    for (const DrawWork& draw : pass.draws) {
        const FragmentWork& fragment = fragment_of(draw, Way::weighted);
        double work = fragment.work.mads;
        if (profile.model == ModelKind::rsx) work = rsx_passes(fragment, profile, profile.at("packing_efficiency"));
        if (profile.model == ModelKind::xenos) work = co_issued(fragment.work);
        sum += draw.fragments_shaded * work;
        fragments += draw.fragments_shaded;
    }
    return fragments > 0.0 ? sum / fragments : 0.0;
}

std::string bound_of(const PassCost& cost) {
    const auto most = std::ranges::max_element(cost.units, {}, &UnitTime::ms);
    if (cost.ms <= 0.0) return "nothing";
    if (cost.resolve_ms > most->ms && cost.resolve_ms > cost.fixed_ms) return "resolve";
    return cost.fixed_ms > most->ms ? "draws and switches" : most->unit;
}

template <typename Model>
PassCost with(const Model& model, const PassWork& pass, const Profile& profile, int replays, double resolves_ms) {
    PassCost cost{.name = pass.name};
    const double exponent = profile.at("overlap_exponent");
    cost.fixed_ms = kMsPerS * ((pass.switches_target ? profile.at("target_switch") : 0.0) +
                               replays * static_cast<double>(pass.draws.size()) * profile.at("draw"));
    cost.resolve_ms = resolves_ms;
    const auto time = [&](double packing, Way way) {
        return norm(model.units({packing, way}), exponent) + cost.fixed_ms + cost.resolve_ms;
    };
    const double packing = profile.at("packing_efficiency");
    cost.units = model.units({packing, Way::weighted});
    cost.ms = time(packing, Way::weighted);
    cost.low_ms = time(profile.at("packing_best"), Way::weighted);
    cost.high_ms = time(profile.at("packing_worst"), Way::weighted);
    cost.shortest_ms = time(packing, Way::shortest);
    cost.longest_ms = time(packing, Way::longest);
    cost.memory_bytes = model.bytes();
    cost.bound = bound_of(cost);
    cost.passes = mean_work(pass, profile);
    for (const DrawWork& draw : pass.draws) cost.temporaries = std::max(cost.temporaries, draw.temporaries.weighted());
    return cost;
}

double rsx_clocks(const FetchWork& fetch, const Profile& profile) {
    double clocks = fetch.trilinear ? profile.at("fetch_trilinear") : 1.0;
    if (fetch.shape == SamplerUse::Shape::volume) clocks *= profile.at("fetch_volume");
    if (fetch.format == TexelFormat::full_float) return clocks * profile.at("fetch_float");
    const bool half = fetch.format == TexelFormat::half_float || fetch.format == TexelFormat::small_float;
    return half ? clocks * profile.at("fetch_half_float") : clocks;
}

}  // namespace

TexelFormat texel_format(gl::PixelFormat format) {
    switch (format) {
        case gl::PixelFormat::rgba32f: return TexelFormat::full_float;
        case gl::PixelFormat::rgba16f: return TexelFormat::half_float;
        case gl::PixelFormat::r11g11b10f: return TexelFormat::small_float;
        case gl::PixelFormat::rgb10_a2: return TexelFormat::packed;
        default: return TexelFormat::narrow;
    }
}

const char* name(TexelFormat format) {
    switch (format) {
        case TexelFormat::narrow: return "up to 32 bits";
        case TexelFormat::packed: return "10:10:10:2";
        case TexelFormat::small_float: return "11:11:10 float";
        case TexelFormat::half_float: return "fp16";
        case TexelFormat::full_float: return "fp32";
    }
    return "";
}

double rsx_passes(const FragmentWork& fragment, const Profile& profile, double packing) {
    double fetches = 0.0, clocks = 0.0;
    for (const FetchWork& fetch : fragment.fetches) {
        fetches += fetch.count;
        clocks += fetch.count * rsx_clocks(fetch, profile);
    }
    const double slots = fragment.work.slots + profile.at("half_normalize_slots") * fragment.work.normalizes + fetches;
    return std::max(clocks, slots / (profile.at("units_per_pipe") * packing) + clocks - fetches);
}

int edram_tiles(int width, int height, int samples, int bytes_per_sample, const Profile& profile) {
    const int across = samples >= 4 ? 2 : 1;  // 2 samples lie below each other, 4 in a square
    const int down = samples >= 2 ? 2 : 1;
    const double columns = std::ceil(width * across / profile.at("edram_tile_width"));
    const double rows = std::ceil(height * down / profile.at("edram_tile_height"));
    return static_cast<int>(columns * rows * std::max(1, bytes_per_sample / 4));
}

double resolve_ms(double pixels, double bytes_per_pixel, const Profile& profile) {
    const double copy_s = pixels / (profile.at("resolve_pixels") * profile.at("core_clock"));
    const double memory_s = pixels * bytes_per_pixel / (profile.at("memory_rate") * profile.at("memory_efficiency"));
    return kMsPerS * std::max(copy_s, memory_s);
}

int bytes_on(gl::PixelFormat format, const Profile& profile) {
    if (profile.model != ModelKind::xenos) return gl::bytes_per_pixel(format);
    return is_float(format) || gl::is_depth(format) ? 4 : gl::bytes_per_pixel(format);
}

PassCost cost_of(const PassWork& pass, const Profile& profile) {
    switch (profile.model) {
        case ModelKind::rsx: return with(RsxModel(pass, profile), pass, profile, 1, 0.0);
        case ModelKind::tiler: return with(TilerModel(pass, profile), pass, profile, 1, 0.0);
        case ModelKind::xenos: {
            const XenosModel model(pass, profile);
            PassCost cost = with(model, pass, profile, model.replays(), model.resolves_ms());
            cost.edram_tiles = model.tiles();
            cost.edram_replays = model.replays();
            return cost;
        }
    }
    throw Mistake("a profile without a model");
}

}  // namespace halfframe::cost
