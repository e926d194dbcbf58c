// SPDX-License-Identifier: GPL-3.0-or-later
/// \file void_cells.hpp  Turns weights of voids, which may be negative, into radii.
#pragma once

#include <span>

#include "macadam/specimen.hpp"

namespace macadam {

/// Returns a specimen whose squared radii are the weights of a diagram: R² of the particles and the given weights of
/// the voids [m²], or R² of the voids without weights. If a weight is negative, all weights are raised by the same
/// number, which does not change the diagram.
Specimen with_void_weights(const Specimen& specimen, std::span<const double> weights);

}  // namespace macadam
