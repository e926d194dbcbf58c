// SPDX-License-Identifier: GPL-3.0-or-later
/// \file ct_phantom.hpp  macadam ct phantom: makes a synthetic scan together with its ground truth.
#pragma once

#include <CLI/CLI.hpp>

namespace macadam {

/// Adds `phantom` to `ct`.
void add_ct_phantom(CLI::App& ct);

}  // namespace macadam
