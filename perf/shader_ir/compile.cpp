// Drives glslang and the validator and optimizer of SPIRV-Tools.
#include "perf/shader_ir/compile.h"

#include <fmt/format.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <map>
#include <optional>
#include <set>
#include <spirv-tools/libspirv.hpp>
#include <spirv-tools/optimizer.hpp>
#include <sstream>
#include <tuple>

#include "engine/error.h"
#include "perf/shader_ir/loop_rounds.h"
#include "perf/shader_ir/spirv_words.h"
#include "perf/shader_ir/stage_cache.h"

namespace halfframe::shader_ir {
namespace {

constexpr spv_target_env kEnvironment = SPV_ENV_OPENGL_4_5;

/// glslang keeps its symbol tables between programs as long as one of these lives.
struct GlslangProcess {
    GlslangProcess() { glslang::InitializeProcess(); }
    ~GlslangProcess() { glslang::FinalizeProcess(); }
    GlslangProcess(const GlslangProcess&) = delete;
    GlslangProcess& operator=(const GlslangProcess&) = delete;
};

/// Throws glslang's report with our files and lines, without the lines that only say that it stopped.
[[noreturn]] void refuse(const std::string& log, const gl::StageText& text) {
    constexpr std::string_view kMark = "ERROR: ";
    std::string story;
    std::istringstream lines(gl::translate_log(log, text));
    for (std::string line; std::getline(lines, line);) {
        const bool says_nothing = line.find("compilation terminated") != std::string::npos ||
                                  line.find("compilation errors") != std::string::npos;
        if (!line.starts_with(kMark) || says_nothing) continue;
        story += (story.empty() ? "" : "; ") + line.substr(kMark.size());
    }
    // What is wrong with the whole has no line; then the file at least.
    const std::string file = text.files.empty() ? std::string("a shader") : text.files.front();
    if (story.find("Missing entry point") != std::string::npos)
        throw Error(Fault::check, file + ": there is no main(), so there is nothing to compile");
    if (story.find("Recursion detected") != std::string::npos)
        throw Error(Fault::check, file + ": a function calls itself, which GLSL ES does not allow");
    if (const std::size_t at = story.find("'' :  memory exhausted"); at != std::string::npos)
        throw Error(Fault::check,
                    story.substr(0, at) + "nested more deeply than a compiler goes; cut it into functions");
    throw Error(Fault::check, "a shader does not compile to SPIR-V: " + (story.empty() ? file + ": " + log : story));
}

void start_glslang() { static const GlslangProcess kProcess; }

std::vector<std::uint32_t> spirv_of(const gl::StageText& text, gl::Stage stage) {
    start_glslang();
    const EShLanguage language = stage == gl::Stage::vertex ? EShLangVertex : EShLangFragment;
    glslang::TShader shader(language);
    const char* source = text.text.c_str();
    shader.setStrings(&source, 1);
    // glslang makes no SPIR-V from 3.00; 3.10 has all of it and only adds.
    shader.setOverrideVersion(310);
    shader.setEnvInput(glslang::EShSourceGlsl, language, glslang::EShClientOpenGL, 100);
    shader.setEnvClient(glslang::EShClientOpenGL, glslang::EShTargetOpenGL_450);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_0);
    shader.setAutoMapBindings(true);
    shader.setAutoMapLocations(true);
    // Functions that main does not call are evaluated too.
    const auto messages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgKeepUncalled);
    if (!shader.parse(GetDefaultResources(), 310, EEsProfile, false, false, messages)) {
        refuse(shader.getInfoLog(), text);
    }
    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(messages) || !program.mapIO()) refuse(program.getInfoLog(), text);

    glslang::TIntermediate* tree = program.getIntermediate(language);
    tree->setSourceFile("stage");  // without a name no lines are written
    glslang::SpvOptions options;
    options.generateDebugInfo = true;
    options.disableOptimizer = true;
    spv::SpvBuildLogger logger;
    std::vector<std::uint32_t> words;
    glslang::GlslangToSpv(*tree, words, &logger, &options);
    const std::string complaints = logger.getAllMessages();
    expect(complaints.find("error") == std::string::npos, [&] { return "glslang made bad SPIR-V: " + complaints; });
    refuse_uncounted(words, text.files);
    return words;
}

/// Collects what SPIRV-Tools says.
spvtools::MessageConsumer into(std::string& story) {
    return [&story](spv_message_level_t level, const char*, const spv_position_t&, const char* message) {
        if (level <= SPV_MSG_ERROR) story += std::string(message) + ' ';
    };
}

