// Names and limits of the tiers.
#include "engine/frame/tier.h"

#include "engine/error.h"

namespace halfframe {

const char* name(Tier tier) {
    switch (tier) {
        case Tier::low: return "low";
        case Tier::console: return "console";
        case Tier::reference: return "reference";
    }
    throw Mistake("a tier without a name");
}

std::optional<Tier> tier_from_name(std::string_view text) {
    for (const Tier tier : {Tier::low, Tier::console, Tier::reference}) {
        if (text == name(tier)) return tier;
    }
    return std::nullopt;
}

const char* name(Arithmetic arithmetic) { return arithmetic == Arithmetic::half ? "half" : "full"; }

double bytes_per_pixel_limit(Tier tier) {
    switch (tier) {
        case Tier::low: return 12.0;      // RGBA8 + depth16 is 6; as much again for one shared helper
        case Tier::console: return 24.0;  // RGBA16F 8 + depth24 4 + display 4 = 16; 8 left for effects
        case Tier::reference:
            return 128.0;  // 4 samples of RGBA32F 16 + depth24 4, resolved 16, display 4 = 100; 28 left for effects
    }
    throw Mistake("a tier without a limit");
}

}  // namespace halfframe
