// SPDX-License-Identifier: GPL-3.0-or-later
/// \file ct_modulus.hpp  macadam ct modulus: computes the modulus of a segmented scan without separating its grains.
#pragma once

#include <CLI/CLI.hpp>

namespace macadam {

/// Adds `modulus` to `ct`.
void add_ct_modulus(CLI::App& ct);

}  // namespace macadam
