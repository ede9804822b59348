// Checked reading of JSON values, and the two ways in: text and file.
#include "content/json_place.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <vector>

#include <fmt/format.h>

#include "content/nearest.h"
#include "engine/error.h"

namespace halfframe::content {
namespace {

// Up to here every whole number is exact as a double, so 3.0 may stand for 3.
constexpr double kLargestExactWhole = 9007199254740992.0;

std::string line_and_column(std::string_view text, std::size_t byte) {
    const std::string_view before = text.substr(0, std::min(byte, text.size()));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t line_start = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
    return fmt::format("line {}, column {}", line, before.size() - line_start + 1);
}

/// Byte where the brackets first nest deeper than `deepest`, or npos.
std::size_t too_deep_at(std::string_view text, int deepest) {
    int depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string) {
            if (c == '\\') {
                ++i;
            } else if (c == '"') {
                in_string = false;
            }
        } else if (c == '"') {
            in_string = true;
        } else if (c == '{' || c == '[') {
            if (++depth > deepest) {
                return i;
            }
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
    return std::string_view::npos;
}

}  // namespace

JsonPlace::JsonPlace(const JsonPlace& above, const nlohmann::json& value, Step step)
    : value_(&value), source_(above.source_), start_(above.start_), steps_(above.steps_), depth_(above.depth_) {
    if (depth_ == steps_.size()) {
        start_ = above.pointer();
        depth_ = 0;
    }
    steps_[depth_++] = step;
}

std::string JsonPlace::pointer() const {
    std::string result = start_;
    for (std::size_t i = 0; i < depth_; ++i) {
        result += '/';
        result += steps_[i].key != nullptr ? *steps_[i].key : std::to_string(steps_[i].element);
    }
    return result;
}

void JsonPlace::fail(const std::string& what) const { fail(what, source_->advice); }

void JsonPlace::fail(const std::string& what, const std::string& advice) const {
    const std::string where = pointer();
    throw Error(Fault::input, fmt::format("{}: {}: {}; {}", source_->file, where.empty() ? "/" : where, what, advice));
}

void JsonPlace::expect_object() const {
    if (!value_->is_object()) {
        fail(fmt::format("must be an object but is {}", value_->type_name()));
    }
}

bool JsonPlace::has(std::string_view key) const {
    expect_object();
    return value_->find(key) != value_->end();
}

JsonPlace JsonPlace::at(std::string_view key) const {
    expect_object();
    const auto found = value_->find(key);
    if (found == value_->end()) {
        fail(fmt::format("'{}' is missing", key));
    }
    return {*this, *found, Step{&found.key(), 0}};
}

std::size_t JsonPlace::size() const {
    if (!value_->is_array()) {
        fail(fmt::format("must be an array but is {}", value_->type_name()));
    }
    return value_->size();
}

JsonPlace JsonPlace::at(std::size_t index) const {
    expect(index < size(), "an element of a JSON array was asked for past its end");
    return {*this, (*value_)[index], Step{nullptr, index}};
}

std::uint64_t JsonPlace::whole(std::uint64_t lowest, std::uint64_t highest) const {
    std::uint64_t result = 0;
    // A parser calls whole numbers from 0 up unsigned; those that were put into the document may be signed.
    if (value_->is_number_unsigned() || (value_->is_number_integer() && value_->get<std::int64_t>() >= 0)) {
        result = value_->get<std::uint64_t>();
    } else if (value_->is_number_float() && value_->get<double>() >= 0.0 &&
               value_->get<double>() <= kLargestExactWhole &&
               std::trunc(value_->get<double>()) == value_->get<double>()) {
        result = static_cast<std::uint64_t>(value_->get<double>());
    } else {
        fail(fmt::format("must be a whole number from {} up but is {}", lowest,
                         value_->is_number() ? value_->dump() : value_->type_name()));
    }
    if (result < lowest || result > highest) {
        fail(fmt::format("is {} but must lie from {} to {}", result, lowest, highest));
    }
    return result;
}

double JsonPlace::number() const {
    if (!value_->is_number()) {
        fail(fmt::format("must be a number but is {}", value_->type_name()));
    }
    return value_->get<double>();
}

double JsonPlace::number(double lowest, double highest) const {
    const double result = number();
    if (!(result >= lowest && result <= highest)) {
        fail(fmt::format("is {} but must lie from {} to {}", result, lowest, highest));
    }
    return result;
}

bool JsonPlace::boolean() const {
    if (!value_->is_boolean()) {
        fail(fmt::format("must be true or false but is {}", value_->type_name()));
    }
    return value_->get<bool>();
}

const std::string& JsonPlace::text() const {
    if (!value_->is_string()) {
        fail(fmt::format("must be a string but is {}", value_->type_name()));
    }
    return value_->get_ref<const std::string&>();
}

void JsonPlace::expect_numbers(std::size_t count, double lowest, double highest) const {
    if (size() != count) {
        fail(fmt::format("must hold {} numbers but holds {}", count, size()));
    }
    for (std::size_t i = 0; i < count; ++i) {
        const nlohmann::json& each = (*value_)[i];
        const bool fits = each.is_number() && each.get<double>() >= lowest && each.get<double>() <= highest;
        if (!fits) (void)at(i).number(lowest, highest);  // says why
    }
}

void JsonPlace::expect_only(std::initializer_list<std::string_view> keys) const {
    expect_object();
    for (const auto& [key, child] : value_->items()) {
        if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
            std::string known;
            for (const std::string_view each : keys) {
                known += (known.empty() ? "" : ", ") + std::string(each);
            }
            fail(fmt::format("unknown key '{}'{}", key, did_you_mean(key, keys)), "the keys here are " + known);
        }
    }
}

