// Hard cases, all halves, and draws after dEQP's: exponents dense near 0, special values, odd significands.
#include "perf/stability/inputs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include <fmt/format.h>

#include "engine/error.h"
#include "perf/stability/criterion.h"

namespace halfframe::stability {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLargestHalf = 65504.0;

/// FNV-1a: the same seed for the same function in every build.
std::uint64_t seed_of(std::string_view text) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const char letter : text) hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001b3u;
    return hash;
}

bool in_domain(const Domain& domain, double x) {
    if (domain.kind == Domain::Kind::any) return true;
    if (domain.kind == Domain::Kind::unit) return std::fabs(x) <= 1.0;
    return x >= domain.low && x <= domain.high;  // false for NaN
}

/// -0 and 0 are two numbers here.
void sort_and_unite(std::vector<double>& values) {
    const auto before = [](double a, double b) {
        if (std::isnan(a) || std::isnan(b)) return !std::isnan(a) && std::isnan(b);
        return a < b || (a == b && std::signbit(a) && !std::signbit(b));
    };
    std::ranges::sort(values, before);
    values.erase(
        std::unique(values.begin(), values.end(), [&](double a, double b) { return !before(a, b) && !before(b, a); }),
        values.end());
}

void normalize(const DeclaredParameter& parameter, std::vector<double>& direction) {
    double square = 0.0;
    for (const double x : direction) square += x * x;
    for (double& x : direction) x = held(parameter, x / std::sqrt(square));
}

}  // namespace

double held(const DeclaredParameter& parameter, double x) {
    if (parameter.whole) return static_cast<double>(static_cast<float>(std::round(x))) + 0.0;  // no -0
    return parameter.full ? static_cast<double>(static_cast<float>(x)) : shader_ir::rounded(shader_ir::Model::half, x);
}

std::vector<double> hard_values(const DeclaredParameter& parameter, const std::vector<double>& constants) {
    const Domain& domain = parameter.domain;
    std::vector<double> base{0.0, 0x1p-24, 0x1p-14, 0.5, 1.0, 255.0, 256.0, kLargestHalf};
    if (parameter.whole) base.insert(base.end(), {2.0, 31.0, 65535.0, 0x1p24, 0x1p31});
    else if (parameter.full) base.insert(base.end(), {0x1p-126, 0x1p-100, 0x1p100});
    if (domain.kind == Domain::Kind::range) base.insert(base.end(), {domain.low, domain.high});
    base.insert(base.end(), constants.begin(), constants.end());
    std::vector<double> values;
    const auto add = [&](double x) {
        for (const double sign : {1.0, -1.0}) {
            const double value = held(parameter, sign * x);
            if (in_domain(domain, value)) values.push_back(value);
        }
    };
    for (const double x : base) {
        const double step = parameter.whole ? 1.0 : step_at(x, Format::gradual, parameter.full);
        for (const double neighbour : {x, x + step, x - step}) add(neighbour);
    }
    if (domain.kind == Domain::Kind::any)
        values.insert(values.end(), {kInfinity, -kInfinity, std::numeric_limits<double>::quiet_NaN()});
    sort_and_unite(values);
    return values;
}

std::vector<std::vector<double>> hard_directions(const DeclaredParameter& parameter) {
    std::vector<std::vector<double>> directions;
    const auto size = static_cast<std::size_t>(parameter.components);
    const auto add = [&](std::vector<double> direction) {
        direction.resize(size, 0.0);
        normalize(parameter, direction);
        directions.push_back(std::move(direction));
    };
    for (const double sign : {1.0, -1.0}) {
        for (std::size_t axis = 0; axis < size; ++axis) {
            std::vector<double> direction(size, 0.0);
            direction[axis] = sign;
            add(direction);
            // Beside an axis: half a highlight of power 2048 away, two steps of half, a subnormal.
            for (const double aside : {0x1p-5, 0x1p-10, 0x1p-24}) {
                direction[(axis + 1) % size] = aside;
                if (sign > 0.0) add(direction);
            }
        }
        add({sign, sign});
        add({sign, 1.0, 1.0});
    }
    return directions;
}

