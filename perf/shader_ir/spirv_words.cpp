// Walks over the words; nothing is built of them.
#include "perf/shader_ir/spirv_words.h"

#include <array>
#include <map>
#include <span>

#include <fmt/format.h>
#include <glslang/SPIRV/spirv.hpp>

#include "engine/error.h"
#include "engine/gl/program.h"

namespace halfframe::shader_ir {
namespace {

constexpr std::size_t kHeaderWords = 5;
constexpr std::size_t kBound = 3;

/// Numbers in one variable. Uniform blocks of 64 KiB, the largest that drivers promise, hold 16384.
constexpr double kMostNumbers = 65536.0;

struct Word {
    spv::Op op = spv::OpNop;
    std::span<const std::uint32_t> operands;  ///< all words behind the first
};

template <typename Use>
void each_instruction(const std::vector<std::uint32_t>& words, Use use) {
    for (std::size_t at = kHeaderWords; at < words.size();) {
        const std::uint32_t length = words[at] >> spv::WordCountShift;
        use(Word{static_cast<spv::Op>(words[at] & spv::OpCodeMask), std::span(words).subspan(at + 1, length - 1)});
        at += length;
    }
}

std::string text_at(std::span<const std::uint32_t> words) {
    std::string text;
    for (const std::uint32_t word : words) {
        for (int byte = 0; byte < 4; ++byte) {
            const char letter = static_cast<char>((word >> (8 * byte)) & 0xffu);
            if (letter == '\0') return text;
            text += letter;
        }
    }
    return text;
}

void append(std::vector<std::uint32_t>& words, spv::Op op, std::span<const std::uint32_t> operands) {
    words.push_back(static_cast<std::uint32_t>(op) |
                    static_cast<std::uint32_t>((operands.size() + 1) << spv::WordCountShift));
    words.insert(words.end(), operands.begin(), operands.end());
}

class Refusal {
public:
    explicit Refusal(const std::vector<std::string>& files) : files_(files) {}

    void read(const Word& one) {
        const auto& operands = one.operands;
        switch (one.op) {
            case spv::OpName: names_[operands[0]] = text_at(operands.subspan(1)); break;
            case spv::OpLine: line_ = operands[1]; break;
            case spv::OpDecorate:
                if (operands[1] == spv::DecorationBufferBlock) kinds_[operands[0]] = "the storage buffer";
                break;
            case spv::OpConstant: constants_[operands[1]] = operands[2]; break;
            case spv::OpTypeImage:
                if (operands[6] == 2) kinds_[operands[0]] = "the image";  // 2: read and written without a sampler
                break;
            case spv::OpTypeBool:
            case spv::OpTypeInt:
            case spv::OpTypeFloat: numbers_[operands[0]] = 1.0; break;
            case spv::OpTypeVector:
            case spv::OpTypeMatrix: numbers_[operands[0]] = numbers_[operands[1]] * operands[2]; break;
            case spv::OpTypeArray:
                numbers_[operands[0]] = numbers_[operands[1]] * constants_[operands[2]];
                take_kind(operands[0], operands[1]);
                break;
            case spv::OpTypeRuntimeArray: kinds_[operands[0]] = "the storage buffer"; break;
            case spv::OpTypeStruct:
                for (const std::uint32_t member : operands.subspan(1)) {
                    numbers_[operands[0]] += numbers_[member];
                    take_kind(operands[0], member);
                }
                break;
            case spv::OpTypePointer:
                numbers_[operands[0]] = numbers_[operands[2]];
                take_kind(operands[0], operands[2]);
                if (!names_[operands[2]].empty()) names_.try_emplace(operands[0], names_[operands[2]]);
                if (operands[1] == spv::StorageClassAtomicCounter) kinds_[operands[0]] = "the atomic counter";
                break;
            case spv::OpVariable: read_variable(operands[0], operands[1]); break;
            default:
                if (in_function_) read_use(operands);
                in_function_ = in_function_ || one.op == spv::OpFunction;
        }
    }

private:
    void take_kind(std::uint32_t type, std::uint32_t inner) {
        if (const auto kind = kinds_.find(inner); kind != kinds_.end()) kinds_.try_emplace(type, kind->second);
    }

    void read_variable(std::uint32_t type, std::uint32_t variable) {
        // A block without a name of its own goes by that of its type.
        const std::string& name = names_[variable].empty() ? names_[type] : names_[variable];
        if (numbers_[type] > kMostNumbers)
            throw Error(Fault::check,
                        fmt::format("{}: '{}' holds {:.0f} numbers; what holds more than {:.0f} is neither counted nor "
                                    "run, and fits no device: make it smaller",
                                    place(), name, numbers_[type], kMostNumbers));
        if (const auto kind = kinds_.find(type); kind != kinds_.end())
            variables_[variable] = fmt::format("{} '{}'", kind->second, name);
    }

