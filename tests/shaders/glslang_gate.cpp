// Drives glslang and reads the interface of a program out of its syntax trees.
#include "tests/shaders/glslang_gate.h"

#include <algorithm>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <glslang/Include/intermediate.h>
#include <glslang/MachineIndependent/localintermediate.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>

namespace halfframe::shaders {
namespace {

/// glslang keeps its symbol tables between programs as long as one of these lives.
struct GlslangProcess {
    GlslangProcess() { glslang::InitializeProcess(); }
    ~GlslangProcess() { glslang::FinalizeProcess(); }
    GlslangProcess(const GlslangProcess&) = delete;
    GlslangProcess& operator=(const GlslangProcess&) = delete;
};

TBuiltInResource resources(gl::Dialect dialect, const ProgramLimits& limits) {
    TBuiltInResource values = *GetDefaultResources();
    values.maxVertexAttribs = limits.attributes;
    values.maxVaryingVectors = limits.varying_vectors;
    values.maxVertexOutputVectors = limits.varying_vectors + 1;  // ES 3.0: gl_Position counts among the outputs
    values.maxFragmentInputVectors = limits.varying_vectors;
    values.maxVertexUniformVectors = limits.vertex_uniform_vectors;
    values.maxFragmentUniformVectors = limits.fragment_uniform_vectors;
    values.maxVertexTextureImageUnits = limits.vertex_samplers;
    values.maxTextureImageUnits = limits.fragment_samplers;
    values.maxCombinedTextureImageUnits = limits.combined_samplers;
    values.maxDrawBuffers = dialect == gl::Dialect::es100 ? 1 : 4;
    if (dialect == gl::Dialect::es100) values.limits = {};  // all false: what Appendix A allows and nothing more
    return values;
}

/// One scalar, vector, matrix or array of them; structures are taken apart.
struct InterfaceVariable {
    std::string name;
    glslang::TPrecisionQualifier precision = glslang::EpqNone;
    bool sampler = false;
    int elements = 1;
    PackedVariable packed;
};

struct StageInterface {
    std::vector<InterfaceVariable> uniforms;
    std::vector<InterfaceVariable> inputs;
    std::vector<InterfaceVariable> outputs;
};

int element_count(const glslang::TType& type) {
    return type.isArray() && !type.isUnsizedArray() ? type.getCumulativeArraySize() : 1;
}

void add(const std::string& name, const glslang::TType& type, int elements, std::vector<InterfaceVariable>& into) {
    elements *= element_count(type);
    if (type.isStruct()) {
        for (const glslang::TTypeLoc& member : *type.getStruct()) {
            add(name + "." + member.type->getFieldName().c_str(), *member.type, elements, into);
        }
        return;
    }
    InterfaceVariable variable;
    variable.name = name;
    variable.precision = type.getQualifier().precision;
    variable.sampler = type.getBasicType() == glslang::EbtSampler;
    variable.elements = elements;
    variable.packed.columns = type.isMatrix() ? type.getMatrixRows() : type.getVectorSize();
    variable.packed.rows = elements * (type.isMatrix() ? type.getMatrixCols() : 1);
    // mat2 takes two whole rows (A.7).
    if (type.isMatrix() && variable.packed.columns == 2) variable.packed.columns = 4;
    into.push_back(variable);
}

/// Built-in inputs (gl_FragCoord, gl_FrontFacing, gl_PointCoord) that the stage reads take room like varyings.
class BuiltInInputs : public glslang::TIntermTraverser {
public:
    void visitSymbol(glslang::TIntermSymbol* symbol) override {
        const glslang::TStorageQualifier storage = symbol->getQualifier().storage;
        const bool counts =
            storage == glslang::EvqFragCoord || storage == glslang::EvqFace || storage == glslang::EvqPointCoord;
        if (counts && seen_.insert(symbol->getName().c_str()).second)
            add(symbol->getName().c_str(), symbol->getType(), 1, found);
    }
    std::vector<InterfaceVariable> found;

private:
    std::set<std::string> seen_;
};

StageInterface interface_of(const glslang::TIntermediate& tree, gl::Stage stage) {
    StageInterface result;
    for (TIntermNode* node : tree.findLinkerObjects()->getSequence()) {
        const glslang::TIntermSymbol* symbol = node->getAsSymbolNode();
        if (symbol == nullptr) continue;
        const std::string name = symbol->getName().c_str();
        const glslang::TStorageQualifier storage = symbol->getQualifier().storage;
        if (storage == glslang::EvqUniform) add(name, symbol->getType(), 1, result.uniforms);
        if (storage == glslang::EvqVaryingIn) add(name, symbol->getType(), 1, result.inputs);
        if (storage == glslang::EvqVaryingOut) add(name, symbol->getType(), 1, result.outputs);
    }
    if (stage == gl::Stage::fragment) {
        BuiltInInputs built_in;
        tree.getTreeRoot()->traverse(&built_in);
        result.inputs.insert(result.inputs.end(), built_in.found.begin(), built_in.found.end());
    }
    return result;
}

int rows_of(const std::vector<InterfaceVariable>& variables) {
    std::vector<PackedVariable> packed;
    for (const InterfaceVariable& variable : variables) {
        if (!variable.sampler) packed.push_back(variable.packed);
    }
    return packed_rows(std::move(packed));
}

int samplers_of(const std::vector<InterfaceVariable>& variables) {
    int samplers = 0;
    for (const InterfaceVariable& variable : variables) samplers += variable.sampler ? variable.elements : 0;
    return samplers;
}

ProgramCounts counts_of(const StageInterface& vertex, const StageInterface& fragment) {
    ProgramCounts counts;
    for (const InterfaceVariable& attribute : vertex.inputs) counts.attributes += attribute.packed.rows;
    counts.varying_vectors = std::max(rows_of(vertex.outputs), rows_of(fragment.inputs));
    counts.vertex_uniform_vectors = rows_of(vertex.uniforms);
    counts.fragment_uniform_vectors = rows_of(fragment.uniforms);
    counts.vertex_samplers = samplers_of(vertex.uniforms);
    counts.fragment_samplers = samplers_of(fragment.uniforms);
    counts.combined_samplers = counts.vertex_samplers + counts.fragment_samplers;
    return counts;
}

struct CountName {
    const char* what;
    int ProgramLimits::*member;
};
constexpr CountName kCountNames[] = {
    {"attributes", &ProgramLimits::attributes},
    {"varying vectors", &ProgramLimits::varying_vectors},
    {"vertex uniform vectors", &ProgramLimits::vertex_uniform_vectors},
    {"fragment uniform vectors", &ProgramLimits::fragment_uniform_vectors},
    {"vertex samplers", &ProgramLimits::vertex_samplers},
    {"fragment samplers", &ProgramLimits::fragment_samplers},
    {"samplers of both stages", &ProgramLimits::combined_samplers},
};

void lint_precision(const ProgramTexts& program, const char* kind, const std::vector<InterfaceVariable>& vertex,
                    const std::vector<InterfaceVariable>& fragment, std::vector<std::string>& faults) {
    for (const InterfaceVariable& one : vertex) {
        for (const InterfaceVariable& other : fragment) {
            if (one.name != other.name || one.precision == other.precision) continue;
            faults.push_back(fmt::format("{}: the {} {} is {} in {} and {} in {}", program.name, kind, one.name,
                                         glslang::GetPrecisionQualifierString(one.precision), program.vertex_file,
                                         glslang::GetPrecisionQualifierString(other.precision), program.fragment_file));
        }
    }
}

/// glslang's link says nothing about a fragment input that no vertex stage writes; drivers refuse it.
void find_orphans(const ProgramTexts& program, const StageInterface& vertex, const StageInterface& fragment,
                  std::vector<std::string>& faults) {
    for (const InterfaceVariable& input : fragment.inputs) {
        const auto same_name = [&](const InterfaceVariable& output) { return output.name == input.name; };
        if (input.name.starts_with("gl_") || std::any_of(vertex.outputs.begin(), vertex.outputs.end(), same_name))
            continue;
        faults.push_back(fmt::format("{}: {} reads {}, which {} does not declare", program.name, program.fragment_file,
                                     input.name, program.vertex_file));
    }
}

/// On a device whose fragments have no highp, the word itself is an error. Must run before the stages are parsed:
/// glslang allocates from the pool of the shader that was last at work, and this one is gone afterwards.
void find_highp(const ProgramTexts& program, const ProgramLimits& limits, std::vector<std::string>& faults) {
    glslang::TShader shader(EShLangFragment);
    const char* source = program.fragment.text.c_str();
    shader.setStrings(&source, 1);
    const TBuiltInResource values = resources(program.dialect, limits);
    glslang::TShader::ForbidIncluder includer;
    std::string preprocessed;
    // A text that the preprocessor refuses is refused by the parser too, with its sentence.
    if (!shader.preprocess(&values, 100, EEsProfile, false, false, EShMsgDefault, &preprocessed, includer)) return;
    if (preprocessed.find("highp") == std::string::npos) return;
    faults.push_back(program.name + ": highp reaches a fragment stage without highp, " + program.fragment_file);
}

/// One stage: parsed, with every complaint added to `faults`. glslang reads the texts through pointers: keep them
/// alive.
class ParsedStage {
public:
    ParsedStage(const ProgramTexts& program, gl::Stage stage, const ProgramLimits& limits,
                std::vector<std::string>& faults)
        : text_(stage == gl::Stage::vertex ? program.vertex : program.fragment),
          source_(text_.text.c_str()),
          shader(stage == gl::Stage::vertex ? EShLangVertex : EShLangFragment) {
        const int version = program.dialect == gl::Dialect::es100 ? 100 : 300;
        const TBuiltInResource values = resources(program.dialect, limits);
        shader.setStrings(&source_, 1);
        parsed = shader.parse(&values, version, EEsProfile, false, false, EShMsgDefault);
        if (!parsed) add_lines(program.name, shader.getInfoLog(), faults);
        if (parsed && (shader.getIntermediate()->getVersion() != version ||
                       shader.getIntermediate()->getProfile() != EEsProfile)) {
            faults.push_back(fmt::format("{}: the text says version {}, but the dialect is {} es", program.name,
                                         shader.getIntermediate()->getVersion(), version));
        }
    }

private:
    gl::StageText text_;
    const char* source_;

