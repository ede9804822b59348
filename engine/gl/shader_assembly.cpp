// Puts shader stages together from files, and translates drivers' logs back to these files.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>

#include "engine/error.h"
#include "engine/gl/program.h"
#include "engine/gl/uniforms_by_vertex.h"

namespace halfframe::gl {
namespace {

constexpr std::string_view kIncludeWord = "#include";
constexpr std::string_view kInsertWord = "//@insert ";
constexpr std::string_view kInsertFunctionsWord = "//@insert_functions";

std::string_view trimmed(std::string_view text) {
    const auto is_space = [](char letter) { return std::isspace(static_cast<unsigned char>(letter)) != 0; };
    while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
    return text;
}

const ShaderFile* find_in(std::span<const ShaderFile> files, std::string_view path) {
    const auto found =
        std::find_if(files.begin(), files.end(), [&](const ShaderFile& file) { return file.path == path; });
    return found != files.end() ? &*found : nullptr;
}

/// Calls use(line, line_number) for each line without its end; numbers start at 1.
template <typename Use>
void for_each_line(std::string_view text, Use use) {
    for (int number = 1; !text.empty(); ++number) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        use(text.substr(0, end), number);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
}

/// The path of `#include "path"`.
std::optional<std::string_view> included_path(std::string_view line) {
    if (!line.starts_with(kIncludeWord)) return std::nullopt;
    const std::string_view rest = trimmed(line.substr(kIncludeWord.size()));
    const std::size_t closing = rest.size() > 1 ? rest.find('"', 1) : std::string_view::npos;
    if (rest.empty() || rest.front() != '"' || closing == std::string_view::npos) return std::string_view();
    return rest.substr(1, closing - 1);
}

/// Writes one stage. With `insertions` empty it only collects the points: that is how they are known beforehand.
class Assembler {
public:
    Assembler(const ProgramDescription& description, Stage stage, std::span<const ShaderFile> files)
        : description_(description), stage_(stage), files_(files) {}

    StageText run(std::span<const Insertion> insertions) {
        insertions_ = insertions;
        result_.files.emplace_back("<prelude>");
        write_prelude();
        write_file(description_.dialect == Dialect::es100 ? "dialect/es100.glsl" : "dialect/es300.glsl", "the dialect");
        write_file(stage_path(), "the program \"" + description_.name + "\"");
        return std::move(result_);
    }

    [[nodiscard]] const std::vector<std::string>& points() const { return points_; }
    [[nodiscard]] bool has_functions_line() const { return has_functions_line_; }

private:
    [[nodiscard]] const std::string& stage_path() const {
        return stage_ == Stage::vertex ? description_.vertex : description_.fragment;
    }

    void write_prelude() {
        std::string& text = result_.text;
        text += description_.dialect == Dialect::es100 ? "#version 100\n" : "#version 300 es\n";
        const bool full = description_.arithmetic == Arithmetic::full;
        const bool highp = stage_ == Stage::vertex || full;
        const char* precision = highp ? "highp" : "mediump";
        // Positions need more than eleven bits: the vertex stage is highp in every arithmetic.
        text += fmt::format("precision {0} float;\nprecision {0} int;\n", precision);
        if (stage_ == Stage::fragment) {
            // What a texture fetch returns has the precision of its sampler, and samplers are lowp by default.
            text += fmt::format("precision {0} sampler2D;\nprecision {0} samplerCube;\n", precision);
        }
        text += stage_ == Stage::vertex ? "#define STAGE_VERTEX 1\n" : "#define STAGE_FRAGMENT 1\n";
        text += full ? "#define ARITHMETIC_FULL 1\n" : "#define ARITHMETIC_HALF 1\n";
        if (description_.fragment_highp) text += "#define FRAGMENT_HIGHP 1\n";
        if (description_.uniforms_by_vertex) text += "#define UNIFORMS_BY_VERTEX 1\n";
        for (const auto& [name, value] : description_.defines) text += fmt::format("#define {} {}\n", name, value);
    }

