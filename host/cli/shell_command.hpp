// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shell_command.hpp  macadam completion, macadam man: what shells and man know of the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace macadam {

/// Both commands; they describe `app`, which must outlive them.
void add_shell_commands(CLI::App& app);

/// Scripts that complete commands, options, their choices and files.
/// @{
std::string bash_completion(const CLI::App& app);
std::string zsh_completion(const CLI::App& app);
std::string fish_completion(const CLI::App& app);
/// @}

/// The manual page, for man(1).
std::string manual_page(const CLI::App& app);

}  // namespace macadam
