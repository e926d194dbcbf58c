// SPDX-License-Identifier: GPL-3.0-or-later
/// \file new_command.hpp  macadam new: a scene to begin with.
#pragma once

#include <CLI/CLI.hpp>

namespace macadam {

void add_new_command(CLI::App& app);

}  // namespace macadam