void expect_valid(const std::vector<std::uint32_t>& words) {
    std::string story;
    spvtools::SpirvTools tools(kEnvironment);
    tools.SetMessageConsumer(into(story));
    // Names in the validator's sentences are found by trying, which takes minutes where thousands of values share one.
    spvtools::ValidatorOptions options;
    options.SetFriendlyNames(false);
    expect(tools.Validate(words.data(), words.size(), options), [&] { return "SPIR-V that is not valid: " + story; });
}

/// glslang marks no loop: unrolling is asked for by a bit of OpLoopMerge, its third operand. `wanted`: by loop.
void ask_to_unroll(std::vector<std::uint32_t>& words, const std::vector<bool>& wanted) {
    std::size_t loop = 0;
    constexpr std::size_t kHeaderWords = 5;
    constexpr std::size_t kLoopControl = 3;
    for (std::size_t at = kHeaderWords; at < words.size(); at += words[at] >> spv::WordCountShift) {
        if (static_cast<spv::Op>(words[at] & spv::OpCodeMask) == spv::OpLoopMerge && wanted.at(loop++))
            words.at(at + kLoopControl) |= spv::LoopControlUnrollMask;
    }
}

/// The unroller copies instructions and forgets their decorations. What was mediump before is found again by its line,
/// operation and type; where these do not tell, an operation is mediump when all it reads is, as in GLSL ES.
class PrecisionMemory {
public:
    explicit PrecisionMemory(const Module& before) {
        each(before, [&](const Instruction& one) { seen_[key(before, one)].insert(one.relaxed); });
    }

    void restore(Module& after) const {
        for (bool changed = true; changed;) {
            changed = false;
            for (Function& function : after.functions) {
                for (Block& block : function.blocks) {
                    for (Instruction& one : block.instructions) {
                        if (one.result == 0 || one.relaxed || !was_relaxed(after, one)) continue;
                        one.relaxed = true;
                        after.relaxed.at(one.result) = true;
                        changed = true;
                    }
                }
            }
        }
    }

private:
    using Key = std::tuple<std::uint32_t, spv::Op, std::uint32_t, std::uint32_t>;

    template <typename Use>
    static void each(const Module& module, Use use) {
        for (const Function& function : module.functions) {
            for (const Block& block : function.blocks) {
                for (const Instruction& one : block.instructions)
                    if (one.result != 0 && one.type != 0) use(one);
            }
        }
    }

    static Key key(const Module& module, const Instruction& one) {
        const std::uint32_t function = one.op == spv::OpExtInst ? one.operands.at(1) : 0;
        return {one.line, one.op, function, module.type(one.type).scalars};
    }

    bool was_relaxed(const Module& after, const Instruction& one) const {
        const auto found = seen_.find(key(after, one));
        if (found != seen_.end() && found->second.size() == 1) return *found->second.begin();
        if (one.op == spv::OpLoad || after.type(one.type).kind == Type::Kind::pointer) return false;
        bool any = false;
        for (std::size_t i = one.op == spv::OpExtInst ? 2 : 0; i < one.operands.size(); ++i) {
            const Id operand = one.operands[i];
            if (operand >= after.bound || after.constants.contains(operand)) continue;
            if (!after.relaxed[operand]) return false;
            any = true;
        }
        return any;
    }

    std::map<Key, std::set<bool>> seen_;
};

void register_inlining(spvtools::Optimizer& optimizer) {
    optimizer.RegisterPass(spvtools::CreateInlineExhaustivePass())
        .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
        .RegisterPass(spvtools::CreateScalarReplacementPass())
        .RegisterPass(spvtools::CreateLocalAccessChainConvertPass())
        // Not needed for what comes out: the next one looks at all uses of a variable at each of its uses.
        .RegisterPass(spvtools::CreateLocalSingleBlockLoadStoreElimPass())
        .RegisterPass(spvtools::CreateSSARewritePass())
        .RegisterPass(spvtools::CreateAggressiveDCEPass());
}

/// Inlining leaves out functions that return from inside a loop: these are given one return first.
void register_one_return(spvtools::Optimizer& optimizer) { optimizer.RegisterPass(spvtools::CreateMergeReturnPass()); }

/// Twice: unrolling turns indices into constants, and only then can arrays be taken apart and branches be decided.
void register_optimising(spvtools::Optimizer& optimizer) {
    for (int round = 0; round < 2; ++round) {
        optimizer.RegisterPass(spvtools::CreateCCPPass())
            .RegisterPass(spvtools::CreateLoopUnrollPass(true))
            .RegisterPass(spvtools::CreateDeadBranchElimPass())
            .RegisterPass(spvtools::CreateScalarReplacementPass())
            .RegisterPass(spvtools::CreateLocalAccessChainConvertPass())
            .RegisterPass(spvtools::CreateLocalSingleBlockLoadStoreElimPass())
            .RegisterPass(spvtools::CreateSSARewritePass())
            .RegisterPass(spvtools::CreateCCPPass())
            .RegisterPass(spvtools::CreateSimplificationPass())
            .RegisterPass(spvtools::CreateIfConversionPass())
            .RegisterPass(spvtools::CreateSimplificationPass())
            .RegisterPass(spvtools::CreateRedundancyEliminationPass())
            .RegisterPass(spvtools::CreateDeadBranchElimPass())
            .RegisterPass(spvtools::CreateBlockMergePass())
            .RegisterPass(spvtools::CreateAggressiveDCEPass());
    }
}

