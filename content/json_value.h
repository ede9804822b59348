// A parsed JSON text that is only read: values of 16 bytes in a few large blocks. Beside a tree of maps and strings it
// takes a fraction of the memory, and keys are found by a glance over those of one object.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace halfframe::content {

struct JsonMember;

/// One value. It belongs to the JsonDocument that parsed it, which must outlive it.
class JsonValue {
public:
    /// Whole numbers from 0 up, below 0, and all others are told apart as they were written: 3.0 is a fraction.
    enum class Kind : std::uint8_t { null, boolean, whole, negative, fraction, text, array, object };

    [[nodiscard]] Kind kind() const { return kind_; }
    [[nodiscard]] bool is_object() const { return kind_ == Kind::object; }
    [[nodiscard]] bool is_array() const { return kind_ == Kind::array; }
    [[nodiscard]] bool is_text() const { return kind_ == Kind::text; }
    [[nodiscard]] bool is_boolean() const { return kind_ == Kind::boolean; }
    [[nodiscard]] bool is_number() const { return kind_ >= Kind::whole && kind_ <= Kind::fraction; }
    /// "object", "array", "string", "boolean", "number" or "null".
    [[nodiscard]] const char* kind_name() const;

    // Each only of the kind that it names.
    [[nodiscard]] bool boolean() const { return boolean_; }
    [[nodiscard]] std::uint64_t whole() const { return whole_; }
    [[nodiscard]] double number() const;            ///< of any kind of number
    [[nodiscard]] std::string number_text() const;  ///< the shortest that says the number
    [[nodiscard]] const std::string& text() const { return *text_; }
    [[nodiscard]] std::span<const JsonValue> elements() const { return {elements_, size_}; }
    /// In the order of their keys, byte by byte; of equal keys only the last that was written.
    [[nodiscard]] std::span<const JsonMember> members() const;

    /// The value behind a key of an object; nullptr: none, or no object.
    [[nodiscard]] const JsonValue* find(std::string_view key) const;

private:
    friend class JsonDocument;
    friend class JsonBuilder;

    [[nodiscard]] const JsonValue* find_by_halving(std::string_view key) const;

    union {
        bool boolean_;
        std::uint64_t whole_ = 0;
        std::int64_t negative_;
        double fraction_;
        const std::string* text_;
        const JsonValue* elements_;
        const JsonMember* members_;
    };
    std::uint32_t size_ = 0;  ///< of elements or members
    Kind kind_ = Kind::null;
};

/// A key of an object and what it holds.
struct JsonMember {
    const std::string* key;
    JsonValue value;
    std::uint64_t start;  ///< start_of(*key)

    /// The first eight letters in a number, zeros after a shorter key: what tells most keys apart in one comparison.
    [[nodiscard]] static std::uint64_t start_of(std::string_view key) {
        std::uint64_t start = 0;
        std::memcpy(&start, key.data(), std::min(key.size(), sizeof start));
        return start;
    }
};

inline std::span<const JsonMember> JsonValue::members() const { return {members_, size_}; }

inline const JsonValue* JsonValue::find(std::string_view key) const {
    constexpr std::uint32_t kGlance = 16;  // up to here looking at each is faster than halving
    if (!is_object()) return nullptr;
    if (size_ > kGlance) return find_by_halving(key);
    const std::uint64_t start = JsonMember::start_of(key);
    for (const JsonMember& member : members()) {
        if (member.start == start && *member.key == key) return &member.value;
    }
    return nullptr;
}

/// The values of one text. Moving it leaves them where they are.
class JsonDocument {
public:
    JsonDocument();
    JsonDocument(JsonDocument&&) noexcept;
    JsonDocument& operator=(JsonDocument&&) noexcept;
    ~JsonDocument();

    /// Why a text could not be parsed.
    struct Fault {
        std::optional<std::size_t> byte;  ///< from 1 on; none: it is JSON, but a number in it is none here
        std::string what;
    };
    /// Takes the text's values in place of what there was. Nesting deeper than `deepest` is a fault, of which the byte
    /// may lie anywhere. After a fault the document is null.
    [[nodiscard]] std::optional<Fault> parse(std::string_view text, int deepest);

    [[nodiscard]] const JsonValue& root() const;

private:
    struct Storage;
    std::unique_ptr<Storage> storage_;
};

}  // namespace halfframe::content
