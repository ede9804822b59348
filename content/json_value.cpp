// Builds values from the events of nlohmann's parser, without its tree.
#include "content/json_value.h"

#include <algorithm>
#include <array>
#include <deque>
#include <limits>
#include <memory_resource>
#include <vector>

#include <nlohmann/json.hpp>

#include "engine/error.h"

namespace halfframe::content {

static_assert(sizeof(JsonValue) == 16 && sizeof(JsonMember) == 32, "what kMostJsonBytes counts with");

const char* JsonValue::kind_name() const {
    switch (kind_) {
        case Kind::null: return "null";
        case Kind::boolean: return "boolean";
        case Kind::text: return "string";
        case Kind::array: return "array";
        case Kind::object: return "object";
        default: return "number";
    }
}

double JsonValue::number() const {
    if (kind_ == Kind::whole) return static_cast<double>(whole_);
    return kind_ == Kind::negative ? static_cast<double>(negative_) : fraction_;
}

std::string JsonValue::number_text() const {
    if (kind_ == Kind::whole) return std::to_string(whole_);
    return kind_ == Kind::negative ? std::to_string(negative_) : nlohmann::json(fraction_).dump();
}

const JsonValue* JsonValue::find_by_halving(std::string_view key) const {
    const auto found = std::ranges::lower_bound(members(), key, {},
                                                [](const JsonMember& member) { return std::string_view(*member.key); });
    return found != members().end() && *found->key == key ? &found->value : nullptr;
}

struct JsonDocument::Storage {
    std::pmr::monotonic_buffer_resource blocks;
    std::deque<std::string> texts;  ///< strings and keys: they stay where they are
    JsonValue root;
};

/// What nlohmann::json::sax_parse() calls. Elements and members of what is open wait on stacks, which at most double
/// the memory of the values.
class JsonBuilder {
public:
    JsonBuilder(std::pmr::memory_resource& blocks, std::deque<std::string>& texts, int deepest)
        : blocks_(blocks), texts_(texts), deepest_(static_cast<std::size_t>(deepest)) {}

    bool null() { return add(JsonValue()); }
    bool boolean(bool value) {
        JsonValue result;
        result.kind_ = JsonValue::Kind::boolean;
        result.boolean_ = value;
        return add(result);
    }
    bool number_unsigned(std::uint64_t value) {
        JsonValue result;
        result.kind_ = JsonValue::Kind::whole;
        result.whole_ = value;
        return add(result);
    }
    bool number_integer(std::int64_t value) {
        JsonValue result;
        result.kind_ = JsonValue::Kind::negative;
        result.negative_ = value;
        return add(result);
    }
    bool number_float(double value, const std::string&) {
        JsonValue result;
        result.kind_ = JsonValue::Kind::fraction;
        result.fraction_ = value;
        return add(result);
    }
    bool string(std::string& value) {
        JsonValue result;
        result.kind_ = JsonValue::Kind::text;
        result.text_ = &texts_.emplace_back(value);
        return add(result);
    }
    bool binary(std::vector<std::uint8_t>&) { return false; }  // JSON has none
    bool start_object(std::size_t) { return open(); }
    bool start_array(std::size_t) { return open(); }
    bool key(std::string& value) {
        keys_.push_back(known(value));
        return true;
    }
    bool end_array() {
        JsonValue result;
        result.kind_ = JsonValue::Kind::array;
        result.size_ = count_open();
        auto* elements = array_of<JsonValue>(result.size_);
        for (std::size_t i = result.size_; i-- > 0;) elements[i] = taken_value();
        result.elements_ = elements;
        starts_.pop_back();
        return add(result);
    }
    bool end_object() {
        JsonValue result;
        result.kind_ = JsonValue::Kind::object;
        result.size_ = count_open();
        auto* members = array_of<JsonMember>(result.size_);
        for (std::size_t i = result.size_; i-- > 0;) {
            members[i] = {keys_.back(), taken_value(), JsonMember::start_of(*keys_.back())};
            keys_.pop_back();
        }
        result.size_ = sorted({members, result.size_});
        result.members_ = members;
        starts_.pop_back();
        return add(result);
    }
    bool parse_error(std::size_t byte, const std::string&, const nlohmann::json::parse_error& error) {
        fault = {byte, error.what()};
        return false;
    }
    bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception& error) {
        fault = {std::nullopt, error.what()};
        return false;
    }

    /// The whole text: what was added outside of all.
    [[nodiscard]] JsonValue root() const { return values_.front(); }

    JsonDocument::Fault fault;

private:
    template <typename T>
    T* array_of(std::size_t count) {
        return static_cast<T*>(blocks_.allocate(count * sizeof(T), alignof(T)));
    }

    bool add(const JsonValue& value) {
        values_.push_back(value);
        return true;
    }

    bool open() {
        starts_.push_back(values_.size());
        return starts_.size() <= deepest_;
    }

    std::uint32_t count_open() const {
        const std::size_t count = values_.size() - starts_.back();
        expect(count <= std::numeric_limits<std::uint32_t>::max(), "a JSON array of more than 2^32 elements");
        return static_cast<std::uint32_t>(count);
    }

    JsonValue taken_value() {
        const JsonValue value = values_.back();
        values_.pop_back();
        return value;
    }

    /// The key, kept. The same few keys come again and again: each has a place where its last twin is looked for.
    const std::string* known(const std::string& key) {
        const std::size_t letters =
            key.empty() ? 0u : static_cast<unsigned char>(key.front()) * 7u + static_cast<unsigned char>(key.back());
        const std::string*& place = known_keys_[(letters * 31u + key.size()) % known_keys_.size()];
        if (place == nullptr || *place != key) place = &texts_.emplace_back(key);
        return place;
    }

    /// Sorts by key and leaves out all but the last of equal ones. Returns how many are left.
    static std::uint32_t sorted(std::span<JsonMember> members) {
        const auto before = [](const JsonMember& a, const JsonMember& b) { return *a.key < *b.key; };
        if (std::ranges::adjacent_find(
                members, [](const JsonMember& a, const JsonMember& b) { return *a.key >= *b.key; }) == members.end()) {
            return static_cast<std::uint32_t>(members.size());
        }
        std::ranges::stable_sort(members, before);
        std::size_t kept = 0;
        for (std::size_t i = 0; i < members.size(); ++i) {
            if (i + 1 < members.size() && *members[i].key == *members[i + 1].key) continue;
            members[kept++] = members[i];
        }
        return static_cast<std::uint32_t>(kept);
    }

    std::pmr::memory_resource& blocks_;
    std::deque<std::string>& texts_;
    std::size_t deepest_;
    std::deque<JsonValue> values_;
    std::deque<const std::string*> keys_;
    std::vector<std::size_t> starts_;  ///< in values_, of what is open
    std::array<const std::string*, 256> known_keys_{};
};

JsonDocument::JsonDocument() = default;
JsonDocument::JsonDocument(JsonDocument&&) noexcept = default;
JsonDocument& JsonDocument::operator=(JsonDocument&&) noexcept = default;
JsonDocument::~JsonDocument() = default;

std::optional<JsonDocument::Fault> JsonDocument::parse(std::string_view text, int deepest) {
    storage_ = std::make_unique<Storage>();
    JsonBuilder builder(storage_->blocks, storage_->texts, deepest);
    if (!nlohmann::json::sax_parse(text, &builder)) {
        storage_.reset();
        return builder.fault;
    }
    storage_->root = builder.root();
    return std::nullopt;
}

const JsonValue& JsonDocument::root() const {
    static constexpr JsonValue kNull{};
    return storage_ ? storage_->root : kNull;
}

}  // namespace halfframe::content
