// SPDX-License-Identifier: GPL-3.0-or-later
/// \file programs.hpp  Other programs that this one starts.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace macadam {

/// This program's own file; empty where the system does not say it.
std::filesystem::path own_program();

/// The source tree, where this program lies in the folder that it was built in; empty: it was installed. No folder of
/// the machine that built it is in its bytes: they depend on the sources alone, and nobody runs what lies there on
/// theirs.
std::filesystem::path source_tree();

/// The Python that scripts and the package run with: MACADAM_PYTHON of the environment, that of the source tree
/// (scripts/python), or python3 of the search path.
std::string python_interpreter();

/// Runs a program of the search path, or of a path, with its output thrown away. Whether it ended with 0.
bool runs(std::vector<std::string> words);

/// Becomes a program. Returns only where that could not be: why not.
std::string become(std::vector<std::string> words);

}  // namespace macadam
