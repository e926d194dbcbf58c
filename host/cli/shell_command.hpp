// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shell_command.hpp  macadam completion, macadam man: completion scripts and the manual page, made from the
/// command line.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace macadam {

/// Adds the commands `completion` and `man` to `app`. Both describe `app`, which must outlive them.
void add_shell_commands(CLI::App& app);

/// Return scripts that complete commands, options, their choices and files.
/// @{
std::string bash_completion(const CLI::App& app);
std::string zsh_completion(const CLI::App& app);
std::string fish_completion(const CLI::App& app);
/// @}

/// Returns the manual page, for man(1).
std::string manual_page(const CLI::App& app);

}  // namespace macadam
