// SPDX-License-Identifier: GPL-3.0-or-later
/// \file ct_segment.hpp  macadam ct segment: finds grains and phases in a scan.
#pragma once

#include <CLI/CLI.hpp>

namespace macadam {

/// Adds `segment` to `ct`.
void add_ct_segment(CLI::App& ct);

}  // namespace macadam
