// The halfframe command: chooses a subcommand, and turns every kind of failure into a sentence and an exit code.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "engine/error.h"
#include "perf/cli/command.h"
#include "perf/cli/help_text.h"
#include "perf/cli/spelling.h"
#include "perf/cli/terminal.h"
#include "platform/context.h"

namespace halfframe::cli {
namespace {

constexpr int kInterrupted = 130;  // 128 + SIGINT, as shells count

int fail(int code, const std::string& sentence) {
    complain("halfframe: " + sentence + "\n");
    return code;
}

std::vector<std::string> option_names(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& long_name : option->get_lnames()) {
            names.push_back("--" + long_name);
        }
        for (const std::string& short_name : option->get_snames()) {
            names.push_back("-" + short_name);
        }
    }
    return names;
}

/// A word that no option and no argument took: says which one was probably meant.
[[noreturn]] void refuse(const std::string& word, const CLI::App& app, const CLI::App* command) {
    const std::string of = command != nullptr ? command->get_name() : "";
    if (word.starts_with('-')) {
        const std::string bare = word.substr(0, word.find('='));
        throw Error(Fault::usage,
                    fmt::format("{}; see halfframe {}{}--help",
                                unknown("option", bare, option_names(command != nullptr ? *command : app)), of,
                                of.empty() ? "" : " "));
    }
    if (command != nullptr) {
        throw Error(Fault::usage, fmt::format("'{}' is one argument too many for halfframe {}; see --help", word, of));
    }
    std::vector<std::string> names;
    for (const CLI::App* subcommand : app.get_subcommands([](const CLI::App*) { return true; })) {
        names.push_back(subcommand->get_name());
    }
    throw Error(Fault::usage, unknown("command", word, names) + "; see halfframe --help");
}

void refuse_leftovers(const CLI::App& app) {
    const auto chosen = app.get_subcommands();
    const CLI::App* command = chosen.empty() ? nullptr : chosen.front();
    std::vector<std::string> words = app.remaining(true);
    // An option that does not exist explains a stray word beside it, which may be its value.
    std::stable_partition(words.begin(), words.end(), [](const std::string& word) { return word.starts_with('-'); });
    if (!words.empty()) {
        refuse(words.front(), app, command);
    }
}

int run(int argument_count, char** arguments) {
    CLI::App app(
        "halfframe: a renderer for console- and mobile-class budgets. Draws without a window, and says what each "
        "pass costs.",
        "halfframe");
    app.formatter(std::make_shared<HelpFormatter>());  // CLI11 wants to share it
    app.set_version_flag("--version", "halfframe " HALFFRAME_VERSION, "Print the version and stop");
    app.footer(kExitCodes);
    app.allow_extras();
    std::vector<std::unique_ptr<Command>> commands;
    for (const auto make : {make_render_command, make_report_command, make_plan_command, make_info_command,
                            make_effects_command, make_scenes_command, make_export_command, make_bake_wet_command,
                            make_surface_at_command, make_accuracy_command,
                            make_stability_command, make_contact_sheet_command, make_check_command, make_cost_command}) {
        commands.push_back(make(app));
        app.get_subcommand(commands.back()->name())->allow_extras();
    }
    try {
        app.parse(argument_count, arguments);
    } catch (const CLI::Success& done) {  // --help and --version
        const int code = app.exit(done);
        expect_output_written();
        return code;
    } catch (const CLI::ParseError& error) {
        refuse_leftovers(app);
        throw Error(Fault::usage, std::string(error.what()) + "; see --help");
    }
    refuse_leftovers(app);
    for (const auto& command : commands) {
        if (app.got_subcommand(command->name())) {
            const int code = command->run();
            expect_output_written();
            return code;
        }
    }
    complain(app.help());
    return fail(static_cast<int>(Fault::usage), "no command was given");
}

}  // namespace
}  // namespace halfframe::cli

int main(int argument_count, char** arguments) {
    using namespace halfframe;
    cli::catch_signals();
    try {
        return cli::run(argument_count, arguments);
    } catch (const cli::Interrupted&) {
        return cli::fail(cli::kInterrupted, "interrupted");
    } catch (const Error& error) {
        return cli::fail(error.exit_code(), error.what());
    } catch (const MaskedUse& refused) {
        return cli::fail(static_cast<int>(Fault::check), refused.what());
    } catch (const platform::ContextError& error) {
        return cli::fail(static_cast<int>(Fault::context), error.what());
    } catch (const std::bad_alloc&) {
        return cli::fail(static_cast<int>(Fault::environment), "out of memory; try a smaller --size or scene");
    } catch (const std::filesystem::filesystem_error& error) {
        return cli::fail(static_cast<int>(Fault::environment), error.what());
    } catch (const std::exception& error) {
        return cli::fail(static_cast<int>(Fault::check), fmt::format("internal error: {}", error.what()));
    }
}
