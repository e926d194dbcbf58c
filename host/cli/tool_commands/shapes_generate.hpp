// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shapes_generate.hpp  `macadam shapes generate`: generates a library of shapes.
#pragma once

#include <CLI/CLI.hpp>

namespace macadam {

/// Adds `generate` to the command `shapes`; it runs when the command line is parsed. \throws InputError, RunError then.
void add_shapes_generate(CLI::App& shapes);

}  // namespace macadam
