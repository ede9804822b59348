// Checked reading of JSON values, and the two ways in: text and file.
#include "content/json_place.h"

#include <algorithm>
#include <cmath>
#include <optional>
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

/// The JSON pointer from `above` down to `value`, when it is there.
std::optional<std::string> pointer_below(const JsonValue& above, const JsonValue* value) {
    const auto by_way_of = [&](const JsonValue& child, const auto& step) -> std::optional<std::string> {
        if (&child == value) return fmt::format("/{}", step);
        std::optional<std::string> rest = pointer_below(child, value);
        if (rest) rest = fmt::format("/{}{}", step, *rest);
        return rest;
    };
    if (above.is_array()) {
        const std::span<const JsonValue> elements = above.elements();
        for (std::size_t i = 0; i < elements.size(); ++i) {
            if (auto found = by_way_of(elements[i], i)) return found;
        }
    } else if (above.is_object()) {
        for (const JsonMember& member : above.members()) {
            if (auto found = by_way_of(member.value, *member.key)) return found;
        }
    }
    return std::nullopt;
}

}  // namespace

std::string JsonPlace::pointer() const {
    return value_ == root_ ? std::string() : pointer_below(*root_, value_).value();
}

void JsonPlace::fail(const std::string& what) const { fail(what, source_->advice); }

void JsonPlace::fail(const std::string& what, const std::string& advice) const {
    const std::string where = pointer();
    throw Error(Fault::input, fmt::format("{}: {}: {}; {}", source_->file, where.empty() ? "/" : where, what, advice));
}

void JsonPlace::fail_kind(const char* wanted) const {
    fail(fmt::format("must be {} but is {}", wanted, value_->kind_name()));
}

void JsonPlace::fail_missing(std::string_view key) const { fail(fmt::format("'{}' is missing", key)); }

JsonPlace JsonPlace::at(std::size_t index) const {
    expect(index < size(), "an element of a JSON array was asked for past its end");
    return {*this, value_->elements()[index]};
}

std::uint64_t JsonPlace::whole(std::uint64_t lowest, std::uint64_t highest) const {
    std::uint64_t result = 0;
    if (value_->kind() == JsonValue::Kind::whole) {
        result = value_->whole();
    } else if (value_->is_number() && value_->number() >= 0.0 && value_->number() <= kLargestExactWhole &&
               std::trunc(value_->number()) == value_->number()) {
        result = static_cast<std::uint64_t>(value_->number());
    } else {
        fail(fmt::format("must be a whole number from {} up but is {}", lowest,
                         value_->is_number() ? value_->number_text() : value_->kind_name()));
    }
    if (result < lowest || result > highest) {
        fail(fmt::format("is {} but must lie from {} to {}", result, lowest, highest));
    }
    return result;
}

double JsonPlace::number() const {
    if (!value_->is_number()) {
        fail_kind("a number");
    }
    return value_->number();
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
        fail_kind("true or false");
    }
    return value_->boolean();
}

const std::string& JsonPlace::text() const {
    if (!value_->is_text()) {
        fail_kind("a string");
    }
    return value_->text();
}

void JsonPlace::expect_numbers(std::size_t count, double lowest, double highest) const {
    if (size() != count) {
        fail(fmt::format("must hold {} numbers but holds {}", count, size()));
    }
    for (std::size_t i = 0; i < count; ++i) {
        const JsonValue& each = value_->elements()[i];
        const bool fits = each.is_number() && each.number() >= lowest && each.number() <= highest;
        if (!fits) (void)at(i).number(lowest, highest);  // says why
    }
}

void JsonPlace::expect_only(std::initializer_list<std::string_view> keys) const {
    expect_object();
    for (const JsonMember& member : value_->members()) {
        const std::string& key = *member.key;
        if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
            std::string known;
            for (const std::string_view each : keys) {
                known += (known.empty() ? "" : ", ") + std::string(each);
            }
            fail(fmt::format("unknown key '{}'{}", key, did_you_mean(key, keys)), "the keys here are " + known);
        }
    }
}

JsonDocument parse_json(std::string_view text, const JsonSource& source, int deepest) {
    JsonDocument document;
    const std::optional<JsonDocument::Fault> fault = document.parse(text, deepest);
    if (!fault) return document;
    if (const std::size_t too_deep = too_deep_at(text, deepest); too_deep != std::string_view::npos) {
        throw Error(Fault::input, fmt::format("{}: {}: brackets nest deeper than {} levels; {}", source.file,
                                              line_and_column(text, too_deep), deepest, source.advice));
    }
    if (!fault->byte) {
        throw Error(Fault::input,
                    fmt::format("{}: is not usable JSON ({}); {}", source.file, fault->what, source.advice));
    }
    throw Error(Fault::input, fmt::format("{}: {}: is not JSON here (byte {}); {}", source.file,
                                          line_and_column(text, *fault->byte > 0 ? *fault->byte - 1 : 0), *fault->byte,
                                          source.advice));
}

RegularFile::RegularFile(const std::filesystem::path& file, std::uint64_t most_bytes, std::string owner)
    : name_(file.string()), owner_(std::move(owner)) {
    std::error_code code;
    const std::filesystem::file_status status = std::filesystem::status(file, code);
    if (!std::filesystem::exists(status)) {
        throw Error(Fault::input, fmt::format("{}: there is no file {}; check the name and the folder", owner_, name_));
    }
    if (std::filesystem::is_directory(status)) {
        throw Error(Fault::input, fmt::format("{}: {} is a folder; name a file in it", owner_, name_));
    }
    if (!std::filesystem::is_regular_file(status)) {
        throw Error(Fault::input,
                    fmt::format("{}: {} is not a regular file; copy its content into one", owner_, name_));
    }
    const std::uintmax_t bytes = std::filesystem::file_size(file, code);
    if (code || bytes > most_bytes) {
        throw Error(
            Fault::input,
            code ? fmt::format("{}: {} cannot be measured ({}); check its permissions", owner_, name_, code.message())
                 : fmt::format("{}: {} has {} bytes, more than the {} that are read; split or compress it", owner_,
                               name_, bytes, most_bytes));
    }
    size_ = static_cast<std::size_t>(bytes);
    stream_.rdbuf()->pubsetbuf(nullptr, 0);  // what is read here is large, or read once
    stream_.open(file, std::ios::binary);
}

void RegularFile::read(std::size_t start, char* into, std::size_t size) {
    if (start != position_) stream_.seekg(static_cast<std::streamoff>(start));
    position_ = start + size;
    stream_.read(into, static_cast<std::streamsize>(size));
    if (!stream_ || static_cast<std::size_t>(stream_.gcount()) != size) {
        throw Error(Fault::input, fmt::format("{}: {} cannot be read; check its permissions", owner_, name_));
    }
}

Bytes read_regular_file(const std::filesystem::path& file, std::uint64_t most_bytes, const std::string& owner) {
    RegularFile source(file, most_bytes, owner);
    Bytes bytes(source.size());
    source.read(0, bytes.data(), bytes.size());
    return bytes;
}

}  // namespace halfframe::content
