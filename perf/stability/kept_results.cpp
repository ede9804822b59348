// Results as CBOR, which has NaN and infinity; one file a function.
#include "perf/stability/kept_results.h"

#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/gl/fingerprint.h"
#include "perf/report/atomic_file.h"

namespace halfframe::stability {

// How nlohmann::json takes our values apart. The function itself is compiled anew and not kept.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Finding, input, component, expected, got, allowed, ratio)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(BrokenPromise, promise, lanes, first)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Tally, arithmetic, model, lanes, not_finite, over, worst, broken, at_most)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Strip, parameter, at, allowed, errors)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Step, place, text, in_double, in_model)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FunctionStability, title, variant, method, lanes, near_jump, tallies, strip, steps,
                                   violations)

namespace {

/// Part of every key: results of a search that worked otherwise are not taken up.
constexpr int kSearchVersion = 1;

std::string text_of(const Subject& subject) {
    std::string text(subject.text());
    for (const std::string& path : subject.paths()) {
        if (const gl::ShaderFile* file = gl::find_shader_file(path)) text += file->text;
    }
    return text;
}

}  // namespace

KeptResults::KeptResults(std::filesystem::path folder, std::string ground)
    : folder_(std::move(folder)), ground_(std::move(ground)) {}

std::filesystem::path KeptResults::file_of(const Subject& subject, const Effort& effort) const {
    const std::string key =
        fmt::format("{} {} {} {} {} {} {} {} {}", kSearchVersion, ground_, subject.variant(), subject.title(),
                    effort.combinations, effort.drawn, effort.sweeps, effort.sweep_points, text_of(subject));
    return folder_ / fmt::format("{}_{:016x}.cbor", subject.function().name, gl::fingerprint(key));
}

std::optional<FunctionStability> KeptResults::find(const Subject& subject, const Effort& effort) const {
    if (folder_.empty()) return std::nullopt;
    const std::filesystem::path path = file_of(subject, effort);
    std::ifstream file(path, std::ios::binary);
    if (!file) return std::nullopt;
    const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    try {
        auto found = nlohmann::json::from_cbor(bytes).get<FunctionStability>();
        found.function = subject.function();
        files_.push_back(path);
        return found;
    } catch (const nlohmann::json::exception&) {
        return std::nullopt;  // damaged: searched again, and written anew
    }
}

void KeptResults::keep(const FunctionStability& found, const Subject& subject, const Effort& effort) {
    if (folder_.empty()) return;
    const std::filesystem::path path = file_of(subject, effort);
    const std::vector<std::uint8_t> bytes = nlohmann::json::to_cbor(found);
    try {
        std::filesystem::create_directories(folder_);
        perf::write_file(path.string(), std::string(bytes.begin(), bytes.end()));
        files_.push_back(path);
    } catch (const std::exception&) {
        folder_.clear();  // a convenience is no reason to end a long search
    }
}

void KeptResults::forget() {
    std::error_code ignored;
    for (const std::filesystem::path& file : files_) std::filesystem::remove(file, ignored);
    files_.clear();
}

}  // namespace halfframe::stability
