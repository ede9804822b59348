// The machine behind evaluate(): registers of many lanes, and one instruction at a time for all lanes that are there.
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "perf/shader_ir/evaluate.h"

namespace halfframe::shader_ir {

using Lane = std::uint32_t;

/// Memory of a variable: scalar s of lane l is data[s * width + l].
struct Storage {
    std::vector<double> data;
    Id type = 0;
    std::string name;
    bool given = true;           ///< false: an input or uniform nobody gave; reading it is an error
    bool keeps_32_bits = false;  ///< inputs, uniforms and outputs: what is in them is not rounded to their precision
};

/// What an id holds: a value (laid out as Storage), or a pointer.
struct Register {
    std::vector<double> data;
    Storage* storage = nullptr;
    std::vector<std::uint32_t> offset;  ///< of pointers: first scalar in `storage`, per lane
    bool relaxed = false;               ///< of pointers: what is stored through it is rounded
};

/// GLSL has no recursion, so every id has one register for good and no call needs a stack. All lanes of a block of
/// instructions run together; where they part, each block of instructions keeps a list of the lanes that wait for it,
/// and the first block of the function that has any runs next. As SPIR-V orders blocks, lanes meet again where paths
/// do.
class Machine {
public:
    /// `width`: lanes at once. The module and the samplers must outlive the machine.
    Machine(const Module& module, Model model, const Bindings& bindings, std::size_t width);

    /// Readies all lanes below `lanes` for a run: outside variables get columns[begin...], nothing is discarded.
    void begin(const Bindings& bindings, std::size_t first, std::size_t lanes);
    void call(const Function& function);

    [[nodiscard]] Storage make_storage(Id type, const std::string& name) const;
    [[nodiscard]] Storage& variable(Id id) { return variables_.at(id); }
    [[nodiscard]] Register& at(Id id) { return registers_[id]; }
    void point(Id pointer, Storage& storage);
    /// Copies columns[first...] to `target`, rounded to its precision, to fp32 if it is not `relaxed`.
    void fill(Storage& target, const Columns& columns, std::size_t first, bool relaxed) const;
    [[nodiscard]] bool discarded(Lane lane) const { return discarded_[lane] != 0; }
    [[nodiscard]] double sampler_at(std::string_view name) const;
    [[nodiscard]] std::size_t width() const { return width_; }

private:
    // machine.cpp: control flow and memory
    using Waiting = std::vector<std::vector<Lane>>;
    void initialise(Storage& storage, Id initializer) const;
    void attach_sampler(Storage& storage) const;
    void run_block(const Function& function, const Block& block, Waiting& waiting);
    void leave(const Function& function, const Block& block, const Instruction& end, Waiting& waiting);
    void part(const Function& function, const Block& block, const Instruction& end, Waiting& waiting);
    void choose(std::span<const Instruction> phis);
    void run(const Instruction& one);
    void tell(const Instruction& one) const;
    bool run_memory(const Instruction& one);
    void make_variable(const Instruction& one);
    void load(const Instruction& one);
    void store(const Instruction& one);
    void follow(const Instruction& one);
    void call_function(const Instruction& one);
    void drop_discarded();
    // composites.cpp
    bool run_composite(const Instruction& one);
    void copy_scalars(const Instruction& one, std::size_t to, Id from, std::size_t first, std::size_t count);
    void extract_dynamic(const Instruction& one);
    void insert_dynamic(const Instruction& one);
    [[nodiscard]] std::size_t scalar_of_path(Id type, std::span<const std::uint32_t> path, Id* found) const;
    // arithmetic.cpp
    bool run_float(const Instruction& one);
    bool run_comparison(const Instruction& one);
    bool run_matrix(const Instruction& one);
    bool run_integer(const Instruction& one);
    bool run_logic(const Instruction& one);
    bool run_conversion(const Instruction& one);
    void select(const Instruction& one);
    // standard_functions.cpp, vector_functions.cpp
    bool run_standard(const Instruction& one);
    bool run_standard_scalar(const Instruction& one);
    bool run_standard_integer(const Instruction& one);
    bool run_standard_vector(const Instruction& one);
    bool run_standard_packing(const Instruction& one);
    void split(const Instruction& one);
    // sampling.cpp
    bool run_sampling(const Instruction& one);
    void sample(const Instruction& one);
    void query_size(const Instruction& one);