    void read_use(std::span<const std::uint32_t> operands) const {
        if (variables_.empty()) return;
        for (const std::uint32_t operand : operands) {
            const auto found = variables_.find(operand);
            if (found == variables_.end()) continue;
            throw Error(Fault::check,
                        fmt::format("{}: uses {}; storage buffers, images and atomic counters of ES 3.10 are neither "
                                    "counted nor run: put a texture or a uniform in its place and count that",
                                    place(), found->second));
        }
    }

    [[nodiscard]] std::string place() const {
        const std::size_t file = line_ / gl::kLinesPerFile;
        if (file >= files_.size()) return "a shader";
        return line_ == 0 ? files_[file] : fmt::format("{}:{}", files_[file], line_ % gl::kLinesPerFile);
    }

    const std::vector<std::string>& files_;
    std::map<std::uint32_t, std::string> names_;
    std::map<std::uint32_t, const char*> kinds_;  ///< by type: what it makes of a variable
    std::map<std::uint32_t, double> numbers_, constants_;
    std::map<std::uint32_t, std::string> variables_;  ///< that nothing may use, in words
    std::uint32_t line_ = 0;
    bool in_function_ = false;
};

}  // namespace

void refuse_uncounted(const std::vector<std::uint32_t>& words, const std::vector<std::string>& files) {
    Refusal refusal(files);
    each_instruction(words, [&](const Word& one) { refusal.read(one); });
}

void cut_blocks_of_many_calls(std::vector<std::uint32_t>& words) {
    constexpr int kMostCalls = 64;  // more than any function of ours has in a block: their words stay as they are
    std::vector<std::uint32_t> cut(words.begin(), words.begin() + kHeaderWords);
    std::map<std::uint32_t, std::uint32_t> last_part;  // by label: where the block ends now
    std::vector<std::uint32_t> line;                   // the OpLine in force, which ends with its block
    std::uint32_t label = 0;
    int calls = 0;
    each_instruction(words, [&](const Word& one) {
        if (one.op == spv::OpLine) line.assign(one.operands.begin(), one.operands.end());
        if (one.op == spv::OpNoLine) line.clear();
        if (one.op == spv::OpLabel) {
            label = one.operands[0];
            calls = 0;
            line.clear();
        }
        if (one.op == spv::OpFunctionCall && ++calls > kMostCalls) {
            const std::uint32_t next = cut[kBound]++;
            append(cut, spv::OpBranch, std::span(&next, 1));
            append(cut, spv::OpLabel, std::span(&next, 1));
            if (!line.empty()) append(cut, spv::OpLine, line);
            last_part[label] = next;
            calls = 1;
        }
        append(cut, one.op, one.operands);
    });
    if (last_part.empty()) return;
    for (std::size_t at = kHeaderWords; at < cut.size(); at += cut[at] >> spv::WordCountShift) {
        if (static_cast<spv::Op>(cut[at] & spv::OpCodeMask) != spv::OpPhi) continue;
        for (std::size_t from = at + 4; from < at + (cut[at] >> spv::WordCountShift); from += 2)
            if (const auto part = last_part.find(cut[from]); part != last_part.end()) cut[from] = part->second;
    }
    words = std::move(cut);
}

void cut_chains_of_inserts(std::vector<std::uint32_t>& words) {
    constexpr int kMostInserts = 64;  // more than any function of ours makes: their words stay as they are
    struct Vector {
        std::uint32_t component = 0;
        std::uint32_t count = 0;
    };
    std::map<std::uint32_t, Vector> vectors;
    std::map<std::uint32_t, int> inserts;  // by value: how many lie behind it
    std::vector<std::uint32_t> cut(words.begin(), words.begin() + kHeaderWords);
    each_instruction(words, [&](const Word& one) {
        const auto& operands = one.operands;
        if (one.op == spv::OpTypeVector) vectors[operands[0]] = {operands[1], operands[2]};
        if (one.op != spv::OpCompositeInsert || !vectors.contains(operands[0])) {
            append(cut, one.op, operands);
            return;
        }
        const std::uint32_t type = operands[0], result = operands[1], whole = operands[3], place = operands[4];
        const auto before = inserts.find(whole);
        const int count = before == inserts.end() ? 1 : before->second + 1;
        inserts[result] = count % kMostInserts;
        if (count < kMostInserts) {
            append(cut, one.op, operands);
            return;
        }
        std::vector<std::uint32_t> construction{type, result};
        for (std::uint32_t i = 0; i < vectors[type].count; ++i) {
            construction.push_back(i == place ? operands[2] : cut[kBound]++);
            if (i == place) continue;
            append(cut, spv::OpCompositeExtract, std::array{vectors[type].component, construction.back(), whole, i});
        }
        append(cut, spv::OpCompositeConstruct, construction);
    });
    words = std::move(cut);
}

}  // namespace halfframe::shader_ir
