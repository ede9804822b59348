// Deterministic inputs: the corners of a box, then a low-discrepancy sequence inside it.
#pragma once

#include <cstddef>
#include <vector>

namespace halfframe::accuracy {

/// Points of the unit cube, one array per dimension: its 2^dimensions corners first, then 4096 points of Richtmyer's
/// sequence (multiples of the square roots of primes, modulo 1), which has no seed and fills evenly. 1 to 10
/// dimensions.
[[nodiscard]] std::vector<std::vector<double>> unit_cube(std::size_t dimensions);

}  // namespace halfframe::accuracy
