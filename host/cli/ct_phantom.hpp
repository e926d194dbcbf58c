// SPDX-License-Identifier: GPL-3.0-or-later
/// \file ct_phantom.hpp  macadam ct phantom: a synthetic scan with its truth.
#pragma once

#include <CLI/CLI.hpp>

namespace macadam {

void add_ct_phantom(CLI::App& ct);

}  // namespace macadam
