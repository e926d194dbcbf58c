// SPDX-License-Identifier: GPL-3.0-or-later
/// \file contact_motions.hpp  Computes the relative displacements of a contact for several motions of the particles,
/// and the matrices that turn relative displacements into forces.
#pragma once

#include <Eigen/Dense>

#include "host/network/contact_stiffness.hpp"
#include "kernels/contact/initial_contact.hpp"

namespace macadam::harmonic {

/// The relative displacements of a contact in every motion, a column per motion. `normal` has opening and bending,
/// `shear` slip and twist; a displacement of one group causes no load of the other group.
struct ContactMotions {
  using Rows = Eigen::Matrix<double, 3, Eigen::Dynamic>;
  explicit ContactMotions(Eigen::Index count) : normal(3, count), shear(3, count) {}

  /// Computes the displacements of a contact in all motions. `basis` is [6·particles][motions]. The first motion also
  /// moves the top wall by one.
  void set(const Contact& c, const Eigen::MatrixXd& basis) {
    const auto twist = [&](std::int32_t end, Eigen::Index j) -> kernels::Twist<double> {
      if (end < 0) return {{0, 0, end == wall_z_hi && j == 0 ? 1.0 : 0.0}, {}};
      const auto x = [&](Eigen::Index k) { return basis(6 * static_cast<Eigen::Index>(end) + k, j); };
      return {{x(0), x(1), x(2)}, {x(3), x(4), x(5)}};
    };
    for (Eigen::Index j = 0; j < normal.cols(); ++j) {
      const auto u = kernels::relative_displacements(c, twist(c.a, j), twist(c.b, j));
      for (std::size_t k = 0; k < 3; ++k) {
        normal(static_cast<Eigen::Index>(k), j) = u[k];
        shear(static_cast<Eigen::Index>(k), j) = u[3 + k];
      }
    }
  }

  Rows normal, shear;
};

/// Return the 3 × 3 matrices that map relative displacements to forces divided by k*, for α = 1.
inline Eigen::Matrix3d normal_form(const Contact& c) { return normal_moments(c.moments) / c.length; }
inline Eigen::Matrix3d shear_form(const Contact& c) { return shear_moments(c.moments) / c.length; }

}  // namespace macadam::harmonic
