// SPDX-License-Identifier: GPL-3.0-or-later
/// \file python_package.hpp  Runs commands of the Python package.
#pragma once

#include <string>
#include <vector>

namespace macadam {

/// Replaces this process by a command of the Python package: `python -m macadam COMMAND ARGUMENTS`. \throws InputError
/// if Python does not find the package; RunError if Python cannot be run.
[[noreturn]] void run_python(const std::string& command, const std::vector<std::string>& arguments);

}  // namespace macadam
