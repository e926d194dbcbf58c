// SPDX-License-Identifier: GPL-3.0-or-later
/// \file contact_operator.hpp  Computes the forces of all contacts for given complex motions. These forces are the
/// product of the stiffness matrix K*(s) and the motion; the matrix itself is not stored.
#pragma once

#include <array>
#include <complex>
#include <cstdint>
#include <vector>

#include "kernels/contact/initial_contact.hpp"
#include "macadam/harmonic.hpp"
#include "macadam/sensitivity.hpp"

namespace macadam::harmonic {

using Complex = std::complex<double>;
using Vector = std::vector<Complex>;  ///< six numbers per particle: ux uy uz θx θy θz

/// Returns the mass [kg] or moment of inertia [kg·m²] of degree of freedom 6·particle + component.
inline double inertia_at(const Inertia& inertia, std::size_t dof) {
  return dof % 6 < 3 ? inertia.mass[dof / 6] : inertia.inertia[dof / 6];
}

/// Force and moment on a particle.
struct ParticleLoad {
  std::int32_t particle;
  std::array<Complex, 6> load;
};
/// Loads in ascending order of particles. Particles that are not listed have no load.
using Loads = std::vector<ParticleLoad>;

/// Returns the Euclidean length ‖x‖.
double length(const Vector& x);
double length(const Loads& loads);

/// For each pair type: the complex stiffness per unit of area over distance [Pa], and α, the ratio of shear to normal
/// stiffness.
struct PairStiffness {
  std::array<Complex, pair_types> k{};
  std::array<double, pair_types> alpha{};
};

/// Returns the stiffness of all laws for motions proportional to e^(s·t). \throws InputError if a law has none.
PairStiffness pair_stiffness(const LawTable& laws, Complex s);
// Deleted so that ω cannot be passed in place of iω.
PairStiffness pair_stiffness(const LawTable& laws, double) = delete;

/// Returns the stiffness of a contact in opening and bending, and in slip and twist without α [Pa]: the stiffness of
/// its law, or of its law in series with rock.
std::array<Complex, 2> contact_stiffness(const Contact& contact, const PairStiffness& stiffness);

/// Returns the six relative displacements of a contact (Eq. 8 about x0) if the particles move by `motion` and the walls
/// by `wall`.
std::array<Complex, 6> relative_motion(const Contact& contact, const Vector& motion, const WallMotion& wall);

/// Returns the load of a contact's springs at given relative displacements: force on its first end and moment about x0,
/// both along (n, s, t).
kernels::FacetLoad<Complex> facet_load(const Contact& contact, const PairStiffness& stiffness,
                                       const std::array<Complex, 6>& u);

/// The product with K*(s) of a network, computed contact by contact. Two other products exist: the iterative solver has
/// a faster one for several motions (iterative/apply_row.hpp), and check_solutions() has one of its own, so that the
/// check of a solution does not use the code of a solver. All three use the kinematics of kernels/contact. The network
/// must outlive this object.
class ContactOperator {
 public:
  ContactOperator(const ContactNetwork& network, std::size_t particles);

  /// Returns f, the forces and moments on the particles if the particles are at rest and the walls move by `wall`.
  Loads wall_loads(const PairStiffness& stiffness, const WallMotion& wall = {}) const;

  /// Computes out = (K* − factor·M)·motion, the loads that must act on the particles for this motion, with factor =
  /// −(s² + s·β)·density scaling. Each particle sums its own contacts in a fixed order, so that the result does not
  /// depend on the number of threads.
  void resistance(const PairStiffness& stiffness, Complex factor, const Inertia& inertia, const Vector& motion,
                  Vector& out) const;

  /// Returns the load that the contacts of the bottom wall, which is at rest, exert on the particles: the force along z
  /// [N], or the torque about the axis [N·m] if the top wall turns. `wall` is the motion of the walls.
  Complex bottom_load(const PairStiffness& stiffness, const Vector& motion, const WallMotion& wall = {}) const;

 private:
  struct Load {
    Complex a[6], b[6];
  };
  /// Returns the loads on both ends of a contact with relative displacements `u`.
  static Load contact_load(const Contact& contact, const PairStiffness& stiffness, const std::array<Complex, 6>& u);

  /// Returns the load that the contacts of a particle exert on it if the particles move by `motion`, the walls by
  /// `wall`, and the cells have the given pressures (cell_pressures()).
  std::array<Complex, 6> load_on(std::size_t particle, const PairStiffness& stiffness, const Vector& motion,
                                 const WallMotion& wall, const Vector& pressures) const;

  /// Returns the result of wall_loads() for a network whose cells resist changes of volume. In such a network the cells
  /// at the wall press on their neighbours.
  Loads wall_loads_of_cells(const PairStiffness& stiffness, const WallMotion& wall) const;

  const ContactNetwork& network_;
  std::size_t particles_;
  /// Contacts of the two walls, in ascending order; the list of the top wall is sorted by particle.
  std::vector<std::uint32_t> on_bottom_, on_top_;
};

}  // namespace macadam::harmonic
