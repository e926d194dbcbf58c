// SPDX-License-Identifier: GPL-3.0-or-later
// contact_stiffness.cpp  Computes the stiffness Gᵀ·D·G of one contact. G maps the motion of the particle at one
// end of the contact to the six generalised displacements q of the contact, and D is the 6×6 stiffness matrix for q,
// computed from the area moments.
#include "host/network/contact_stiffness.hpp"

namespace macadam {
namespace {

Eigen::Vector3d eigen(const Vec3d& v) { return {v.x, v.y, v.z}; }

/// Returns the matrix that maps the motion (displacement, rotation) of the particle at one end to the six generalised
/// displacements of the contact.
Matrix6 generalised(const Contact& c, int end) {
  const double sign = end == 0 ? -1 : 1, lever = end == 0 ? c.arm_a : -c.arm_b;
  const Eigen::Vector3d n = eigen(c.n), s = eigen(c.s), t = eigen(c.t), zero = Eigen::Vector3d::Zero();
  Matrix6 g;
  g.row(0) << n.transpose(), zero.transpose();
  g.row(1) << zero.transpose(), -t.transpose();
  g.row(2) << zero.transpose(), s.transpose();
  g.row(3) << s.transpose(), lever * t.transpose();
  g.row(4) << t.transpose(), -lever * s.transpose();
  g.row(5) << zero.transpose(), n.transpose();
  return sign * g;
}

}  // namespace

Eigen::Matrix3d normal_moments(const AreaMoments& m) {
  Eigen::Matrix3d out;
  out << m.a, m.s, m.t, m.s, m.ss, m.st, m.t, m.st, m.tt;
  return out;
}

Eigen::Matrix3d shear_moments(const AreaMoments& m) {
  Eigen::Matrix3d out;
  out << m.a, 0, -m.t, 0, m.a, m.s, -m.t, m.s, m.ss + m.tt;
  return out;
}

Matrix6 contact_block(const Contact& c, double k, double alpha, int i, int j) {
  Matrix6 d = Matrix6::Zero();
  d.topLeftCorner<3, 3>() = normal_moments(c.moments);
  d.bottomRightCorner<3, 3>() = alpha * shear_moments(c.moments);
  if (c.series != 0) {
    d.topLeftCorner<3, 3>() /= 1 + c.series * k;
    d.bottomRightCorner<3, 3>() /= 1 + c.series * alpha * k;
  }
  return generalised(c, i).transpose() * (k / c.length * d) * generalised(c, j);
}

}  // namespace macadam
