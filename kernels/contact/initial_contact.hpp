// SPDX-License-Identifier: GPL-3.0-or-later
/// \file initial_contact.hpp  Returns frame, area moments and relative displacements of a contact of the network in the
/// initial geometry, on the host in double precision.
#pragma once

#include <array>

#include "kernels/contact/contact_kinematics.hpp"
#include "macadam/contact_network.hpp"

namespace macadam::kernels {

/// Returns the frame and the lever arms of a contact.
inline Placement<double> initial_placement(const Contact& c) { return {c.n, c.s, c.t, c.arm_a, c.arm_b}; }

/// Computes the area moments divided by the length of the contact [m] [m²] [m³], in the order of condensed_load().
inline void moments_over_length(const Contact& c, double (&out)[6]) {
  const AreaMoments& m = c.moments;
  const double moments[6] = {m.a, m.s, m.t, m.ss, m.st, m.tt};
  for (int k = 0; k < 6; ++k) out[k] = moments[k] / c.length;
}

/// Returns the six relative displacements of a contact whose ends move by `a` and `b`, see relative_rates().
inline std::array<double, 6> relative_displacements(const Contact& c, const Twist<double>& a, const Twist<double>& b) {
  double u[6];
  relative_rates(initial_placement(c), a, b, u);
  return {u[0], u[1], u[2], u[3], u[4], u[5]};
}

}  // namespace macadam::kernels