    /// The line that follows is `line` of file `file`. ES 1.00 and 3.00 agree on this, in Mesa and in glslang.
    void write_position(std::size_t file, int line) {
        result_.text += fmt::format("#line {} {}\n", static_cast<int>(file) * kLinesPerFile + line, file);
    }

    std::size_t open(std::string path) {
        result_.files.push_back(std::move(path));
        write_position(result_.files.size() - 1, 1);
        return result_.files.size() - 1;
    }

    void write_file(const std::string& path, const std::string& wanted_by) {
        const auto circle = std::find(stack_.begin(), stack_.end(), path);
        expect(circle == stack_.end(), [&] {
            std::string story;
            for (auto one = circle; one != stack_.end(); ++one) story += *one + " -> ";
            return "shader files include each other in a circle: " + story + path;
        });
        if (std::find(written_.begin(), written_.end(), path) != written_.end()) return;
        const ShaderFile* file = find_in(files_, path);
        if (file == nullptr) {
            throw Error(Fault::input,
                        "there is no shader file \"" + path + "\", which " + wanted_by +
                            " asks for: paths are relative to shaders_es and listed in its CMakeLists.txt");
        }
        written_.push_back(path);
        stack_.push_back(path);
        write_lines(file->text, open(path), path);
        stack_.pop_back();
    }

    void write_lines(std::string_view text, std::size_t index, const std::string& path) {
        int open_conditions = 0;
        // Something was put between the lines of a condition: if that branch is skipped, so are the #line directives in
        // it, and the count has to be set right behind it.
        bool unsure = false;
        for_each_line(text, [&](std::string_view whole_line, int number) {
            expect(number < kLinesPerFile, "a shader file has more lines than the #line directives can tell apart");
            const std::string_view line = trimmed(whole_line);
            const bool ends_branch =
                line.starts_with("#endif") || line.starts_with("#else") || line.starts_with("#elif");
            if (line.starts_with("#if")) ++open_conditions;
            if (line.starts_with("#endif")) --open_conditions;
            if (write_replacement(line, number, path)) {
                write_position(index, number + 1);
                unsure = unsure || open_conditions > 0;
                return;
            }
            result_.text += whole_line;
            result_.text += '\n';
            if (ends_branch && unsure) {
                write_position(index, number + 1);
                unsure = open_conditions > 0;
            }
        });
    }

    /// Writes what stands for an #include or //@insert line; false when the line is neither.
    bool write_replacement(std::string_view line, int number, const std::string& path) {
        if (const auto include = included_path(line)) {
            const std::string place = fmt::format("{}:{}", path, number);
            if (include->empty()) throw Error(Fault::input, place + ": an include is written #include \"folder/file\"");
            write_file(std::string(*include), place);
            return true;
        }
        if (line == kInsertFunctionsWord) {
            has_functions_line_ = true;
            for (const Insertion& insertion : insertions_) {
                if (insertion.file != nullptr)
                    write_file(insertion.file, fmt::format("an insertion at {}", insertion.point));
            }
            return true;
        }
        if (!line.starts_with(kInsertWord)) return false;
        const std::string_view point = trimmed(line.substr(kInsertWord.size()));
        if (std::find(points_.begin(), points_.end(), point) == points_.end()) points_.emplace_back(point);
        for (const Insertion& insertion : insertions_) {
            if (point == insertion.point) write_insertion(insertion);
        }
        return true;
    }

    void write_insertion(const Insertion& insertion) {
        const std::string from = insertion.file != nullptr ? insertion.file : "code without a file";
        result_.text += fmt::format("// inserted at {}: {}\n", insertion.point, from);
        open(fmt::format("<insertion at {}: {}>", insertion.point, from));
        result_.text += insertion.code;
        result_.text += '\n';
    }

