// Reads parts of a buffer from its file.
#include "content/gltf_buffer.h"

#include <cstring>

namespace halfframe::content {

void GltfBuffer::keep(std::size_t start, std::size_t size) {
    if (file_ == nullptr) memory_.keep(start, size);
    else memory_ = {};  // a window over what was
    window_start_ = 0;
    windowed_bytes_ = 0;
    start_ += start;
    size_ = size;
}

std::string_view GltfBuffer::part(std::size_t start, std::size_t size) const {
    if (file_ == nullptr) return std::string_view(memory_).substr(start, size);
    const bool is_inside = start >= window_start_ && start + size <= window_start_ + memory_.size();
    if (is_inside) return std::string_view(memory_).substr(start - window_start_, size);
    const std::size_t window = std::min(kWindow, size_ - start);
    windowed_bytes_ += window;
    if (size > kWindow || windowed_bytes_ > size_) {
        load();
        return std::string_view(memory_).substr(start, size);
    }
    memory_ = copy(start, window);
    window_start_ = start;
    return std::string_view(memory_).substr(0, size);
}

Bytes GltfBuffer::copy(std::size_t start, std::size_t size) const {
    Bytes bytes(size);
    if (size == 0) return bytes;
    if (file_ == nullptr) std::memcpy(bytes.data(), memory_.data() + start, size);
    else file_->read(start_ + start, bytes.data(), size);
    return bytes;
}

void GltfBuffer::read(std::size_t start, std::size_t size, char* into) const {
    if (size == 0) return;  // what has no bytes may have no memory
    if (file_ != nullptr && size > kWindow) file_->read(start_ + start, into, size);
    else std::memcpy(into, part(start, size).data(), size);
}

void GltfBuffer::load() const {
    memory_ = copy(0, size_);
    file_.reset();
}

}  // namespace halfframe::content
