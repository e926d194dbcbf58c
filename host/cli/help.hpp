// SPDX-License-Identifier: GPL-3.0-or-later
/// \file help.hpp  What `--help` prints: lines of a terminal's width, choices and defaults as people write them,
/// examples.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace macadam {

/// CLI11's help, wrapped: each option with its values, what it is, and in brackets its default.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option(const CLI::Option* option, bool positional) const override;
  std::string make_subcommand(const CLI::App* command) const override;
  std::string make_group(std::string group, bool positional, std::vector<const CLI::Option*> options) const override;
  std::string make_subcommands(const CLI::App* command, CLI::AppFormatMode mode) const override;
  std::string make_usage(const CLI::App* command, std::string name) const override;
};

/// Lines for a shell, from the top of the source tree, that show what a command is for.
void add_examples(CLI::App& command, const std::vector<std::string>& lines);

/// The lines again. Text that is no example is not among them.
std::vector<std::string> examples_of(const CLI::App& command);

/// What an option takes: "FILE", "FOLDER", "INT", "auto|cuda|cpu"; empty: it is a flag.
std::string value_of(const CLI::Option& option);
/// What it is, with its default and what it cannot stand beside.
std::string words_of(const CLI::Option& option);

}  // namespace macadam
