// From a failing input to the simplest one that still fails, and what happens to it step by step.
#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "perf/stability/search.h"

namespace halfframe::stability {
namespace {

/// How much there is to read in a number: its significant bits, and how far it is from 1.
double complexity(double x) {
    if (x == 0.0) return std::signbit(x) ? 0.5 : 0.0;
    if (!std::isfinite(x)) return 3.0;
    int exponent = 0;
    double fraction = std::frexp(std::fabs(x), &exponent);
    int bits = 0;
    for (; fraction != 0.0 && bits < 53; ++bits) {
        fraction *= 2.0;
        fraction -= std::floor(fraction);
    }
    return bits + 0.1 * std::abs(exponent - 1) + (x < 0.0 ? 0.5 : 0.0);
}

double complexity(const std::vector<double>& input) {
    double sum = 0.0;
    for (const double x : input) sum += complexity(x);
    return sum;
}

/// Simpler numbers than x.
std::vector<double> simpler(double x) {
    std::vector<double> numbers{0.0, 1.0, std::fabs(x)};
    if (x == 0.0 || !std::isfinite(x)) return numbers;
    int exponent = 0;
    const double fraction = std::frexp(x, &exponent);
    for (int bits = 1; bits <= 23; ++bits)
        numbers.push_back(std::ldexp(std::trunc(std::ldexp(fraction, bits)), exponent - bits));
    return numbers;
}

bool in_domain(const Domain& domain, double x) {
    return domain.kind == Domain::Kind::any || (x >= domain.low && x <= domain.high);
}

/// Every way to make one component of the input simpler. Directions stay: shortened, they are none.
std::vector<std::vector<double>> simpler_inputs(const Declaration& function, const std::vector<double>& input) {
    std::vector<std::vector<double>> inputs;
    std::size_t at = 0;
    for (const DeclaredParameter& parameter : function.parameters) {
        for (int s = 0; s < parameter.components; ++s, ++at) {
            if (parameter.domain.kind == Domain::Kind::unit) continue;
            for (const double x : simpler(input[at])) {
                if (parameter.whole && x != std::floor(x)) continue;
                if (!in_domain(parameter.domain, x) || complexity(x) >= complexity(input[at])) continue;
                inputs.push_back(input);
                inputs.back()[at] = x;
            }
        }
    }
    return inputs;
}

std::string line_of(std::string_view text, const std::string& place) {
    const auto colon = place.rfind(':');
    if (colon == std::string::npos) return {};
    std::istringstream lines{std::string(text)};
    std::string line;
    for (int at = std::atoi(place.c_str() + colon + 1); at > 0 && std::getline(lines, line);) --at;
    const auto first = line.find_first_not_of(' ');
    return first == std::string::npos ? "" : line.substr(first);
}

}  // namespace

std::vector<double> shrunk(const Subject& subject, std::vector<double> input, shader_ir::Model model, double limit) {
    const Declaration& function = subject.function();
    // A promise about a sweep fails between two inputs: one of them alone may well be right, and is left as it is.
    if (!(badness(subject, batch_of(function, {input}), model)[0] > limit)) return input;
    for (int round = 0; round < 200; ++round) {
        std::vector<std::vector<double>> candidates = simpler_inputs(function, input);
        if (candidates.empty()) break;
        const Batch batch = batch_of(function, candidates);
        const std::vector<bool> meant = subject.meant(batch);
        const std::vector<double> found = badness(subject, batch, model);
        const std::vector<double>* best = nullptr;
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            const bool fails = meant[i] && found[i] > limit;
            if (fails && (best == nullptr || complexity(candidates[i]) < complexity(*best))) best = &candidates[i];
        }
        if (best == nullptr) break;
        input = *best;
    }
    return input;
}

std::vector<Step> steps_of(const Subject& subject, const std::vector<double>& input, shader_ir::Model model) {
    struct Result {
        std::uint32_t line;
        std::vector<double> scalars;
    };
    const auto watched = [&](shader_ir::Model one) {
        std::vector<Result> results;
        (void)subject.run(batch_of(subject.function(), {input}), one,
                          [&](std::uint32_t line, std::span<const double> scalars) {
                              results.push_back({line, {scalars.begin(), scalars.end()}});
                          });
        return results;
    };
    const std::vector<Result> truth = watched(shader_ir::Model::in_double);
    const std::vector<Result> narrow = watched(model);
    std::vector<Step> steps;
    for (std::size_t i = 0; i < std::min(truth.size(), narrow.size()) && truth[i].line == narrow[i].line; ++i) {
        const std::string place = subject.place(truth[i].line);
        if (place.starts_with("<")) continue;  // what hands the inputs over
        const auto file = std::ranges::find_if(
            subject.files(), [&](const gl::ShaderFile& one) { return place.starts_with(std::string(one.path) + ":"); });
        steps.push_back({place, file == subject.files().end() ? "" : line_of(file->text, place), truth[i].scalars,
                         narrow[i].scalars});
    }
    return steps;
}

std::string input_text(const Declaration& function, const std::vector<double>& input) {
    std::string text;
    std::size_t at = 0;
    for (const DeclaredParameter& parameter : function.parameters) {
        std::vector<std::string> numbers;
        for (int s = 0; s < parameter.components; ++s) numbers.push_back(fmt::format("{:.9g}", input.at(at++)));
        text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", parameter.name,
                            numbers.size() == 1 ? numbers[0] : fmt::format("({})", fmt::join(numbers, ", ")));
    }
    return text;
}

}  // namespace halfframe::stability
