// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reference_stiffness.cpp  Assembles the stiffness matrix as the sum of BᵀDB over all contact points. B maps the
/// motion of a particle to the displacement of the point, and D is the stiffness of the point.
#include "host/reference/reference_stiffness.hpp"

#include "host/reference/reference_contact.hpp"

namespace macadam::reference {
namespace {

using Matrix36 = Eigen::Matrix<double, 3, 6>;

/// Returns [I, −lever×], which gives the displacement u + θ × lever of the material point at `lever` from a centre, for
/// a motion (u, θ).
Matrix36 point_motion(const Vector3d& lever) {
  Matrix36 out;
  out.leftCols<3>().setIdentity();
  out.rightCols<3>() << 0, lever.z(), -lever.y(), -lever.z(), 0, lever.x(), lever.y(), -lever.x(), 0;
  return out;
}

/// Adds a 6 × 6 block to the entries of K.
void add_block(std::vector<Eigen::Triplet<double>>& entries, std::int32_t row, std::int32_t column,
               const Eigen::Matrix<double, 6, 6>& block) {
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) entries.emplace_back(6 * row + i, 6 * column + j, block(i, j));
  }
}

}  // namespace

Stiffness assemble_stiffness(const ContactNetwork& network, const LawTable& laws, std::size_t particles) {
  require_network(network, particles);
  const ReferenceLaws chains = read_laws(network, laws);
  const auto size = static_cast<Eigen::Index>(6 * particles);
  Stiffness out{Eigen::SparseMatrix<double>(size, size), Eigen::VectorXd::Zero(size), 0};
  std::vector<Eigen::Triplet<double>> entries;

  for (const Contact& contact : network.contacts) {
    const ReferenceLaw& law = *chains[static_cast<std::size_t>(contact.pair)];
    const ReferenceContact geometry = make_reference_contact(network, contact, 0);
    const Eigen::Matrix3d along_n = geometry.frame.n * geometry.frame.n.transpose();
    const double rock_n = 1 + contact.series * law.E_m, rock_s = 1 + law.alpha * contact.series * law.E_m;
    const Eigen::Matrix3d direction = along_n / rock_n + law.alpha / rock_s * (Eigen::Matrix3d::Identity() - along_n);
    for (const ContactPoint& point : geometry.points) {
      const Eigen::Matrix3d D = law.E_m * point.area / contact.length * direction;
      const Matrix36 side_a = point_motion(geometry.frame.lever_a(point));
      add_block(entries, contact.a, contact.a, side_a.transpose() * D * side_a);
      if (contact.b == wall_z_hi) {
        out.top_wall.segment<6>(6 * contact.a) += side_a.transpose() * D.col(2);
        out.top_stiffness += D(2, 2);
      }
      if (geometry.at_wall()) continue;
      const Matrix36 side_b = point_motion(geometry.frame.lever_b(point));
      add_block(entries, contact.b, contact.b, side_b.transpose() * D * side_b);
      add_block(entries, contact.a, contact.b, -side_a.transpose() * D * side_b);
      add_block(entries, contact.b, contact.a, -side_b.transpose() * D * side_a);
    }
  }
  out.K.setFromTriplets(entries.begin(), entries.end());
  return out;
}

}  // namespace macadam::reference
