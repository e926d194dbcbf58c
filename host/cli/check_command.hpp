// SPDX-License-Identifier: GPL-3.0-or-later
/// \file check_command.hpp  macadam check: what a run would be.
#pragma once

#include <CLI/CLI.hpp>

namespace macadam {

void add_check_command(CLI::App& app);

}  // namespace macadam
