// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reference_contact.hpp  The geometry of one contact in time: normal, carried frame, contact points (Eq. 5–7).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "host/reference/reference_law.hpp"
#include "macadam/contact_network.hpp"

namespace macadam::reference {

using Eigen::Vector3d;

/// The same vector in Eigen's type.
inline Vector3d to_eigen(const Vec3d& v) { return {v.x, v.y, v.z}; }

/// One contact point: where it lies in the facet's frame, its share of the area, and its three chains along n, ŝ, t̂.
struct ContactPoint {
  double s = 0, t = 0;  ///< [m]
  double area = 0;      ///< A_J [m²]
  ChainState chain[3];
};

/// Where a facet lies between its two particles: x0 = x_A + arm_a·n = x_B − arm_b·n [m], s × t = n.
struct ContactFrame {
  Vector3d n, s, t;
  double arm_a = 0, arm_b = 0;

  /// x_J − x_A of a contact point [m].
  Vector3d lever_a(const ContactPoint& p) const { return arm_a * n + p.s * s + p.t * t; }

  /// x_J − x_B of a contact point [m]. At a wall it is never needed: walls do not rotate.
  Vector3d lever_b(const ContactPoint& p) const { return -arm_b * n + p.s * s + p.t * t; }
};

/// The frame half-way between two: relative velocities are taken in it. With the frame at either end of the step, a
/// rigid turn by θ would open the contact by (1 − cos θ)·d every step.
ContactFrame middle_of(const ContactFrame& before, const ContactFrame& after);

/// One contact with its points. Stiffness keeps the initial distance and areas for all time; only the frame and the
/// lever arms follow the particles.
struct ReferenceContact {
  std::int32_t a = 0, b = 0;  ///< particle numbers; b may be a Wall
  PairType pair{};
  double initial_distance = 0;  ///< [m]
  double initial_arm_a = 0;     ///< from A's centre to x0 [m]
  ContactFrame frame;           ///< at the whole step: forces act in it
  ContactFrame middle;          ///< half a step earlier: velocities are seen in it
  std::vector<ContactPoint> points;

  bool at_wall() const { return b < 0; }

  /// Follows two particles whose centres are now x_b − x_a apart and which turned by `mean_turn` = ½(ω_A + ω_B)·Δt
  /// during the step.
  void follow_pair(const Vector3d& centres, const Vector3d& mean_turn);

  /// Follows a particle whose centre is now `distance` away from its wall. The normal stays the wall's; the wall does
  /// not spin, so `mean_turn` = ½·ω_A·Δt.
  void follow_wall(double distance, const Vector3d& mean_turn);

 private:
  void spin_frame(const Vector3d& mean_turn);
};

/// A contact of a network with its points, at rest.
ReferenceContact make_reference_contact(const ContactNetwork& network, const Contact& contact, std::size_t units);

}  // namespace macadam::reference
