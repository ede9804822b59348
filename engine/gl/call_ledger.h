// Every GL call counted by name and pass, with the bytes that crossed. Counting never allocates.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace halfframe::gl {

inline constexpr int kMaxPasses = 64;  ///< pass 0 is everything outside a pass ("set-up")
inline constexpr int kMaxCalls = 160;  ///< at least the number of rows of entry_points.inl

/// What one pass did to GL.
struct PassCalls {
    std::array<std::uint32_t, kMaxCalls> count{};
    std::uint64_t bytes_uploaded = 0;   ///< buffer and texture data handed to GL
    std::uint64_t bytes_read_back = 0;  ///< glReadPixels
    std::uint32_t draws = 0;
    std::uint64_t vertices = 0;  ///< vertices or indices submitted
    [[nodiscard]] std::uint64_t calls() const;
};

class CallLedger {
public:
    /// Index of the pass called `name`; the same name gives the same index. More than kMaxPasses names: Mistake.
    int pass_index(const char* name);
    [[nodiscard]] const std::vector<std::string>& pass_names() const { return names_; }
    [[nodiscard]] const PassCalls& pass(int index) const { return passes_[static_cast<std::size_t>(index)]; }
    [[nodiscard]] PassCalls& pass(int index) { return passes_[static_cast<std::size_t>(index)]; }

    /// Sums over all passes.
    [[nodiscard]] std::uint64_t total(int call) const;
    /// Sum of the calls that make GL objects (glGen*, glCreate*), that link programs (glLinkProgram, glProgramBinary),
    /// used to prove that a steady frame makes none.
    [[nodiscard]] std::uint64_t object_creations() const;
    [[nodiscard]] std::uint64_t program_links() const;
    void clear();  ///< zeroes every count; keeps the names

    CallLedger();

private:
    std::vector<std::string> names_;
    std::array<PassCalls, kMaxPasses> passes_{};
};

/// "glDrawElements" for a call number below call_count().
[[nodiscard]] const char* call_name(int call);
[[nodiscard]] int call_count();

}  // namespace halfframe::gl
