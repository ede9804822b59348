// Which inputs a function is tried with: all halves, the hard cases in all combinations, and a search with a fixed
// seed.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "perf/stability/subject.h"

namespace halfframe::stability {

/// How many inputs.
struct Effort {
    std::size_t combinations = 16384;  ///< of hard cases at most
    std::size_t drawn = 8192;          ///< at random
    std::size_t sweeps = 8;            ///< of each parameter that is promised to be monotone
    std::size_t sweep_points = 512;
};
inline constexpr Effort kFastEffort{};
inline constexpr Effort kFullEffort{.combinations = 10'000'000, .drawn = 262'144, .sweeps = 64, .sweep_points = 8192};

/// Numbers of the domain, each as its parameter's precision holds it, by size.
[[nodiscard]] std::vector<double> hard_values(const DeclaredParameter& parameter, const std::vector<double>& constants);
/// Directions along axes, between them, and just beside.
[[nodiscard]] std::vector<std::vector<double>> hard_directions(const DeclaredParameter& parameter);
/// Every half of the domain, by size.
[[nodiscard]] std::vector<double> all_halves(const DeclaredParameter& parameter);

/// Hands out inputs in batches, the same ones in every run.
class InputSource {
public:
    InputSource(const Subject& subject, const Effort& effort);

    /// The next batch, at most `lanes` long, of inputs that the declaration means; empty when all were given.
    [[nodiscard]] Batch next(std::size_t lanes);
    /// How they were chosen, for a reader: "all 15361 halves", "16384 of 4.1e9 combinations and 8192 drawn".
    [[nodiscard]] std::string method() const;
    [[nodiscard]] std::size_t planned() const { return planned_; }

    /// Up to `points` inputs that differ in one parameter alone, which grows through its domain, all its components
    /// alike. May be empty, where the declaration means none of them.
    [[nodiscard]] std::vector<std::vector<double>> sweep(std::size_t parameter, std::size_t points);

private:
    /// One axis of the lattice: a number or a direction.
    struct Axis {
        std::vector<std::vector<double>> values;
    };
    [[nodiscard]] std::vector<double> combination(std::uint64_t index);
    [[nodiscard]] std::vector<double> drawn();
    void draw_number(const DeclaredParameter& parameter, std::vector<double>& lane);
    void draw_direction(const DeclaredParameter& parameter, std::vector<double>& lane,
                        std::vector<double>& last_direction);
    [[nodiscard]] double uniform() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

    const Subject& subject_;
    Effort effort_;
    std::mt19937_64 random_;
    std::vector<Axis> axes_;
    double combinations_ = 1.0;  ///< of the whole lattice
    bool every_half_ = false;
    bool every_combination_ = false;
    std::size_t planned_ = 0;
    std::size_t given_ = 0;
};

/// x as the parameter's precision holds it.
[[nodiscard]] double held(const DeclaredParameter& parameter, double x);

}  // namespace halfframe::stability
