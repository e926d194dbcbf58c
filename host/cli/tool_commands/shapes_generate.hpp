// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shapes_generate.hpp  `macadam shapes generate`: generates a library of shapes.
#pragma once

#include <CLI/CLI.hpp>

namespace macadam {

/// Adds the command `generate` to `shapes`. The command runs while the command line is parsed, so its errors are thrown
/// from there.
void add_shapes_generate(CLI::App& shapes);

}  // namespace macadam
