// SPDX-License-Identifier: GPL-3.0-or-later
/// \file contact_motions.hpp  Computes the relative displacements of a contact for several motions of the particles,
/// and the matrices that turn relative displacements into forces.
#pragma once

#include <Eigen/Dense>

#include "kernels/contact/contact_kinematics.hpp"
#include "macadam/contact_network.hpp"

namespace macadam::harmonic {

/// The relative displacements of a contact in every motion, a column per motion. `normal` has opening and bending,
/// `shear` slip and twist; a displacement of one group causes no load of the other group.
struct ContactMotions {
  using Rows = Eigen::Matrix<double, 3, Eigen::Dynamic>;
  explicit ContactMotions(Eigen::Index count) : normal(3, count), shear(3, count) {}

  /// Computes the displacements of a contact in all motions. `basis` is [6·particles][motions]. The first motion also
  /// moves the top wall by one.
  void set(const Contact& c, const Eigen::MatrixXd& basis) {
    double u[6];
    const kernels::Placement<double> placement{c.n, c.s, c.t, c.arm_a, c.arm_b};
    const auto twist = [&](std::int32_t end, Eigen::Index j) -> kernels::Twist<double> {
      if (end < 0) return {{0, 0, end == wall_z_hi && j == 0 ? 1.0 : 0.0}, {}};
      const auto x = [&](Eigen::Index k) { return basis(6 * static_cast<Eigen::Index>(end) + k, j); };
      return {{x(0), x(1), x(2)}, {x(3), x(4), x(5)}};
    };
    for (Eigen::Index j = 0; j < normal.cols(); ++j) {
      kernels::relative_rates(placement, twist(c.a, j), twist(c.b, j), u);
      for (Eigen::Index k = 0; k < 3; ++k) normal(k, j) = u[k], shear(k, j) = u[3 + k];
    }
  }

  Rows normal, shear;
};

/// Return the 3 × 3 matrices that map relative displacements to forces divided by k*, for α = 1. The matrices contain
/// the same sums as condensed_load().
inline Eigen::Matrix3d normal_form(const Contact& c) {
  const auto& m = c.moments;
  Eigen::Matrix3d out;
  out << m.a, m.s, m.t, m.s, m.ss, m.st, m.t, m.st, m.tt;
  return out / c.length;
}
inline Eigen::Matrix3d shear_form(const Contact& c) {
  const auto& m = c.moments;
  Eigen::Matrix3d out;
  out << m.a, 0, -m.t, 0, m.a, m.s, -m.t, m.s, m.ss + m.tt;
  return out / c.length;
}

}  // namespace macadam::harmonic
