// Numbers from a seed, the same with every compiler: integers, and floats made of 24 of their bits.
#pragma once

#include <cstdint>

namespace halfframe::content {

/// A well-mixed 32-bit number of two (multiply, shift and xor; constants of the PCG family, M. O'Neill 2014).
[[nodiscard]] inline std::uint32_t mixed(std::uint32_t a, std::uint32_t b) {
    std::uint32_t state = (a * 747796405u + b * 2891336453u) + 277803737u;
    state = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (state >> 22u) ^ state;
}

/// A stream of numbers. Streams of one seed and different keys have nothing to do with each other, so that one part of
/// a scene may draw more numbers without moving another.
class Random {
public:
    Random(std::uint32_t seed, std::uint32_t key) : seed_(mixed(seed, mixed(key, 0x51ed270bu))) {}
    [[nodiscard]] std::uint32_t next() { return mixed(seed_, count_++); }
    /// 0 up to, but not, 1
    [[nodiscard]] float unit() { return static_cast<float>(next() >> 8u) * (1.0f / 16777216.0f); }
    [[nodiscard]] float between(float low, float high) { return low + (high - low) * unit(); }
    /// 0..count - 1
    [[nodiscard]] int below(int count) {
        return static_cast<int>((std::uint64_t{next()} * static_cast<std::uint64_t>(count)) >> 32u);
    }
    [[nodiscard]] bool chance(float probability) { return unit() < probability; }
    [[nodiscard]] Random fork(std::uint32_t key) const { return {seed_, key}; }

private:
    std::uint32_t seed_;
    std::uint32_t count_ = 0;
};

}  // namespace halfframe::content
