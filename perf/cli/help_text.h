// How --help is laid out: names in one column, words in another, lines no longer than a terminal.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace halfframe::cli {

class HelpFormatter : public CLI::Formatter {
public:
    /// One option: its names and kind of value, then what it does and its default, wrapped beside or below.
    std::string make_option(const CLI::Option* option, bool is_positional) const override;
    /// One subcommand in the list of them.
    std::string make_subcommand(const CLI::App* command) const override;
};

}  // namespace halfframe::cli
