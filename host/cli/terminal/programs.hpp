// SPDX-License-Identifier: GPL-3.0-or-later
/// \file programs.hpp  Starts other programs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace macadam {

/// Returns the path of this program's file; empty if the system does not report it.
std::filesystem::path own_program();

/// Returns the source tree, if this program is in the folder in which it was built; empty if it was installed. The
/// program itself contains no absolute path of the machine that built it. So the bytes of the program depend on the
/// sources alone, and on another machine it never runs a file that happens to be at such a path.
std::filesystem::path source_tree();

/// Returns the Python that runs scripts and the package: MACADAM_PYTHON of the environment, the Python of the
/// source tree (scripts/python), or python3 of the search path.
std::string python_interpreter();

/// Runs a program, given by its path or found in the search path, and discards its output. Returns whether its exit
/// code was 0.
bool runs(std::vector<std::string> words);

/// Replaces this process by a program. Returns only if that fails, with the reason.
std::string become(std::vector<std::string> words);

}  // namespace macadam
