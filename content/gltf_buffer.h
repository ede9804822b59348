// The bytes of a buffer: in memory, or in a file of which parts are read when they are asked for. The vertices of a GLB
// go from the file to where they stay, without a second copy of them in memory.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>

#include "content/bytes.h"
#include "content/json_place.h"

namespace halfframe::content {

/// Moves and does not copy. What the file does not give any more: Error(input).
class GltfBuffer {
public:
    GltfBuffer() = default;  ///< without data
    explicit GltfBuffer(Bytes bytes) : memory_(std::move(bytes)), size_(memory_.size()) {}
    explicit GltfBuffer(RegularFile file)
        : file_(std::make_unique<RegularFile>(std::move(file))), size_(file_->size()) {}

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] bool empty() const { return size_ == 0; }
    /// Only `size` bytes from `start` on are left.
    void keep(std::size_t start, std::size_t size);

    // Ranges lie inside.
    /// Stays as it is until the next call of any of these.
    [[nodiscard]] std::string_view part(std::size_t start, std::size_t size) const;
    [[nodiscard]] Bytes copy(std::size_t start, std::size_t size) const;
    /// As copy(), to where `into` has room for `size` bytes.
    void read(std::size_t start, std::size_t size, char* into) const;
    /// Calls visit(std::string_view) for one piece after the other, each of whole elements of `element` bytes.
    template <typename Visit>
    void for_each_piece(std::size_t start, std::size_t size, std::size_t element, Visit&& visit) const {
        if (file_ == nullptr || size <= kWindow) {
            visit(part(start, size));
            return;
        }
        Bytes piece(kWindow / element * element);
        for (std::size_t done = 0; done < size; done += piece.size()) {
            piece.keep(0, std::min(piece.size(), size - done));
            file_->read(start_ + start + done, piece.data(), piece.size());
            visit(std::string_view(piece));
        }
    }

private:
    /// Small parts are cut from a window over the file, which most are asked of in its order [bytes].
    static constexpr std::size_t kWindow = 64u << 10;

    void load() const;

    mutable std::unique_ptr<RegularFile> file_;  ///< nullptr: all is in memory_
    mutable Bytes memory_;                       ///< else the window
    mutable std::size_t window_start_ = 0;
    mutable std::size_t windowed_bytes_ = 0;  ///< read through windows: when it is more than all, all is read
    std::size_t start_ = 0;                   ///< in the file
    std::size_t size_ = 0;
};

}  // namespace halfframe::content
