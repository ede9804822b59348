// Materials against the charts: percentiles, and the shares that break a rule.
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "perf/check/check.h"
#include "perf/check/texels.h"

namespace halfframe::check {
namespace {

/// Counts values of a known range in bins fine enough for whole codes and hundredths.
class Histogram {
public:
    explicit Histogram(double highest) : highest_(highest) {}
    void add(double value) {
        const double bin = std::clamp(value / highest_, 0.0, 1.0) * (kBins - 1);
        ++bins_[static_cast<std::size_t>(bin + 0.5)];
        ++count_;
    }
    [[nodiscard]] Percentiles percentiles() const { return {at(0.05), at(0.50), at(0.95)}; }

private:
    static constexpr std::size_t kBins = 2551;  ///< tenths of a code
    [[nodiscard]] double at(double share) const {
        const double wished = share * static_cast<double>(count_);
        std::size_t seen = 0;
        for (std::size_t bin = 0; bin < kBins; ++bin) {
            seen += bins_[bin];
            if (seen > 0 && static_cast<double>(seen) >= wished) {
                return highest_ * static_cast<double>(bin) / (kBins - 1);
            }
        }
        return 0.0;
    }
    double highest_;
    std::size_t count_ = 0;
    std::array<std::size_t, kBins> bins_{};
};

MaterialFigures figures_of(const Scene& scene, const Material& material, const Thresholds& thresholds) {
    MaterialFigures figures;
    figures.name = material.name;
    figures.unlit = material.model == MaterialModel::unlit;
    const MaterialTexels texels(scene, material, thresholds);
    const std::vector<std::uint8_t> reached = texels.reached();
    Histogram albedo(255.0);
    Histogram specular(255.0);
    Histogram metallic(1.0);
    Histogram smoothness(1.0);
    std::array<std::size_t, kTexelRuleCount> broken{};
    for (int y = 0; y < texels.height(); ++y) {
        for (int x = 0; x < texels.width(); ++x) {
            const auto row = static_cast<std::size_t>(y) * static_cast<std::size_t>(texels.width());
            if (reached[row + static_cast<std::size_t>(x)] == 0) continue;
            const Texel texel = texels.at(x, y);
            ++figures.texels;
            albedo.add(texel.albedo_code);
            specular.add(texel.specular_code);
            metallic.add(texel.metallic);
            smoothness.add(texel.smoothness);
            const std::uint32_t bits = figures.unlit ? 0u : texels.broken(texel);
            for (std::size_t rule = 0; rule < broken.size(); ++rule) broken[rule] += bits >> rule & 1u;
        }
    }
    figures.albedo = albedo.percentiles();
    figures.specular = specular.percentiles();
    figures.metallic = metallic.percentiles();
    figures.smoothness = smoothness.percentiles();
    for (std::size_t rule = 0; rule < broken.size() && figures.texels > 0; ++rule) {
        figures.broken[rule] = static_cast<double>(broken[rule]) / static_cast<double>(figures.texels);
    }
    return figures;
}

/// "12, 40, 51 at 5, 50, 95 %", or "40" where there is one texel. `digits` after the point.
std::string values(const Percentiles& p, std::size_t texels, int digits) {
    if (texels == 1) return fmt::format("{:.{}f}", p.p50, digits);
    return fmt::format("{0:.{3}f}, {1:.{3}f}, {2:.{3}f} at 5, 50, 95 %", p.p5, p.p50, p.p95, digits);
}

/// What the rule looked at, for the sentence.
std::string measured(const MaterialFigures& figures, RuleId id, const Thresholds& limits) {
    const auto codes = [&](const char* what, const Percentiles& p, const std::string& wished) {
        return fmt::format("the {} is {}, wished is {}", what, values(p, figures.texels, 0), wished);
    };
    const auto range = [](const Range& wished) {
        return fmt::format("{:.0f} to {:.0f}", wished.lowest, wished.highest);
    };
    switch (id) {
        case RuleId::albedo_dark:
        case RuleId::albedo_bright: return codes("albedo", figures.albedo, range(limits.albedo));
        case RuleId::metal_albedo:
            return codes("albedo", figures.albedo, fmt::format("0 to {:.0f}", limits.metal_albedo_highest));
        case RuleId::dielectric_specular: return codes("specular", figures.specular, range(limits.dielectric_specular));
        case RuleId::metal_specular: return codes("specular", figures.specular, range(limits.metal_specular));
        case RuleId::specular_gap:
            return codes("specular", figures.specular,
                         fmt::format("at most {:.0f} or at least {:.0f}", limits.dielectric_specular.highest,
                                     limits.metal_specular.lowest));
        case RuleId::metallic_between:
            return fmt::format("metallic is {}, wished is at most {} or at least {}",
                               values(figures.metallic, figures.texels, 2), limits.metallic_between.lowest,
                               limits.metallic_between.highest);
        default:
            return fmt::format("smoothness is {}, wished is {} to {}", values(figures.smoothness, figures.texels, 2),
                               limits.smoothness.lowest, limits.smoothness.highest);
    }
}

void judge(const MaterialFigures& figures, const Thresholds& limits, std::vector<Finding>& findings) {
    for (std::size_t index = 0; index < figures.broken.size(); ++index) {
        const double share = figures.broken[index];
        if (share <= 0.0 || share < limits.warning_share) continue;
        const auto id = static_cast<RuleId>(index);
        Finding finding{.rule = id, .level = share >= limits.error_share ? Level::error : Level::warning};
        // The ends of smoothness are a matter of taste and glTF's own default: never more than a note.
        if (id == RuleId::smoothness_ends) finding.level = Level::note;
        finding.place = figures.place;
        finding.thing = fmt::format("material '{}'", figures.name);
        finding.words = measured(figures, id, limits);
        if (figures.texels > 1) {
            finding.words = fmt::format("{:.0f} % of {} texels: {}", 100.0 * share, figures.texels, finding.words);
        }
        findings.push_back(std::move(finding));
    }
}

}  // namespace

void check_materials(const Scene& scene, const Request& request, const Places& places, Report& report) {
    std::set<int> used;
    for (const Surface& surface : scene.surfaces) used.insert(surface.material);
    for (const int index : used) {
        MaterialFigures figures =
            figures_of(scene, scene.materials[static_cast<std::size_t>(index)], request.thresholds);
        figures.place = places.material(index);
        judge(figures, request.thresholds, report.findings);
        report.materials.push_back(std::move(figures));
    }
}

}  // namespace halfframe::check
