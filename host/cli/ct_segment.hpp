// SPDX-License-Identifier: GPL-3.0-or-later
/// \file ct_segment.hpp  macadam ct segment: grains and phases from a scan.
#pragma once

#include <CLI/CLI.hpp>

namespace macadam {

/// Adds `segment` to `ct`.
void add_ct_segment(CLI::App& ct);

}  // namespace macadam
