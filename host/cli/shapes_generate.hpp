// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shapes_generate.hpp  `macadam shapes generate`.
#pragma once

#include <CLI/CLI.hpp>

namespace macadam {

/// Adds the command; it runs by its callback. \throws InputError, RunError from there.
void add_shapes_generate(CLI::App& shapes);

}  // namespace macadam
