// SPDX-License-Identifier: GPL-3.0-or-later
/// \file ct_twin.hpp  macadam ct twin: the specimen in a scan as a scene.
#pragma once

#include <CLI/CLI.hpp>

namespace macadam {

void add_ct_twin(CLI::App& ct);

}  // namespace macadam
