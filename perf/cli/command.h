// A subcommand of halfframe: registers its options when made, runs when it was chosen.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace halfframe::cli {

class Command {
public:
    Command() = default;
    virtual ~Command() = default;
    Command(const Command&) = delete;
    Command& operator=(const Command&) = delete;
    /// The subcommand's name as typed.
    [[nodiscard]] virtual std::string name() const = 0;
    /// Does the work; returns the exit code. Throws Error, Mistake, platform::ContextError, Interrupted.
    virtual int run() = 0;
};

// One .cpp each. `app` is the parent and outlives the command.
[[nodiscard]] std::unique_ptr<Command> make_render_command(CLI::App& app);
[[nodiscard]] std::unique_ptr<Command> make_report_command(CLI::App& app);
[[nodiscard]] std::unique_ptr<Command> make_plan_command(CLI::App& app);
[[nodiscard]] std::unique_ptr<Command> make_info_command(CLI::App& app);
[[nodiscard]] std::unique_ptr<Command> make_effects_command(CLI::App& app);
[[nodiscard]] std::unique_ptr<Command> make_scenes_command(CLI::App& app);
[[nodiscard]] std::unique_ptr<Command> make_export_command(CLI::App& app);
[[nodiscard]] std::unique_ptr<Command> make_bake_wet_command(CLI::App& app);
[[nodiscard]] std::unique_ptr<Command> make_surface_at_command(CLI::App& app);
[[nodiscard]] std::unique_ptr<Command> make_accuracy_command(CLI::App& app);
[[nodiscard]] std::unique_ptr<Command> make_contact_sheet_command(CLI::App& app);
[[nodiscard]] std::unique_ptr<Command> make_check_command(CLI::App& app);
[[nodiscard]] std::unique_ptr<Command> make_cost_command(CLI::App& app);
[[nodiscard]] std::unique_ptr<Command> make_stability_command(CLI::App& app);

/// Printed under every --help.
inline constexpr const char* kExitCodes =
    "Exit codes: 0 done; 1 a check, budget or gate failed; 2 usage; 3 input file or scene; 4 no usable graphics\n"
    "context; 5 environment (disk full, folder missing or not writable); 130 interrupted.";

}  // namespace halfframe::cli
