// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reference_contact.hpp  Computes the geometry of one contact in the reference implementation: its normal, the
/// frame that follows the particles, and its contact points (Eq. 5–7).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "host/reference/reference_law.hpp"
#include "macadam/contact_network.hpp"

namespace macadam::reference {

using Eigen::Vector3d;

/// Returns the vector in Eigen's type.
inline Vector3d to_eigen(const Vec3d& v) { return {v.x, v.y, v.z}; }

/// One contact point: its position in the facet's frame, its part of the area, and its three chains, along n, ŝ and t̂.
struct ContactPoint {
  double s = 0, t = 0;  ///< [m]
  double area = 0;      ///< A_J [m²]
  ChainState chain[3];
};

/// Position of a facet between its two particles: x0 = x_A + arm_a·n = x_B − arm_b·n [m], and its unit frame (n, s, t)
/// with s × t = n.
struct ContactFrame {
  Vector3d n, s, t;
  double arm_a = 0, arm_b = 0;

  /// Returns x_J − x_A of a contact point [m].
  Vector3d lever_a(const ContactPoint& p) const { return arm_a * n + p.s * s + p.t * t; }

  /// Returns x_J − x_B of a contact point [m]. It is not needed at a wall, because walls do not rotate.
  Vector3d lever_b(const ContactPoint& p) const { return -arm_b * n + p.s * s + p.t * t; }
};

/// Returns the frame half-way between two frames; relative velocities are taken in it. If they were taken in the frame
/// at the beginning or at the end of the step, a rigid turn by θ would wrongly open the contact by (1 − cos θ)·d in
/// every step.
ContactFrame middle_of(const ContactFrame& before, const ContactFrame& after);

/// One contact with its points. Its stiffness is always computed from its length and its initial areas; only the frame
/// and the lever arms follow the particles.
struct ReferenceContact {
  std::int32_t a = 0, b = 0;  ///< particle numbers; b may be a Wall
  PairType pair{};
  double length = 0;            ///< length of the law's material [m]
  double series = 0;            ///< compliance of the rock in series [1/Pa]
  double initial_distance = 0;  ///< of the two centres, or of the centre and the wall [m]
  double initial_arm_a = 0;     ///< from A's centre to x0 [m]
  ContactFrame frame;           ///< at the whole step; forces act in this frame
  ContactFrame middle;          ///< half a step earlier; velocities are taken in this frame
  std::vector<ContactPoint> points;

  bool at_wall() const { return b < 0; }

  /// Moves the frame to two particles with x_b − x_a = `centres`, which turned by `mean_turn` = ½(ω_A + ω_B)·Δt during
  /// the step.
  void follow_pair(const Vector3d& centres, const Vector3d& mean_turn);

  /// Moves the frame to a particle whose centre is now at `distance` from its wall. The normal of the wall does not
  /// change. The wall does not spin, so `mean_turn` is ½·ω_A·Δt.
  void follow_wall(double distance, const Vector3d& mean_turn);

 private:
  /// Turns the frame about its normal by the component of `mean_turn` along the normal.
  void spin_frame(const Vector3d& mean_turn);
};

/// Returns one contact of a network with its points, at rest. `units` is the number of values that each chain keeps in
/// its `stretch`.
ReferenceContact make_reference_contact(const ContactNetwork& network, const Contact& contact, std::size_t units);

}  // namespace macadam::reference
