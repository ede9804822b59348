// The three kinds of error of the house style, as two things to call:
// expect() for our own mistakes, Error for the world's faults. Expected absence is std::optional.
#pragma once

#include <source_location>
#include <stdexcept>
#include <string>

namespace halfframe {

/// Whose fault it is. The value is the exit code of the halfframe command.
enum class Fault : int {
    check = 1,        ///< a check, a budget or a gate failed; also a mistake of ours
    usage = 2,        ///< the caller asked for something that does not exist
    input = 3,        ///< a file that cannot be read or means nothing
    context = 4,      ///< no usable graphics context, or this one cannot do what was asked
    environment = 5,  ///< disk, cache, baseline: the machine around us
};

/// The world's fault. The message is one sentence that names the file or thing, the place, and what to try.
/// Thrown only while loading and preparing, never inside a frame.
class Error : public std::runtime_error {
public:
    Error(Fault fault, const std::string& sentence) : std::runtime_error(sentence), fault_(fault) {}
    [[nodiscard]] Fault fault() const { return fault_; }
    [[nodiscard]] int exit_code() const { return static_cast<int>(fault_); }

private:
    Fault fault_;
};

/// Our own mistake: a broken contract inside the engine or in the calling program.
class Mistake : public std::logic_error {
public:
    using std::logic_error::logic_error;
};

/// A call, format or limit that the device mask in force does not grant was used all the same. Ours to mend when the
/// device is one of content/devices; otherwise the device is poorer than any tier promises to run on.
class MaskedUse : public Mistake {
public:
    using Mistake::Mistake;
};

/// Stops with `sentence` (put the values in it) and the place when `holds` is false.
/// The sentence is only built by the caller when needed: use the lambda form inside loops.
inline void expect(bool holds, const char* sentence, std::source_location place = std::source_location::current()) {
    if (!holds) {
        throw Mistake(std::string(sentence) + " (" + place.file_name() + ":" + std::to_string(place.line()) + ")");
    }
}

/// As above; `describe()` returns the sentence and runs only on failure.
template <typename Describe>
requires requires(Describe describe) { std::string(describe()); }
inline void expect(bool holds, Describe&& describe, std::source_location place = std::source_location::current()) {
    if (!holds) {
        throw Mistake(std::string(describe()) + " (" + place.file_name() + ":" + std::to_string(place.line()) + ")");
    }
}

}  // namespace halfframe
