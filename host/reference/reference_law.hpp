// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reference_law.hpp  Defines the reference implementation of the contact laws, written to be read: one chain at
/// one contact point.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "macadam/laws/all.hpp"

namespace macadam::reference {

/// A spring and a dashpot in parallel: both have the same stretch, and their forces add up.
struct KelvinUnit {
  double E = 0;  ///< spring [Pa]
  double C = 0;  ///< dashpot [Pa·s]
};

/// State of one displacement component of one contact point.
struct ChainState {
  double force = 0;             ///< [N], positive in tension
  std::vector<double> stretch;  ///< x_l of the Kelvin units [m], or the numbers that a PointLaw keeps
};

/// A function that advances a law that is not a chain by one step, at one contact point. `area` is the point's part A_J
/// of the contact's area [m²], `length` is Contact::length [m], and `dx` contains the opening and the two slips
/// during the step, along n, ŝ and t̂ [m].
using PointLaw =
    std::function<void(double area, double length, double dt, const std::array<double, 3>& dx, ChainState (&chain)[3])>;

/// A spring, a dashpot and any number of Kelvin units in series. Without units and with C_m = ∞ the law is a spring.
struct ReferenceLaw {
  double E_m = 0;                                        ///< [Pa]
  double C_m = std::numeric_limits<double>::infinity();  ///< [Pa·s]
  std::vector<KelvinUnit> units;
  double alpha = 0;  ///< shear over normal stiffness
  PointLaw point;    ///< if set, it is used in place of the chains; E_m is then the initial modulus
  int kept = 0;      ///< how many numbers `point` keeps in each component's `stretch`
  /// Returns how a point broke; this member is empty if the law cannot break.
  std::function<Break(const ChainState (&chain)[3])> break_of = {};
  /// Returns the crack of a point; this member is empty if the law has no crack.
  std::function<laws::PointCrack(const ChainState (&chain)[3])> crack_of = {};

  /// Returns how many numbers each chain keeps in its `stretch`.
  std::size_t states() const { return point ? static_cast<std::size_t>(kept) : units.size(); }
};

/// Returns the law with given parameters. `pair` is the name of the pair type for messages.
/// \throws InputError when a modulus is negative or not a number, or springs and dashpots differ in number.
ReferenceLaw make_reference_law(const Law& law, const std::string& pair);

/// Takes one step Δt in which the ends of the chain move apart by dx [m]. `scale` is A_J/length [m], times α for shear:
/// stiffnesses are k = E·scale and viscosities η = C·scale (Eq. 11, 12, 16, 17). `scale` must not be 0.
/// `rock` [1/Pa] is the compliance of a spring in series with the chain, whose stiffness is scale/rock. The chain's own
/// Maxwell spring is in series with all its other elements too, so the two springs act as one spring of compliance
/// 1/E_m + rock.
void advance_chain(const ReferenceLaw& law, double scale, double dt, double dx, ChainState& state, double rock = 0);

}  // namespace macadam::reference