    const ProgramDescription& description_;
    Stage stage_;
    std::span<const ShaderFile> files_;
    std::span<const Insertion> insertions_;
    StageText result_;
    std::vector<std::string> written_;
    std::vector<std::string> stack_;
    std::vector<std::string> points_;
    bool has_functions_line_ = false;
};

bool contains(const std::vector<std::string>& points, const char* point) {
    return std::find(points.begin(), points.end(), point) != points.end();
}

/// The insertions whose point is in this stage.
std::vector<Insertion> insertions_of(const ProgramDescription& description, Stage stage,
                                     std::span<const ShaderFile> files) {
    if (description.insertions.empty()) return {};
    const Stage other_stage = stage == Stage::vertex ? Stage::fragment : Stage::vertex;
    Assembler scan(description, stage, files);
    Assembler other_scan(description, other_stage, files);
    static_cast<void>(scan.run({}));
    static_cast<void>(other_scan.run({}));
    std::vector<Insertion> here;
    for (const Insertion& insertion : description.insertions) {
        const bool in_this_stage = contains(scan.points(), insertion.point);
        expect(in_this_stage || contains(other_scan.points(), insertion.point), [&] {
            std::string all;
            for (const auto* points : {&scan.points(), &other_scan.points()}) {
                for (const std::string& point : *points) all += " " + point;
            }
            return fmt::format("program \"{}\" has no insertion point \"{}\"; it has:{}", description.name,
                               insertion.point, all.empty() ? " none" : all);
        });
        expect(!in_this_stage || insertion.file == nullptr || scan.has_functions_line(), [&] {
            return fmt::format(
                "program \"{}\" needs a line //@insert_functions in the stage of the point \"{}\", for {}",
                description.name, insertion.point, insertion.file);
        });
        if (in_this_stage) here.push_back(insertion);
    }
    return here;
}

/// A position at the start of a line of a log: "0:12" or "0(12)", perhaps behind "ERROR: " or "WARNING: ".
struct Position {
    std::size_t begin;  ///< of the source string number
    std::size_t end;    ///< behind the line number (and its bracket)
    long line;
};

std::optional<Position> position_in(std::string_view line) {
    std::size_t at = 0;
    for (const std::string_view word : {std::string_view("ERROR: "), std::string_view("WARNING: ")}) {
        if (line.starts_with(word)) at = word.size();
    }
    const auto digits_end = [&](std::size_t from) {
        while (from < line.size() && std::isdigit(static_cast<unsigned char>(line[from])) != 0) ++from;
        return from;
    };
    const std::size_t source_end = digits_end(at);
    if (source_end == at || source_end >= line.size()) return std::nullopt;
    const char separator = line[source_end];
    if (separator != ':' && separator != '(') return std::nullopt;
    const std::size_t number_end = digits_end(source_end + 1);
    const std::size_t digits = number_end - source_end - 1;
    constexpr std::size_t kMostDigits = 9;  // fits a long everywhere
    if (digits == 0 || digits > kMostDigits) return std::nullopt;
    const bool closed = separator == '(' && number_end < line.size() && line[number_end] == ')';
    if (separator == '(' && !closed) return std::nullopt;
    const long value = std::stol(std::string(line.substr(source_end + 1, digits)));
    return Position{at, number_end + (closed ? 1 : 0), value};
}

}  // namespace

const ShaderFile* find_shader_file(std::string_view path) { return find_in(shader_files(), path); }

StageText assemble_stage(const ProgramDescription& description, Stage stage, std::span<const ShaderFile> files) {
    expect(description.fragment_highp || description.arithmetic == Arithmetic::half, [&] {
        return "program \"" + description.name + "\" asks for full arithmetic on a device without fragment highp";
    });
    const std::vector<Insertion> insertions = insertions_of(description, stage, files);
    StageText text = Assembler(description, stage, files).run(insertions);
    if (stage == Stage::vertex && description.uniforms_by_vertex)
        hand_on_uniforms(text, assemble_stage(description, Stage::fragment, files), description.dialect);
    return text;
}

std::string translate_log(std::string_view log, const StageText& stage) {
    std::string out;
    for_each_line(log, [&](std::string_view line, int) {
        const auto position = position_in(line);
        const std::size_t file =
            position ? static_cast<std::size_t>(position->line / kLinesPerFile) : stage.files.size();
        if (file < stage.files.size()) {
            out += line.substr(0, position->begin);
            out += fmt::format("{}:{}", stage.files[file], position->line % kLinesPerFile);
            out += line.substr(position->end);
        } else {
            out += line;
        }
        out += '\n';
    });
    return out;
}

}  // namespace halfframe::gl
