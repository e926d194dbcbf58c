// SPDX-License-Identifier: GPL-3.0-or-later
/// \file turning_rollers.hpp  Lets the rollers of a bending test turn with the specimen.
#pragma once

#include "macadam/contact_network.hpp"

namespace macadam {

/// Moves the points of all contacts with a turning roller along x to the middle of the roller. The roller then touches
/// the specimen along a line: it bears a force, but it does not resist a rotation of the specimen about this line.
/// Areas and positions along y remain. Does nothing if the domain has no turning rollers (domains::Rollers::turn).
void let_rollers_turn(const Specimen& specimen, ContactNetwork& network);

}  // namespace macadam
