// SPDX-License-Identifier: GPL-3.0-or-later
/// \file contact_operator.hpp  Forces of all contacts for given complex motions: K*(ω) without a matrix.
#pragma once

#include <complex>
#include <vector>

#include "macadam/harmonic.hpp"

namespace macadam::harmonic {

using Complex = std::complex<double>;
using Vector = std::vector<Complex>;  ///< six numbers a particle: ux uy uz θx θy θz

/// Complex stiffness per unit of area over distance, and α, of each pair type.
struct PairStiffness {
  std::array<Complex, pair_types> k{};
  std::array<double, pair_types> alpha{};
};

/// The laws at one frequency.
PairStiffness pair_stiffness(const std::array<std::optional<Law>, pair_types>& laws, double omega);

/// Reactions of the bottom and top wall along z: force on the particles of that wall.
struct WallForces {
  Complex bottom = 0, top = 0;
};

/// The six relative displacements (Eq. 8 about x0) of a contact while the particles move by `motion` and the top wall
/// by `wall` along z.
std::array<Complex, 6> relative_motion(const Contact& contact, const Vector& motion, Complex wall);

class ContactOperator {
 public:
  ContactOperator(const ContactNetwork& network, std::size_t particles) : network_(network), particles_(particles) {}

  /// Forces and moments on the particles that move by `motion` while the top wall moves by `wall`. Deterministic for
  /// any number of threads: every contact's load is kept and each particle sums its row.
  void forces(const PairStiffness& stiffness, const Vector& motion, Complex wall, Vector& out) const;

  /// Forces between particles and walls alone.
  WallForces wall_forces(const PairStiffness& stiffness, const Vector& motion, Complex wall) const;

 private:
  struct Load {
    Complex a[6], b[6];
  };
  Load contact_load(const Contact& contact, const PairStiffness& stiffness, const Vector& motion, Complex wall) const;

  const ContactNetwork& network_;
  std::size_t particles_;
  mutable std::vector<Load> loads_;
};

}  // namespace macadam::harmonic
