// A value in a JSON file that knows its place, so that every complaint about it names file and JSON pointer.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "content/bytes.h"
#include "content/json_value.h"

namespace halfframe::content {

/// Which file a document came from, and the advice that ends each complaint.
struct JsonSource {
    std::string file;
    std::string advice;
};

/// A borrowed value; document and source must outlive it. Every read checks the type first and fails with
/// Error(input) "FILE: POINTER: what is wrong; what to try".
class JsonPlace {
public:
    JsonPlace(const JsonDocument& document, const JsonSource& source)
        : value_(&document.root()), root_(value_), source_(&source) {}

    [[noreturn]] void fail(const std::string& what) const;
    [[noreturn]] void fail(const std::string& what, const std::string& advice) const;

    [[nodiscard]] const JsonValue& value() const { return *value_; }
    /// The JSON pointer. Looks through the document for it, as long as that is: for complaints.
    [[nodiscard]] std::string pointer() const;
    [[nodiscard]] const JsonSource& source() const { return *source_; }

    void expect_object() const {
        if (!value_->is_object()) fail_kind("an object");
    }
    /// The key is there. The value must be an object.
    [[nodiscard]] bool has(std::string_view key) const {
        expect_object();
        return value_->find(key) != nullptr;
    }
    /// What is behind the key, if it is there.
    [[nodiscard]] std::optional<JsonPlace> find(std::string_view key) const {
        expect_object();
        const JsonValue* found = value_->find(key);
        return found != nullptr ? std::optional(JsonPlace(*this, *found)) : std::nullopt;
    }
    /// Fails when the key is missing.
    [[nodiscard]] JsonPlace at(std::string_view key) const {
        expect_object();
        const JsonValue* found = value_->find(key);
        if (found == nullptr) fail_missing(key);
        return {*this, *found};
    }
    /// Number of elements. The value must be an array.
    [[nodiscard]] std::size_t size() const {
        if (!value_->is_array()) fail_kind("an array");
        return value_->elements().size();
    }
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
    JsonPlace(const JsonPlace& above, const JsonValue& value)
        : value_(&value), root_(above.root_), source_(above.source_) {}

    [[noreturn]] void fail_kind(const char* wanted) const;
    [[noreturn]] void fail_missing(std::string_view key) const;

    const JsonValue* value_;
    const JsonValue* root_;
    const JsonSource* source_;
};

/// Parses JSON text. Bad text, or nesting deeper than `deepest`: Error(input) with line and column.
[[nodiscard]] JsonDocument parse_json(std::string_view text, const JsonSource& source, int deepest = 64);

/// A regular file that is open, of at most `most_bytes`. Missing, a folder, a pipe, too big, not readable:
/// Error(input). `owner` starts the message: "FILE" or "FILE: POINTER".
class RegularFile {
public:
    RegularFile(const std::filesystem::path& file, std::uint64_t most_bytes, std::string owner);
    [[nodiscard]] std::size_t size() const { return size_; }
    /// `size` bytes from `start` on, all of them.
    void read(std::size_t start, char* into, std::size_t size);

private:
    std::string name_;
    std::string owner_;
    std::size_t size_ = 0;
    std::size_t position_ = 0;  ///< of stream_, after what was read last
    std::ifstream stream_;
};

/// All of a RegularFile.
[[nodiscard]] Bytes read_regular_file(const std::filesystem::path& file, std::uint64_t most_bytes,
                                      const std::string& owner);

}  // namespace halfframe::content
