// SPDX-License-Identifier: GPL-3.0-or-later
/// \file contact_operator.hpp  Forces of all contacts for given complex motions: K*(s) without a matrix.
#pragma once

#include <array>
#include <complex>
#include <cstdint>
#include <vector>

#include "kernels/contact_kinematics.hpp"
#include "macadam/harmonic.hpp"
#include "macadam/sensitivity.hpp"

namespace macadam::harmonic {

using Complex = std::complex<double>;
using Vector = std::vector<Complex>;  ///< six numbers a particle: ux uy uz θx θy θz

/// Mass or moment of inertia of degree of freedom 6·particle + component.
inline double inertia_at(const Inertia& inertia, std::size_t dof) {
  return dof % 6 < 3 ? inertia.mass[dof / 6] : inertia.inertia[dof / 6];
}

/// Force and moment on a particle.
struct ParticleLoad {
  std::int32_t particle;
  std::array<Complex, 6> load;
};
using Loads = std::vector<ParticleLoad>;  ///< by particle, ascending; nothing on the others

/// ‖x‖.
double length(const Vector& x);
double length(const Loads& loads);

/// Complex stiffness per unit of area over distance, and α, of each pair type.
struct PairStiffness {
  std::array<Complex, pair_types> k{};
  std::array<double, pair_types> alpha{};
};

/// The laws for motions as e^(s·t).
PairStiffness pair_stiffness(const LawTable& laws, Complex s);
PairStiffness pair_stiffness(const LawTable& laws, double) = delete;  // iω, not ω

/// The six relative displacements (Eq. 8 about x0) of a contact while the particles move by `motion` and the top wall
/// by `wall` along z.
std::array<Complex, 6> relative_motion(const Contact& contact, const Vector& motion, Complex wall);

/// What a contact carries at these relative displacements: force on its first body and moment about x0, both along
/// (n, s, t).
kernels::FacetLoad<Complex> facet_load(const Contact& contact, const PairStiffness& stiffness,
                                       const std::array<Complex, 6>& u);

class ContactOperator {
 public:
  ContactOperator(const ContactNetwork& network, std::size_t particles);

  /// Forces and moments on the particles at rest while the top wall moves by one.
  Loads wall_loads(const PairStiffness& stiffness) const;

  /// (K* − factor·M)·motion: the loads that hold the motion; factor: −(s² + s·β)·density scaling.
  /// Every particle sums its own row, so that the bits do not depend on the number of threads.
  void resistance(const PairStiffness& stiffness, Complex factor, const Inertia& inertia, const Vector& motion,
                  Vector& out) const;

  /// Force of the bottom wall, which is at rest, on its particles along z.
  Complex bottom_force(const PairStiffness& stiffness, const Vector& motion) const;

 private:
  struct Load {
    Complex a[6], b[6];
  };
  /// `u`: relative displacements of the contact.
  static Load contact_load(const Contact& contact, const PairStiffness& stiffness, const std::array<Complex, 6>& u);

  const ContactNetwork& network_;
  std::size_t particles_;
  std::vector<std::uint32_t> on_bottom_, on_top_;  ///< contacts of the two walls: ascending; by particle
};

}  // namespace macadam::harmonic
