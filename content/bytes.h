// Bytes of a file, or the part of them that somebody still wants, in the memory they were read into.
#pragma once

#include <cstddef>
#include <memory>
#include <string_view>

namespace halfframe::content {

/// Moves and does not copy. What is new has no value: zeros would be written only to be written over.
class Bytes {
public:
    Bytes() = default;
    explicit Bytes(std::size_t size) : memory_(std::make_unique_for_overwrite<char[]>(size)), size_(size) {}

    [[nodiscard]] char* data() { return memory_.get() + start_; }
    [[nodiscard]] const char* data() const { return memory_.get() + start_; }
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] bool empty() const { return size_ == 0; }
    [[nodiscard]] operator std::string_view() const { return {data(), size_}; }

    /// Only `size` bytes from `start` on are left. The others keep their memory.
    void keep(std::size_t start, std::size_t size) {
        start_ += start;
        size_ = size;
    }

private:
    std::unique_ptr<char[]> memory_;
    std::size_t start_ = 0;
    std::size_t size_ = 0;
};

}  // namespace halfframe::content
