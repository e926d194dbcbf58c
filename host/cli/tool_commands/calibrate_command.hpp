// SPDX-License-Identifier: GPL-3.0-or-later
/// \file calibrate_command.hpp  macadam calibrate: finds parameters of a scene from measured moduli of the mixture.
#pragma once

#include <CLI/CLI.hpp>

namespace macadam {

/// Adds `calibrate` to the program.
void add_calibrate_command(CLI::App& app);

}  // namespace macadam
