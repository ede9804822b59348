// A value in a JSON file that knows its place, so that every complaint about it names file and JSON pointer.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace halfframe::content {

/// Which file a document came from, and the advice that ends each complaint.
struct JsonSource {
    std::string file;
    std::string advice;
};

/// A borrowed value; document and source must outlive it. Every read checks the type first and fails with
/// Error(input) "FILE: POINTER: what is wrong; what to try". Nothing of nlohmann's own exceptions gets out.
class JsonPlace {
public:
    JsonPlace(const nlohmann::json& value, const JsonSource& source, std::string pointer = {})
        : value_(&value), source_(&source), start_(std::move(pointer)) {}

    [[noreturn]] void fail(const std::string& what) const;
    [[noreturn]] void fail(const std::string& what, const std::string& advice) const;

    [[nodiscard]] const nlohmann::json& value() const { return *value_; }
    [[nodiscard]] std::string pointer() const;
    [[nodiscard]] const JsonSource& source() const { return *source_; }

    void expect_object() const;
    /// The key is there. The value must be an object.
    [[nodiscard]] bool has(std::string_view key) const;
    /// Fails when the key is missing.
    [[nodiscard]] JsonPlace at(std::string_view key) const;
    /// Number of elements. The value must be an array.
    [[nodiscard]] std::size_t size() const;
    [[nodiscard]] JsonPlace at(std::size_t index) const;

    /// A whole number; 3.0 counts as 3.
    [[nodiscard]] std::uint64_t whole(std::uint64_t lowest = 0,
                                      std::uint64_t highest = std::numeric_limits<std::uint32_t>::max()) const;
    [[nodiscard]] double number() const;
    [[nodiscard]] double number(double lowest, double highest) const;
    [[nodiscard]] bool boolean() const;
    [[nodiscard]] const std::string& text() const;
    /// `count` finite numbers within the limits.
    void expect_numbers(std::size_t count, double lowest, double highest) const;

    /// Fails when the object has a key that is not in the list, and offers the nearest spelling.
    void expect_only(std::initializer_list<std::string_view> keys) const;

private:
    /// One step down: a key, which the document holds, or an element where `key` is nullptr.
    struct Step {
        const std::string* key = nullptr;
        std::size_t element = 0;
    };
    JsonPlace(const JsonPlace& above, const nlohmann::json& value, Step step);

    const nlohmann::json* value_;
    const JsonSource* source_;
    // The way here. Put into words only for a complaint: half of the time of a load went into pointers nobody read.
    std::string start_;
    std::array<Step, 8> steps_{};
    std::size_t depth_ = 0;  ///< of steps_ that count
};

/// Parses JSON text. Bad text, or nesting deeper than `deepest`: Error(input) with line and column.
[[nodiscard]] nlohmann::json parse_json(std::string_view text, const JsonSource& source, int deepest = 64);

/// A whole regular file of at most `most_bytes`. Missing, a folder, a pipe, too big: Error(input). `owner` starts the
/// message: "FILE" or "FILE: POINTER".
[[nodiscard]] std::string read_regular_file(const std::filesystem::path& file, std::uint64_t most_bytes,
                                            const std::string& owner);

}  // namespace halfframe::content
