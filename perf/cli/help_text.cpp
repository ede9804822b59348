// How --help is laid out.
#include "perf/cli/help_text.h"

#include "perf/report/text_table.h"

namespace halfframe::cli {
namespace {

constexpr std::size_t kColumn = 32;
constexpr std::size_t kLineWidth = 112;

std::string entry(const std::string& names, const std::string& words) {
    std::string text = "  " + names;
    // Names that reach into the words' column get a line of their own.
    text += text.size() + 2 > kColumn ? "\n" + std::string(kColumn, ' ') : std::string(kColumn - text.size(), ' ');
    std::string body = perf::wrapped(words, kLineWidth - kColumn, 0);
    for (std::size_t at = body.find('\n'); at != std::string::npos; at = body.find('\n', at + 1)) {
        body.insert(at + 1, kColumn, ' ');
    }
    return text + body + "\n";
}

}  // namespace

std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const {
    std::string names = option->get_name(is_positional, !is_positional);
    if (!is_positional && !option->get_type_name().empty()) {
        names += " " + option->get_type_name();
    }
    std::string words = option->get_description();
    if (!option->get_default_str().empty()) {
        words += ". Default: " + option->get_default_str();
    }
    return entry(names, words);
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
    return entry(command->get_name(), command->get_description());
}

}  // namespace halfframe::cli