void run(void (*register_passes)(spvtools::Optimizer&), std::vector<std::uint32_t>& words) {
    std::string story;
    spvtools::Optimizer optimizer(kEnvironment);
    optimizer.SetMessageConsumer(into(story));
    register_passes(optimizer);
    std::vector<std::uint32_t> cleaned;
    spvtools::OptimizerOptions options;
    options.set_run_validator(false);  // once before and once after all of it is enough: expect_valid()
    expect(optimizer.Run(words.data(), words.size(), &cleaned, options),
           [&] { return "SPIRV-Tools gave up: " + story; });
    words = std::move(cleaned);
}

}  // namespace

std::string compiler_versions() {
    const glslang::Version version = glslang::GetVersion();
    return fmt::format("glslang {}.{}.{}, SPIRV-Tools {}", version.major, version.minor, version.patch,
                       spvSoftwareVersionString());
}

void check_es100(const gl::StageText& text) {
    start_glslang();
    glslang::TShader shader(EShLangFragment);
    const char* source = text.text.c_str();
    shader.setStrings(&source, 1);
    if (!shader.parse(GetDefaultResources(), 100, EEsProfile, false, false, EShMsgDefault))
        refuse(shader.getInfoLog(), text);
}

namespace {

StageCache::Kept optimised(const gl::StageText& text, gl::Stage stage) {
    std::vector<std::uint32_t> words = spirv_of(text, stage);
    expect_valid(words);
    run(register_one_return, words);
    cut_blocks_of_many_calls(words);
    run(register_inlining, words);
    cut_chains_of_inserts(words);
    StageCache::Kept kept{.inlined = words};
    ask_to_unroll(words, loops_to_unroll(parse(words, text.files)));
    run(register_optimising, words);
    expect_valid(words);
    kept.optimised = std::move(words);
    return kept;
}

Module module_of(StageCache::Kept kept, const gl::StageText& text) {
    const PrecisionMemory memory(parse(std::move(kept.inlined), text.files));
    Module module = parse(std::move(kept.optimised), text.files);
    memory.restore(module);
    return module;
}

}  // namespace

Module compile(const gl::StageText& text, gl::Stage stage, Cleaning cleaning) {
    if (cleaning == Cleaning::optimised) return module_of(optimised(text, stage), text);
    std::vector<std::uint32_t> words = spirv_of(text, stage);
    if (cleaning == Cleaning::inlined) {
        cut_blocks_of_many_calls(words);
        run(register_inlining, words);
    }
    expect_valid(words);
    return parse(std::move(words), text.files);
}

Module compile_kept(const gl::StageText& text, gl::Stage stage, const StageCache& cache) {
    const std::string key = StageCache::key_of(text, stage);
    std::optional<StageCache::Kept> kept = cache.find(key);
    if (!kept) {
        kept = optimised(text, stage);
        cache.keep(key, *kept);
    }
    return module_of(*std::move(kept), text);
}

Module compile(const gl::ProgramDescription& description, gl::Stage stage, Cleaning cleaning,
               std::span<const gl::ShaderFile> files) {
    gl::ProgramDescription twin = description;
    twin.dialect = gl::Dialect::es300;
    Module module = compile(gl::assemble_stage(twin, stage, files), stage, cleaning);
    module.up_converted = description.dialect == gl::Dialect::es100;
    return module;
}

Module compile(const FunctionFiles& wanted, std::span<const gl::ShaderFile> files) {
    constexpr const char* kMainPath = "<functions>";
    constexpr const char* kMorePath = "<more text>";
    std::string text;
    for (const std::string& path : wanted.paths) text += fmt::format("#include \"{}\"\n", path);
    text += fmt::format("#include \"{}\"\nvoid main() {{ fragment_color = vec4(0.0); }}\n", kMorePath);
    std::vector<gl::ShaderFile> all(files.begin(), files.end());
    all.push_back({kMainPath, text});
    all.push_back({kMorePath, wanted.more_text});
    gl::ProgramDescription description;
    description.name = "functions";
    description.vertex = kMainPath;
    description.fragment = kMainPath;
    description.arithmetic = wanted.arithmetic;
    description.defines = wanted.defines;
    return compile(gl::assemble_stage(description, gl::Stage::fragment, all), gl::Stage::fragment);
}

}  // namespace halfframe::shader_ir
