// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shapes_fill.hpp  `macadam shapes fill`: fills one shape with spheres.
#pragma once

#include <CLI/CLI.hpp>

namespace macadam {

/// Adds the command `fill` to `shapes`. The command runs while the command line is parsed.
void add_shapes_fill(CLI::App& shapes);

}  // namespace macadam