std::vector<double> all_halves(const DeclaredParameter& parameter) {
    std::vector<double> values;
    for (std::uint32_t bits = 0; bits < 65536; ++bits) {
        const double x = shader_ir::value_of_half(static_cast<std::uint16_t>(bits));
        const bool one_nan_is_enough = std::isnan(x) && bits != 0x7e00u;
        if (parameter.whole && x != std::floor(x)) continue;
        if (in_domain(parameter.domain, x) && !one_nan_is_enough) values.push_back(parameter.whole ? x + 0.0 : x);
    }
    sort_and_unite(values);
    return values;
}

InputSource::InputSource(const Subject& subject, const Effort& effort)
    : subject_(subject), effort_(effort), random_(seed_of(subject.function().file + subject.title())) {
    const Declaration& function = subject.function();
    every_half_ = subject.components() == 1;
    for (const DeclaredParameter& parameter : function.parameters) {
        if (parameter.domain.kind == Domain::Kind::unit) {
            axes_.push_back({hard_directions(parameter)});
            continue;
        }
        for (int component = 0; component < parameter.components; ++component) {
            Axis& axis = axes_.emplace_back();
            for (const double x : every_half_ ? all_halves(parameter) : hard_values(parameter, subject.constants()))
                axis.values.push_back({x});
        }
    }
    for (const Axis& axis : axes_) {
        if (axis.values.empty())
            throw Error(Fault::usage, function.place() + ": no half lies in the domain of " + function.name +
                                          "; half ends at 65504, and what is larger is for FULL parameters");
        combinations_ *= static_cast<double>(axis.values.size());
    }
    every_combination_ = every_half_ || combinations_ <= static_cast<double>(effort.combinations);
    planned_ = (every_combination_ ? static_cast<std::size_t>(combinations_) : effort.combinations) +
               (every_half_ && !function.parameters[0].full ? 0 : effort.drawn);
}

std::string InputSource::method() const {
    if (every_half_) {
        return planned_ > axes_[0].values.size()
                   ? fmt::format("all {} halves and {} drawn floats", axes_[0].values.size(), effort_.drawn)
                   : fmt::format("all {} halves", axes_[0].values.size());
    }
    return every_combination_ ? fmt::format("all {:.0f} combinations and {} drawn", combinations_, effort_.drawn)
                              : fmt::format("{} of {:.2g} combinations and {} drawn", effort_.combinations,
                                            combinations_, effort_.drawn);
}

std::vector<double> InputSource::combination(std::uint64_t index) {
    std::vector<double> lane;
    for (const Axis& axis : axes_) {
        const std::uint64_t at = every_combination_ ? index % axis.values.size() : random_() % axis.values.size();
        index /= axis.values.size();
        lane.insert(lane.end(), axis.values[at].begin(), axis.values[at].end());
    }
    return lane;
}

void InputSource::draw_number(const DeclaredParameter& parameter, std::vector<double>& lane) {
    const Domain& domain = parameter.domain;
    const bool any = domain.kind == Domain::Kind::any;
    const double low = any ? -kLargestHalf : domain.low, high = any ? kLargestHalf : domain.high;
    // Half of them even in value; half with an exponent whose cube root is even, which is dense near 0.
    for (int attempt = 0; attempt < 64; ++attempt) {
        double x = low + uniform() * (high - low);
        if ((random_() & 1u) != 0) {
            const double root = 2.0 * uniform() - 1.0;
            const double exponent = std::round(root * root * root * (parameter.full ? 40.0 : 15.0));
            const std::uint64_t kind = random_() % 17;
            const double fraction = kind == 0 ? 1.0 : kind == 1 ? 2.0 - 0x1p-10 : 1.0 + uniform();
            x = std::ldexp(fraction, static_cast<int>(exponent)) * ((random_() & 1u) != 0 ? 1.0 : -1.0);
        }
        x = held(parameter, x);
        if (!in_domain(domain, x)) continue;
        lane.push_back(x);
        return;
    }
    lane.push_back(held(parameter, low));
}

