// A font of 5 x 7 squares, one quad for each run of squares in a row.
#include "content/charts/block_letters.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace halfframe::content {
namespace {

constexpr int kColumns = 5;
constexpr int kRows = 7;
constexpr int kStep = kColumns + 1;  ///< squares from one letter to the next

struct BlockLetter {
    char letter;
    std::array<unsigned, kRows> rows;  ///< from the top; bit 4 is the leftmost square
};
// clang-format off
constexpr std::array kLetters = {
    BlockLetter{'A', {14, 17, 17, 31, 17, 17, 17}}, BlockLetter{'B', {30, 17, 17, 30, 17, 17, 30}},
    BlockLetter{'C', {14, 17, 16, 16, 16, 17, 14}}, BlockLetter{'D', {30, 17, 17, 17, 17, 17, 30}},
    BlockLetter{'E', {31, 16, 16, 30, 16, 16, 31}}, BlockLetter{'F', {31, 16, 16, 30, 16, 16, 16}},
    BlockLetter{'G', {14, 17, 16, 23, 17, 17, 14}}, BlockLetter{'H', {17, 17, 17, 31, 17, 17, 17}},
    BlockLetter{'I', {14,  4,  4,  4,  4,  4, 14}}, BlockLetter{'J', { 7,  2,  2,  2,  2, 18, 12}},
    BlockLetter{'K', {17, 18, 20, 24, 20, 18, 17}}, BlockLetter{'L', {16, 16, 16, 16, 16, 16, 31}},
    BlockLetter{'M', {17, 27, 21, 21, 17, 17, 17}}, BlockLetter{'N', {17, 25, 21, 19, 17, 17, 17}},
    BlockLetter{'O', {14, 17, 17, 17, 17, 17, 14}}, BlockLetter{'P', {30, 17, 17, 30, 16, 16, 16}},
    BlockLetter{'Q', {14, 17, 17, 17, 21, 18, 13}}, BlockLetter{'R', {30, 17, 17, 30, 20, 18, 17}},
    BlockLetter{'S', {15, 16, 16, 14,  1,  1, 30}}, BlockLetter{'T', {31,  4,  4,  4,  4,  4,  4}},
    BlockLetter{'U', {17, 17, 17, 17, 17, 17, 14}}, BlockLetter{'V', {17, 17, 17, 17, 17, 10,  4}},
    BlockLetter{'W', {17, 17, 17, 21, 21, 21, 10}}, BlockLetter{'X', {17, 17, 10,  4, 10, 17, 17}},
    BlockLetter{'Y', {17, 17, 10,  4,  4,  4,  4}}, BlockLetter{'Z', {31,  1,  2,  4,  8, 16, 31}},
    BlockLetter{'0', {14, 17, 19, 21, 25, 17, 14}}, BlockLetter{'1', { 4, 12,  4,  4,  4,  4, 14}},
    BlockLetter{'2', {14, 17,  1,  6,  8, 16, 31}}, BlockLetter{'3', {30,  1,  1, 14,  1,  1, 30}},
    BlockLetter{'4', { 2,  6, 10, 18, 31,  2,  2}}, BlockLetter{'5', {31, 16, 30,  1,  1, 17, 14}},
    BlockLetter{'6', { 6,  8, 16, 30, 17, 17, 14}}, BlockLetter{'7', {31,  1,  2,  4,  8,  8,  8}},
    BlockLetter{'8', {14, 17, 17, 14, 17, 17, 14}}, BlockLetter{'9', {14, 17, 17, 15,  1,  2, 12}},
    BlockLetter{'.', { 0,  0,  0,  0,  0, 12, 12}}, BlockLetter{',', { 0,  0,  0,  0, 12,  4,  8}},
    BlockLetter{'-', { 0,  0,  0, 31,  0,  0,  0}}, BlockLetter{'/', { 1,  1,  2,  4,  8, 16, 16}},
    BlockLetter{'+', { 0,  4,  4, 31,  4,  4,  0}},
};
// clang-format on

void add_rectangle(Mesh& mesh, const glm::vec3& lower_left, const glm::vec2& size_m) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::vec2 corner : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
        mesh.positions.push_back(lower_left + glm::vec3(corner * size_m, 0.0f));
        mesh.normals.emplace_back(0.0f, 0.0f, 1.0f);
        mesh.tangents.emplace_back(1.0f, 0.0f, 0.0f, 1.0f);
        mesh.uv.emplace_back(corner.x, 1.0f - corner.y);
    }
    for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + corner);
}

}  // namespace

float block_letters_width(std::string_view text, float height_m) {
    const int squares = text.empty() ? 0 : kStep * static_cast<int>(text.size()) - 1;
    return static_cast<float>(squares) * height_m / static_cast<float>(kRows);
}

void add_block_letters(Mesh& mesh, std::string_view text, const glm::vec3& centre, float height_m) {
    const float square_m = height_m / static_cast<float>(kRows);
    glm::vec3 pen = centre + glm::vec3(-0.5f * block_letters_width(text, height_m), 0.5f * height_m, 0.0f);
    for (const char each : text) {
        const char capital = static_cast<char>(std::toupper(static_cast<unsigned char>(each)));
        const auto* found = std::find_if(kLetters.begin(), kLetters.end(),
                                         [&](const BlockLetter& letter) { return letter.letter == capital; });
        for (int row = 0; found != kLetters.end() && row < kRows; ++row) {
            const unsigned squares = found->rows[static_cast<std::size_t>(row)];
            for (int column = 0; column < kColumns; ++column) {
                int run = 0;
                while (column + run < kColumns && (squares >> (kColumns - 1 - column - run) & 1u) != 0) ++run;
                if (run == 0) continue;
                const glm::vec3 at(static_cast<float>(column) * square_m, -static_cast<float>(row + 1) * square_m, 0);
                add_rectangle(mesh, pen + at, {static_cast<float>(run) * square_m, square_m});
                column += run;
            }
        }
        pen.x += static_cast<float>(kStep) * square_m;
    }
}

}  // namespace halfframe::content
