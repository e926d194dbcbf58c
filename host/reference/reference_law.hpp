// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reference_law.hpp  The contact law written a second time, for reading: one chain at one contact point.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "macadam/laws/all.hpp"

namespace macadam::reference {

/// A spring and a dashpot side by side; both take the whole force and stretch alike.
struct KelvinUnit {
  double E = 0;  ///< spring [Pa]
  double C = 0;  ///< dashpot [Pa·s]
};

/// One displacement component of one contact point.
struct ChainState {
  double force = 0;             ///< [N], positive in tension
  std::vector<double> stretch;  ///< x_l of the Kelvin units [m], or what a law of its own keeps
};

/// What a law that is no chain does in a step: of a point's share A_J of the area [m²] at the contact's distance d [m],
/// which opens and slips by dx along n, ŝ and t̂ [m].
using PointLaw = std::function<void(double area, double distance, double dt, const std::array<double, 3>& dx,
                                    ChainState (&chain)[3])>;

/// A spring, a dashpot and any number of Kelvin units in series. Without units and with C_m = ∞ it is a plain spring.
struct ReferenceLaw {
  double E_m = 0;                                        ///< [Pa]
  double C_m = std::numeric_limits<double>::infinity();  ///< [Pa·s]
  std::vector<KelvinUnit> units;
  double alpha = 0;  ///< shear over normal stiffness
  PointLaw point;    ///< in place of the chains, where it is there; E_m is then the stiffness at the start
  int kept = 0;      ///< numbers that it keeps in each component's `stretch`
  std::function<Break(const ChainState (&chain)[3])> break_of = {};  ///< how a point broke; none: it cannot break

  std::size_t states() const { return point ? static_cast<std::size_t>(kept) : units.size(); }
};

/// The law, read from its parameters. `pair` names the pair type in messages.
/// \throws InputError when a modulus is negative or not a number, or springs and dashpots differ in number.
ReferenceLaw make_reference_law(const Law& law, const std::string& pair);

/// Takes one step Δt while the ends of the chain move apart by dx [m]. `scale` is A_J/d [m], times α for shear: the
/// stiffnesses are k = E·scale, the viscosities η = C·scale (Eq. 11, 12, 16, 17). It must not be 0.
void advance_chain(const ReferenceLaw& law, double scale, double dt, double dx, ChainState& state);

}  // namespace macadam::reference
