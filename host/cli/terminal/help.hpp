// SPDX-License-Identifier: GPL-3.0-or-later
/// \file help.hpp  Formats the text that `--help` prints: lines of a terminal's width, choices and defaults in readable
/// form, and examples.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace macadam {

/// CLI11's help with wrapped lines: each option with its values, its description and, in brackets, its default.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option(const CLI::Option* option, bool positional) const override;
  std::string make_subcommand(const CLI::App* command) const override;
  std::string make_group(std::string group, bool positional, std::vector<const CLI::Option*> options) const override;
  std::string make_subcommands(const CLI::App* command, CLI::AppFormatMode mode) const override;
  std::string make_usage(const CLI::App* command, std::string name) const override;
};

/// Adds example lines for a shell, to be run from the top of the source tree.
void add_examples(CLI::App& command, const std::vector<std::string>& lines);

/// Returns the example lines of a command. Other text below the command's help is left out.
std::vector<std::string> examples_of(const CLI::App& command);

/// Returns what an option takes: "FILE", "FOLDER", "INT", "auto|cuda|cpu"; empty for a flag.
std::string value_of(const CLI::Option& option);
/// Returns the description of an option, with its default and the options that it excludes.
std::string description_of(const CLI::Option& option);

}  // namespace macadam
