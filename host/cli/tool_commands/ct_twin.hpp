// SPDX-License-Identifier: GPL-3.0-or-later
/// \file ct_twin.hpp  macadam ct twin: makes a scene of the specimen in a scan.
#pragma once

#include <CLI/CLI.hpp>

namespace macadam {

/// Adds `twin` to `ct`.
void add_ct_twin(CLI::App& ct);

}  // namespace macadam
