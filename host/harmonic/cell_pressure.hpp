// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cell_pressure.hpp  Computes the pressures of cells and their effect on contacts, for networks with the rule
/// "volumetric" (docs/model/contacts.md, section 26).
///
/// The energy of a cell is ½·q·T². T is the sum of F·(x_f − x) over the contacts of the particle, where F is the force
/// of the contact's springs on the particle, x_f the centroid of the facet and x the centre of the particle. q is
/// CellStiffness::weight over the modulus of the phase. Since F is linear in the relative displacement of the contact,
/// the pressure P = q·T acts on the contact like an additional relative displacement of the whole facet, P_a·(x_f −
/// x_a) − P_b·(x_f − x_b). P is a strain: the pressure of the cell over 2μ.
#pragma once

#include <array>

#include "host/harmonic/contact_operator.hpp"

namespace macadam::harmonic {

/// Centroid of a facet with respect to the centre of one of its two particles, along n, s and t of the contact [m].
struct CentroidLever {
  double n, s, t;
};

/// Returns the centroid of the contact's facet as seen from its first or its second end.
CentroidLever centroid_lever(const Contact& contact, bool first_end);

/// Returns P of every particle if the particles move by `motion` and the walls by `wall`. Returns an empty vector if
/// cells do not resist changes of volume.
Vector cell_pressures(const ContactNetwork& network, const PairStiffness& stiffness, const Vector& motion,
                      const WallMotion& wall);

/// Returns the additional relative displacement of a contact along n, s and t [m], in the order of the relative
/// displacements 0, 3 and 4. `pressures` is the result of cell_pressures(); if it is empty, the result is zero.
std::array<Complex, 3> pressure_shift(const Contact& contact, const Vector& pressures);

/// Adds the additional displacement of a contact to its relative displacements. Changes nothing if `pressures` is
/// empty.
void add_pressure_shift(const Contact& contact, const Vector& pressures, std::array<Complex, 6>& u);

}  // namespace macadam::harmonic
