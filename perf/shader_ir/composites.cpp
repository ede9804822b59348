// Building, taking apart and rearranging vectors, matrices, arrays and structures. Nothing here rounds.
#include "perf/shader_ir/machine.h"

namespace halfframe::shader_ir {

using Kind = Type::Kind;

/// First scalar of what a list of literal indices leads to in a value of type `type`; `found` gets its type.
std::size_t Machine::scalar_of_path(Id type, std::span<const std::uint32_t> path, Id* found) const {
    std::size_t first = 0;
    for (const std::uint32_t index : path) {
        const Type& outer = module_.type(type);
        if (outer.kind == Kind::structure) {
            for (std::uint32_t m = 0; m < index; ++m) first += module_.type(outer.members[m]).scalars;
            type = outer.members[index];
        } else {
            type = outer.element;
            first += index * module_.type(type).scalars;
        }
    }
    *found = type;
    return first;
}

void Machine::copy_scalars(const Instruction& one, std::size_t to, Id from, std::size_t first, std::size_t count) {
    for (std::size_t s = 0; s < count; ++s) {
        const double* source = in(from, first + s);
        double* target = out(one, to + s);
        for (const Lane lane : active_) target[lane] = source[lane];
    }
}

bool Machine::run_composite(const Instruction& one) {
    const auto& words = one.operands;
    Id part = 0;
    switch (one.op) {
        case spv::OpUndef: return true;
        case spv::OpCopyObject: copy_scalars(one, 0, words[0], 0, scalars_of(words[0])); return true;
        case spv::OpCompositeConstruct: {
            std::size_t to = 0;
            for (const Id id : words) {
                copy_scalars(one, to, id, 0, scalars_of(id));
                to += scalars_of(id);
            }
            return true;
        }
        case spv::OpCompositeExtract: {
            const std::size_t first = scalar_of_path(types_[words[0]], std::span(words).subspan(1), &part);
            copy_scalars(one, 0, words[0], first, module_.type(part).scalars);
            return true;
        }
        case spv::OpCompositeInsert: {
            copy_scalars(one, 0, words[1], 0, scalars_of(words[1]));
            const std::size_t first = scalar_of_path(one.type, std::span(words).subspan(2), &part);
            copy_scalars(one, first, words[0], 0, module_.type(part).scalars);
            return true;
        }
        case spv::OpVectorShuffle: {
            const std::size_t of_first = scalars_of(words[0]);
            for (std::size_t s = 2; s < words.size(); ++s) {
                constexpr std::uint32_t kUndefined = 0xffffffffu;
                if (words[s] == kUndefined) continue;
                const bool second = words[s] >= of_first;
                copy_scalars(one, s - 2, words[second ? 1 : 0], words[s] - (second ? of_first : 0), 1);
            }
            return true;
        }
        case spv::OpVectorExtractDynamic: extract_dynamic(one); return true;
        case spv::OpVectorInsertDynamic: insert_dynamic(one); return true;
        case spv::OpTranspose: {
            const std::size_t columns = type_of(words[0]).count;
            const std::size_t rows = scalars_of(words[0]) / columns;
            for (std::size_t c = 0; c < columns; ++c) {
                for (std::size_t r = 0; r < rows; ++r) copy_scalars(one, r * columns + c, words[0], c * rows + r, 1);
            }
            return true;
        }
        default: return false;
    }
}

void Machine::extract_dynamic(const Instruction& one) {
    const double* index = in(one.operands[1], 0);
    const auto count = static_cast<double>(scalars_of(one.operands[0]));
    for (const Lane lane : active_) {
        if (index[lane] < 0.0 || index[lane] >= count) fail(one, "an index outside its vector");
        out(one, 0)[lane] = in(one.operands[0], static_cast<std::size_t>(index[lane]))[lane];
    }
}

void Machine::insert_dynamic(const Instruction& one) {
    copy_scalars(one, 0, one.operands[0], 0, scalars_of(one.operands[0]));
    const double* index = in(one.operands[2], 0);
    const auto count = static_cast<double>(scalars_of(one.operands[0]));
    for (const Lane lane : active_) {
        if (index[lane] < 0.0 || index[lane] >= count) fail(one, "an index outside its vector");
        out(one, static_cast<std::size_t>(index[lane]))[lane] = in(one.operands[1], 0)[lane];
    }
}

}  // namespace halfframe::shader_ir
