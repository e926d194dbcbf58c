// SPDX-License-Identifier: GPL-3.0-or-later
/// \file ct_command.hpp  macadam ct: works with images of computed tomography.
#pragma once

#include <CLI/CLI.hpp>

namespace macadam {

/// Adds `ct` to the program.
void add_ct_command(CLI::App& app);

}  // namespace macadam
