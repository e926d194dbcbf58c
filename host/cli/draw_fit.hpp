// SPDX-License-Identifier: GPL-3.0-or-later
/// \file draw_fit.hpp  The pictures of a fit, drawn by a script that comes with the program.
#pragma once

#include <filesystem>
#include <string>

namespace macadam {

/// Draws the pictures into a folder that has fit.csv and curve.csv, where python3 with matplotlib is there. What is to
/// be told of it: the files' names, or how to draw them.
std::string draw_fit(const std::filesystem::path& folder);

}  // namespace macadam
