// The letters: paths of digit pairs, x then y, a space between paths.
#include "content/street/letters.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "engine/error.h"

namespace halfframe::content::street {

namespace {

constexpr std::array<std::pair<char, std::string_view>, 45> kLetters{{
    {'A', "0602204246 0444"},
    {'B', "00063645443303 0030414233"},
    {'C', "4130100105163645"},
    {'D', "00062645412000"},
    {'E', "40000646 0333"},
    {'e', "40000646 0333"},
    {'F', "400006 0333"},
    {'G', "41301001051636454323"},
    {'H', "0006 4046 0343"},
    {'I', "2026"},
    {'J', "4045361605"},
    {'K', "0006 4003 1246"},
    {'L', "000646"},
    {'M', "0600234046"},
    {'N', "06004640"},
    {'O', "100105163645413010"},
    {'P', "06003041423303"},
    {'Q', "100105163645413010 2446"},
    {'R', "06003041423303 2346"},
    {'S', "4130100102133344453616 1605"},
    {'T', "0040 2026"},
    {'U', "000516364540"},
    {'V', "002640"},
    {'W', "0016233640"},
    {'X', "0046 4006"},
    {'Y', "0023402326"},
    {'Z', "00400646"},
    {'0', "100105163645413010 3115"},
    {'1', "112026"},
    {'2', "0110304142330646"},
    {'3', "01103041423313 334445361605"},
    {'4', "300444 3036"},
    {'5', "4000033344453616 1605"},
    {'6', "4130100105163645443303"},
    {'7', "004016"},
    {'8', "130201103041423344453616050413 1333"},
    {'9', "433313020110304145361605"},
    {'-', "1333"},
    {'+', "1333 2224"},
    {'.', "2526"},
    {':', "2122 2425"},
    {'/', "4006"},
    {'*', "2125 0343 1234 3214"},
    {'>', "014305"},
    {'#', "00404606 0600 1135 3115"},
}};

std::string_view path_of(char letter) {
    for (const auto& [each, path] : kLetters) {
        if (each == letter) return path;
    }
    throw Mistake(std::string("the stroke font has no letter ") + letter);
}

glm::vec2 point(std::string_view digits) {
    return {static_cast<float>(digits[0] - '0'), static_cast<float>(digits[1] - '0')};
}

}  // namespace

std::vector<Stroke> strokes_of(char letter) {
    std::vector<Stroke> strokes;
    if (letter == ' ') return strokes;
    std::string_view rest = path_of(letter);
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(' '), rest.size());
        const std::string_view path = rest.substr(0, end);
        for (std::size_t i = 2; i + 1 < path.size(); i += 2) {
            const Stroke stroke{point(path.substr(i - 2, 2)), point(path.substr(i, 2))};
            if (stroke.from != stroke.to) strokes.push_back(stroke);
        }
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    if (letter == 'e') strokes.push_back({{1.6f, -0.7f}, {2.8f, -1.5f}});
    return strokes;
}

std::vector<Stroke> strokes_across(std::string_view text) {
    std::vector<Stroke> all;
    float x = 0.0f;
    for (const char letter : text) {
        for (const Stroke& stroke : strokes_of(letter))
            all.push_back({stroke.from + glm::vec2(x, 0.0f), stroke.to + glm::vec2(x, 0.0f)});
        x += kLetterAdvance;
    }
    return all;
}

std::vector<Stroke> strokes_down(std::string_view text) {
    constexpr float kLineAdvance = 8.0f;
    std::vector<Stroke> all;
    float y = 0.0f;
    for (const char letter : text) {
        for (const Stroke& stroke : strokes_of(letter))
            all.push_back({stroke.from + glm::vec2(0.0f, y), stroke.to + glm::vec2(0.0f, y)});
        y += kLineAdvance;
    }
    return all;
}

}  // namespace halfframe::content::street
