// SPDX-License-Identifier: GPL-3.0-or-later
/// \file contact_operator.hpp  Forces of all contacts for given complex motions: K*(ω) without a matrix.
#pragma once

#include <complex>
#include <vector>

#include "macadam/harmonic.hpp"
#include "macadam/sensitivity.hpp"

namespace macadam::harmonic {

using Complex = std::complex<double>;
using Vector = std::vector<Complex>;  ///< six numbers a particle: ux uy uz θx θy θz

/// Mass or moment of inertia of degree of freedom 6·particle + component.
inline double inertia_at(const Inertia& inertia, std::size_t dof) {
  return dof % 6 < 3 ? inertia.mass[dof / 6] : inertia.inertia[dof / 6];
}

/// Complex stiffness per unit of area over distance, and α, of each pair type.
struct PairStiffness {
  std::array<Complex, pair_types> k{};
  std::array<double, pair_types> alpha{};
};

/// The laws at one frequency.
PairStiffness pair_stiffness(const std::array<std::optional<Law>, pair_types>& laws, double omega);

/// The six relative displacements (Eq. 8 about x0) of a contact while the particles move by `motion` and the top wall
/// by `wall` along z.
std::array<Complex, 6> relative_motion(const Contact& contact, const Vector& motion, Complex wall);

class ContactOperator {
 public:
  ContactOperator(const ContactNetwork& network, std::size_t particles) : network_(network), particles_(particles) {}

  /// Forces and moments on the particles that move by `motion` while the top wall moves by `wall`. Deterministic for
  /// any number of threads: every contact's load is kept and each particle sums its row.
  void forces(const PairStiffness& stiffness, const Vector& motion, Complex wall, Vector& out) const;

  /// (K* − factor·M)·motion: the loads that hold the motion at one frequency; factor: (ω² − iωβ)·density scaling.
  void resistance(const PairStiffness& stiffness, Complex factor, const Inertia& inertia, const Vector& motion,
                  Vector& out) const;

  /// Σ u·k*·u over the contacts of each pair, u their relative displacements, without conjugates: twice the energy,
  /// where real. Not yet over the specimen's size, and without inertia.
  ModulusParts energy_parts(const PairStiffness& stiffness, const Vector& motion, Complex wall) const;

  /// Force of the bottom wall, which is at rest, on its particles along z.
  Complex bottom_force(const PairStiffness& stiffness, const Vector& motion) const;

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
