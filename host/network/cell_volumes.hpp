// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cell_volumes.hpp  Sets the lengths of contacts and the resistance of cells to changes of volume by the rule
/// "volumetric" (docs/model/contacts.md, section 26).
#pragma once

#include "host/network/rock_lengths.hpp"
#include "macadam/contact_network.hpp"

namespace macadam {

/// Elastic constants that the rule "volumetric" needs besides the law of the mastic.
struct PhaseConstants {
  double rock_modulus = 0;  ///< E of the rock [Pa]; may be 0 in a network without aggregates
  double mastic_poisson_ratio = 0, rock_poisson_ratio = 0;
};

/// Sets `length` and `series` of all contacts, and `cells` and `rule` of the network, by the rule "volumetric".
/// `tessellation` is the one from which the network was built.
///
/// \throws InputError naming a Poisson's ratio that is not above -1 and below 0.5.
void apply_volumetric(ContactNetwork& network, const Specimen& specimen, const Tessellation& tessellation,
                      const RockSurfaces& rock, const PhaseConstants& constants);

}  // namespace macadam