    [[noreturn]] void fail(const Instruction& one, const std::string& why) const;
    [[nodiscard]] const Type& type_of(Id id) const { return module_.type(types_[id]); }
    [[nodiscard]] std::size_t scalars_of(Id id) const { return type_of(id).scalars; }
    /// The lanes of one scalar of a value.
    [[nodiscard]] const double* in(Id id, std::size_t scalar) const { return &registers_[id].data[scalar * width_]; }
    [[nodiscard]] double* out(const Instruction& one, std::size_t scalar) {
        return &registers_[one.result].data[scalar * width_];
    }
    [[nodiscard]] Model format(bool relaxed) const {
        return relaxed || model_ == Model::in_double ? model_ : Model::in_float;
    }
    [[nodiscard]] Model format(const Instruction& one) const { return format(one.relaxed); }
    /// The format of an instruction that cannot be decorated, such as a comparison: narrow if all floats it reads are.
    [[nodiscard]] Model format_of_inputs(std::span<const Id> arguments) const;

    /// result[s] = f(arguments[0][s], ...) for each scalar s of the result and each active lane. Floats are rounded to
    /// the operation's format before and after. A scalar argument beside a vector result is the same for all scalars.
    template <typename F, std::size_t... Index>
    void each_of(const Instruction& one, std::span<const Id> arguments, Model before, Model after, F f,
                 std::index_sequence<Index...>) {
        const std::size_t scalars = module_.type(one.type).scalars;
        for (std::size_t s = 0; s < scalars; ++s) {
            const std::array<const double*, sizeof...(Index)> from{
                in(arguments[Index], scalars_of(arguments[Index]) > 1 ? s : 0)...};
            double* to = out(one, s);
            for (const Lane lane : active_) to[lane] = rounded(after, f(rounded(before, from[Index][lane])...));
        }
    }
    template <std::size_t Count, typename F>
    void each_float(const Instruction& one, std::span<const Id> arguments, F f) {
        // Whatever is in a register has at most 32 bits already: only narrow operations round what they read.
        const Model after = format(one);
        const Model before = is_narrow(after) ? after : Model::in_double;
        each_of(one, arguments, before, after, f, std::make_index_sequence<Count>());
    }
    template <std::size_t Count, typename F>
    void each_exact(const Instruction& one, std::span<const Id> arguments, F f) {
        each_of(one, arguments, Model::in_double, Model::in_double, f, std::make_index_sequence<Count>());
    }
    template <std::size_t Count, typename F>
    void each_compared(const Instruction& one, std::span<const Id> arguments, F f) {
        const Model before = format_of_inputs(arguments);
        each_of(one, arguments, before, Model::in_double, f, std::make_index_sequence<Count>());
    }
    /// A value of one lane, rounded as an argument of an operation of that format.
    [[nodiscard]] std::vector<double> lane_of(Id id, Lane lane, Model before) const;

    const Module& module_;
    Model model_;
    std::size_t width_;
    std::vector<Register> registers_;  ///< by id
    std::vector<Id> types_;            ///< by id: the type of what it holds; 0 for none
    std::map<Id, Storage> variables_;  ///< by id of the variable
    std::vector<const Sampler*> samplers_;
    std::vector<std::string> sampler_names_;
    std::vector<Lane> active_;
    std::vector<std::uint8_t> discarded_;
    const ResultWatch* watch_ = nullptr;  ///< while the first lanes run
    std::vector<Id> came_from_;  ///< per lane: label of the block before, for phi
};

/// Integers in registers are whole doubles. Conversions that C++ leaves undefined give 0 for NaN and the nearest limit.
[[nodiscard]] std::int32_t to_int(double x);
[[nodiscard]] std::uint32_t to_uint(double x);

/// Arithmetic whose every operation is rounded to one format, for functions made of several.
struct Rounded {
    Model model;
    [[nodiscard]] double operator()(double x) const { return rounded(model, x); }
    [[nodiscard]] double sum(double a, double b) const { return rounded(model, a + b); }
    [[nodiscard]] double difference(double a, double b) const { return rounded(model, a - b); }
    [[nodiscard]] double product(double a, double b) const { return rounded(model, a * b); }
    [[nodiscard]] double quotient(double a, double b) const { return rounded(model, a / b); }
    [[nodiscard]] double root(double a) const { return rounded(model, std::sqrt(a)); }
    /// ((z + y) + x), the order in which Mesa's compiler takes a dot product apart.
    [[nodiscard]] double dot(std::span<const double> a, std::span<const double> b) const;
    [[nodiscard]] double length(std::span<const double> a) const { return root(dot(a, a)); }
    /// exp2 and log2 in narrow formats: fp32's, then rounded once more, as llvmpipe does.
    [[nodiscard]] double exp2(double x) const;
    [[nodiscard]] double log2(double x) const;
    /// exp2(log2(x) * y), each rounded; 0 for x = 0 whatever y. In double: the mathematical power, NaN for x < 0.
    [[nodiscard]] double power(double x, double y) const;
};

}  // namespace halfframe::shader_ir