    void add_lines(const std::string& name, const char* log, std::vector<std::string>& faults) const {
        std::istringstream lines(gl::translate_log(log, text_));
        for (std::string line; std::getline(lines, line);) {
            // After a first error glslang adds lines that say only that it stopped.
            const bool says_nothing = line.find("compilation terminated") != std::string::npos ||
                                      line.find("compilation errors") != std::string::npos ||
                                      line.find("missing #endif") != std::string::npos;
            if (line.find("ERROR:") != std::string::npos && !says_nothing) faults.push_back(name + ": " + line);
        }
        if (faults.empty()) faults.push_back(name + ": " + log);
    }

public:
    glslang::TShader shader;
    bool parsed = false;
};

}  // namespace

GateReport check_program(const ProgramTexts& program, const ProgramLimits& limits) {
    static const GlslangProcess kProcess;
    GateReport report;
    if (!program.fragment_highp) find_highp(program, limits, report.faults);
    ParsedStage vertex(program, gl::Stage::vertex, limits, report.faults);
    ParsedStage fragment(program, gl::Stage::fragment, limits, report.faults);
    if (!vertex.parsed || !fragment.parsed) return report;

    const StageInterface vertex_interface = interface_of(*vertex.shader.getIntermediate(), gl::Stage::vertex);
    const StageInterface fragment_interface = interface_of(*fragment.shader.getIntermediate(), gl::Stage::fragment);
    report.counts = counts_of(vertex_interface, fragment_interface);
    for (const CountName& count : kCountNames) {
        if (report.counts.*count.member <= limits.*count.member) continue;
        report.faults.push_back(fmt::format("{}: {} {}, but the poorest device has {}", program.name,
                                            report.counts.*count.member, count.what, limits.*count.member));
    }
    lint_precision(program, "uniform", vertex_interface.uniforms, fragment_interface.uniforms, report.faults);
    lint_precision(program, "varying", vertex_interface.outputs, fragment_interface.inputs, report.faults);
    find_orphans(program, vertex_interface, fragment_interface, report.faults);

    glslang::TProgram linked;
    linked.addShader(&vertex.shader);
    linked.addShader(&fragment.shader);
    if (!linked.link(EShMsgDefault)) {
        std::istringstream lines(linked.getInfoLog());
        for (std::string line; std::getline(lines, line);) {
            if (line.find("ERROR:") != std::string::npos) report.faults.push_back(program.name + ": " + line);
        }
    }
    return report;
}

GateReport check_program(const ProgramTexts& program) {
    return check_program(program, program.dialect == gl::Dialect::es100 ? kEs20Minimums : kEs30Minimums);
}

}  // namespace halfframe::shaders
