// SPDX-License-Identifier: GPL-3.0-or-later
/// \file rigid_motions.hpp  Motions of the whole specimen that no wall resists, and pins that hold them without force.
#pragma once

#include <vector>

#include "host/harmonic/stiffness_matrix.hpp"
#include "macadam/specimen.hpp"

namespace macadam::harmonic {

/// Pins on as many degrees of freedom as the specimen has free rigid motions (three between frictionless walls: x, y
/// and yaw), chosen so that they hold nothing else: a load in equilibrium leaves them without force. \throws InputError
/// naming the particles of a cluster that does not touch both walls: nothing says where it is.
std::vector<Pin> pins_of_free_motions(const Specimen& specimen, const ContactNetwork& network,
                                      const PairStiffness& stiffness);

}  // namespace macadam::harmonic
