// SPDX-License-Identifier: GPL-3.0-or-later
/// \file draw_results.hpp  Draws pictures of results with a script that comes with the program.
#pragma once

#include <filesystem>
#include <string>

namespace macadam {

/// Runs a script that draws its pictures into the folder of the results, with python_interpreter() or Debian's python3.
/// Returns a line for the user: the names of the pictures (`pictures`) or, if no Python has matplotlib, instructions
/// for drawing them.
std::string draw_results(const std::string& script, const std::filesystem::path& folder, const std::string& pictures);

}  // namespace macadam
