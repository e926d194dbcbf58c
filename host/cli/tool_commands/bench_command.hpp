// SPDX-License-Identifier: GPL-3.0-or-later
/// \file bench_command.hpp  macadam bench: measures how fast steps and iterations are on this machine.
#pragma once

#include <CLI/CLI.hpp>

namespace macadam {

/// Adds the command `bench` to the program. The command runs while the command line is parsed.
void add_bench_command(CLI::App& app);

}  // namespace macadam
