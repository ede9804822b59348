// Counts of GL calls by pass.
#include "engine/gl/call_ledger.h"

#include <numeric>
#include <string_view>

#include "engine/error.h"
#include "engine/gl/call_number.h"

namespace halfframe::gl {
namespace {

constexpr std::array<const char*, kCallCount> kCallNames = {
#define HALFFRAME_GL(since, result, name, parameters, arguments) "gl" #name,
#include "engine/gl/entry_points.inl"
#undef HALFFRAME_GL
};

/// glGenerateMipmap fills an object that exists: it makes none.
bool creates_object(std::string_view name) {
    return name.starts_with("glCreate") || (name.starts_with("glGen") && !name.starts_with("glGenerate"));
}

}  // namespace

const char* call_name(int call) {
    expect(call >= 0 && call < kCallCount, [&] { return "there is no GL call number " + std::to_string(call); });
    return kCallNames[static_cast<std::size_t>(call)];
}

int call_count() { return kCallCount; }

std::uint64_t PassCalls::calls() const { return std::accumulate(count.begin(), count.end(), std::uint64_t{0}); }

CallLedger::CallLedger() {
    names_.reserve(kMaxPasses);
    names_.emplace_back("set-up");
}

int CallLedger::pass_index(const char* name) {
    for (std::size_t index = 0; index < names_.size(); ++index) {
        if (names_[index] == name) return static_cast<int>(index);
    }
    expect(names_.size() < kMaxPasses, [&] {
        return "the ledger has room for " + std::to_string(kMaxPasses) + " pass names and \"" + name +
               "\" is one more: pass names must not be made up per frame";
    });
    names_.emplace_back(name);
    return static_cast<int>(names_.size()) - 1;
}

std::uint64_t CallLedger::total(int call) const {
    std::uint64_t sum = 0;
    for (const PassCalls& pass : passes_) sum += pass.count[static_cast<std::size_t>(call)];
    return sum;
}

std::uint64_t CallLedger::object_creations() const {
    std::uint64_t sum = 0;
    for (int call = 0; call < kCallCount; ++call) {
        if (creates_object(kCallNames[static_cast<std::size_t>(call)])) sum += total(call);
    }
    return sum;
}

std::uint64_t CallLedger::program_links() const {
    return total(number(Call::LinkProgram)) + total(number(Call::ProgramBinary));
}

void CallLedger::clear() { passes_.fill(PassCalls{}); }

}  // namespace halfframe::gl