nlohmann::json parse_json(std::string_view text, const JsonSource& source, int deepest) {
    const std::size_t too_deep = too_deep_at(text, deepest);
    if (too_deep != std::string_view::npos) {
        throw Error(Fault::input, fmt::format("{}: {}: brackets nest deeper than {} levels; {}", source.file,
                                              line_and_column(text, too_deep), deepest, source.advice));
    }
    try {
        return nlohmann::json::parse(text);
    } catch (const nlohmann::json::parse_error& error) {
        throw Error(Fault::input,
                    fmt::format("{}: {}: is not JSON here (byte {}); {}", source.file,
                                line_and_column(text, error.byte > 0 ? error.byte - 1 : 0), error.byte, source.advice));
    } catch (const nlohmann::json::exception& error) {
        throw Error(Fault::input,
                    fmt::format("{}: is not usable JSON ({}); {}", source.file, error.what(), source.advice));
    }
}

std::string read_regular_file(const std::filesystem::path& file, std::uint64_t most_bytes, const std::string& owner) {
    std::error_code code;
    const std::filesystem::file_status status = std::filesystem::status(file, code);
    if (!std::filesystem::exists(status)) {
        throw Error(Fault::input,
                    fmt::format("{}: there is no file {}; check the name and the folder", owner, file.string()));
    }
    if (std::filesystem::is_directory(status)) {
        throw Error(Fault::input, fmt::format("{}: {} is a folder; name a file in it", owner, file.string()));
    }
    if (!std::filesystem::is_regular_file(status)) {
        throw Error(Fault::input,
                    fmt::format("{}: {} is not a regular file; copy its content into one", owner, file.string()));
    }
    const std::uintmax_t bytes = std::filesystem::file_size(file, code);
    if (code || bytes > most_bytes) {
        throw Error(Fault::input,
                    code ? fmt::format("{}: {} cannot be measured ({}); check its permissions", owner, file.string(),
                                       code.message())
                         : fmt::format("{}: {} has {} bytes, more than the {} that are read; split or compress it",
                                       owner, file.string(), bytes, most_bytes));
    }
    std::string content(static_cast<std::size_t>(bytes), '\0');
    std::ifstream stream(file, std::ios::binary);
    stream.read(content.data(), static_cast<std::streamsize>(content.size()));
    if (!stream || static_cast<std::uintmax_t>(stream.gcount()) != bytes) {
        throw Error(Fault::input, fmt::format("{}: {} cannot be read; check its permissions", owner, file.string()));
    }
    return content;
}

}  // namespace halfframe::content
