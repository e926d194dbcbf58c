// SPDX-License-Identifier: GPL-3.0-or-later
/// \file fit_command.hpp  macadam fit: finds contact laws from measured moduli.
#pragma once

#include <CLI/CLI.hpp>

namespace macadam {

/// Adds `fit` to the program.
void add_fit_command(CLI::App& app);

}  // namespace macadam