/// Every other direction lies near the one before: highlights are where n and h almost meet.
void InputSource::draw_direction(const DeclaredParameter& parameter, std::vector<double>& lane,
                                 std::vector<double>& last_direction) {
    std::vector<double> direction(static_cast<std::size_t>(parameter.components));
    const bool beside = last_direction.size() == direction.size() && (random_() & 1u) != 0;
    const double spread = beside ? std::ldexp(1.0, -static_cast<int>(random_() % 14)) : 1.0;
    double square = 0.0;
    do {
        square = 0.0;
        for (std::size_t s = 0; s < direction.size(); ++s) {
            direction[s] = (2.0 * uniform() - 1.0) * spread + (beside ? last_direction[s] : 0.0);
            square += direction[s] * direction[s];
        }
    } while (square < 1e-6);
    normalize(parameter, direction);
    lane.insert(lane.end(), direction.begin(), direction.end());
    last_direction = direction;
}

std::vector<double> InputSource::drawn() {
    std::vector<double> lane;
    std::vector<double> last_direction;
    std::size_t axis = 0;
    for (const DeclaredParameter& parameter : subject_.function().parameters) {
        const bool direction = parameter.domain.kind == Domain::Kind::unit;
        const auto components = direction ? 1 : static_cast<std::size_t>(parameter.components);
        for (std::size_t s = 0; s < components; ++s, ++axis) {
            if (random_() % 16 == 0) {  // a hard case among drawn ones
                const std::vector<double>& value = axes_[axis].values[random_() % axes_[axis].values.size()];
                lane.insert(lane.end(), value.begin(), value.end());
                if (direction) last_direction = value;
            } else if (direction) {
                draw_direction(parameter, lane, last_direction);
            } else {
                draw_number(parameter, lane);
            }
        }
    }
    return lane;
}

Batch InputSource::next(std::size_t lanes) {
    const std::size_t lattice = every_combination_ ? static_cast<std::size_t>(combinations_) : effort_.combinations;
    while (given_ < planned_) {
        std::vector<std::vector<double>> chosen;
        for (; given_ < planned_ && chosen.size() < lanes; ++given_)
            chosen.push_back(given_ < lattice ? combination(given_) : drawn());
        const Batch batch = batch_of(subject_.function(), chosen);
        const std::vector<bool> meant = subject_.meant(batch);
        std::vector<std::vector<double>> kept;
        for (std::size_t lane = 0; lane < chosen.size(); ++lane) {
            if (meant[lane]) kept.push_back(std::move(chosen[lane]));
        }
        if (!kept.empty()) return batch_of(subject_.function(), kept);
    }
    return {};
}

std::vector<std::vector<double>> InputSource::sweep(std::size_t parameter, std::size_t points) {
    const DeclaredParameter& moved = subject_.function().parameters[parameter];
    expect(moved.domain.kind == Domain::Kind::range, [&] {
        return subject_.function().place() + ": only a parameter with a range can be promised to be monotone";
    });
    std::vector<double> values = all_halves(moved);
    if (values.size() > points) {
        const double stride = static_cast<double>(values.size() - 1) / static_cast<double>(points - 1);
        for (std::size_t i = 0; i < points; ++i)
            values[i] = values[static_cast<std::size_t>(std::round(stride * static_cast<double>(i)))];
        values.resize(points);
    }
    std::vector<std::vector<double>> lanes(values.size(), drawn());
    std::size_t first = 0;
    for (std::size_t p = 0; p < parameter; ++p)
        first += static_cast<std::size_t>(subject_.function().parameters[p].components);
    for (std::size_t i = 0; i < values.size(); ++i)
        std::fill_n(lanes[i].begin() + static_cast<std::ptrdiff_t>(first), moved.components, values[i]);
    const std::vector<bool> meant = subject_.meant(batch_of(subject_.function(), lanes));
    std::size_t lane = 0;
    std::erase_if(lanes, [&](const std::vector<double>&) { return !meant[lane++]; });
    return lanes;
}

}  // namespace halfframe::stability
