// The reference packing of uniforms and varyings: GLSL ES 1.00 Appendix A.7, steps in the order of the text.
#include <algorithm>
#include <array>
#include <cstddef>

#include "tests/shaders/glslang_gate.h"

namespace halfframe::shaders {
namespace {

using Grid = std::vector<std::array<bool, 4>>;  // true: taken

bool fits(const Grid& grid, int row, int first_column, const PackedVariable& variable) {
    for (int y = row; y < row + variable.rows; ++y) {
        for (int x = first_column; x < first_column + variable.columns; ++x) {
            if (grid[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)]) return false;
        }
    }
    return true;
}

void take(Grid& grid, int row, int first_column, const PackedVariable& variable) {
    for (int y = row; y < row + variable.rows; ++y) {
        for (int x = first_column; x < first_column + variable.columns; ++x) {
            grid[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] = true;
        }
    }
}

bool place_downwards(Grid& grid, int first_column, const PackedVariable& variable) {
    for (int row = 0; row + variable.rows <= static_cast<int>(grid.size()); ++row) {
        if (!fits(grid, row, first_column, variable)) continue;
        take(grid, row, first_column, variable);
        return true;
    }
    return false;
}

bool place_upwards(Grid& grid, int first_column, const PackedVariable& variable) {
    for (int row = static_cast<int>(grid.size()) - variable.rows; row >= 0; --row) {
        if (!fits(grid, row, first_column, variable)) continue;
        take(grid, row, first_column, variable);
        return true;
    }
    return false;
}

/// A scalar goes to the column with the fewest free rows in which it still fits.
bool place_scalar(Grid& grid, const PackedVariable& variable) {
    std::array<int, 4> columns = {0, 1, 2, 3};
    const auto free_rows = [&](int column) {
        return std::count_if(grid.begin(), grid.end(),
                             [&](const auto& row) { return !row[static_cast<std::size_t>(column)]; });
    };
    std::stable_sort(columns.begin(), columns.end(), [&](int a, int b) { return free_rows(a) < free_rows(b); });
    return std::any_of(columns.begin(), columns.end(),
                       [&](int column) { return place_downwards(grid, column, variable); });
}

bool pack(const std::vector<PackedVariable>& variables, int rows) {
    Grid grid(static_cast<std::size_t>(rows));
    for (const PackedVariable& variable : variables) {
        bool placed = false;
        if (variable.columns >= 3) placed = place_downwards(grid, 0, variable);
        if (variable.columns == 2) placed = place_downwards(grid, 0, variable) || place_upwards(grid, 2, variable);
        if (variable.columns == 1) placed = place_scalar(grid, variable);
        if (!placed) return false;
    }
    return true;
}

}  // namespace

int packed_rows(std::vector<PackedVariable> variables) {
    // Widest first, and among equals the longest array first.
    std::stable_sort(variables.begin(), variables.end(), [](const PackedVariable& a, const PackedVariable& b) {
        return a.columns != b.columns ? a.columns > b.columns : a.rows > b.rows;
    });
    int upper = 0;
    for (const PackedVariable& variable : variables) upper += variable.rows;
    for (int rows = 0; rows < upper; ++rows) {
        if (pack(variables, rows)) return rows;
    }
    return upper;
}

}  // namespace halfframe::shaders
