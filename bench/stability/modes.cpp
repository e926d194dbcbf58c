// SPDX-License-Identifier: GPL-3.0-or-later
// modes.cpp  Computes eigenmodes, energy and momenta of an assembly of particles.
#include "bench/stability/modes.hpp"

#include <Eigen/Eigenvalues>

#include "bench/stability/stability.hpp"
#include "host/reference/reference_stiffness.hpp"

namespace macadam::stability {
namespace {

Eigen::VectorXd joined(const std::vector<Vec3d>& linear, const std::vector<Vec3d>& angular) {
  Eigen::VectorXd out(static_cast<Eigen::Index>(6 * linear.size()));
  for (std::size_t i = 0; i < linear.size(); ++i) {
    out.segment<6>(static_cast<Eigen::Index>(6 * i)) << linear[i].x, linear[i].y, linear[i].z, angular[i].x,
        angular[i].y, angular[i].z;
  }
  return out;
}

}  // namespace

Modes::Modes(const test::TestScene& scene) {
  const std::size_t n = scene.specimen.size();
  root_mass_.resize(static_cast<Eigen::Index>(6 * n));
  for (std::size_t i = 0; i < n; ++i) {
    root_mass_.segment<3>(static_cast<Eigen::Index>(6 * i)).setConstant(std::sqrt(scene.inertia.mass[i]));
    root_mass_.segment<3>(static_cast<Eigen::Index>(6 * i + 3)).setConstant(std::sqrt(scene.inertia.inertia[i]));
  }
  const Eigen::VectorXd inverse = root_mass_.cwiseInverse();
  const Eigen::MatrixXd K = reference::assemble_stiffness(with_points_of_moments(scene.network), scene.laws, n).K;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(inverse.asDiagonal() * K * inverse.asDiagonal());
  const Eigen::VectorXd& all = modes.eigenvalues();
  const double rigid = 1e-10 * all.maxCoeff();  // far below the softest elastic mode, and far above rounding
  Eigen::Index first = 0;
  while (all(first) < rigid) ++first;
  square_ = all.tail(all.size() - first);
  shape_ = modes.eigenvectors().rightCols(all.size() - first);
}

double Modes::energy(const ParticleState& state, double dt) const {
  const Eigen::VectorXd f = joined(state.force, state.moment).cwiseQuotient(root_mass_);
  const Eigen::VectorXd v = joined(state.velocity, state.spin).cwiseProduct(root_mass_);
  const Eigen::VectorXd modal = shape_.transpose() * f;
  return 0.5 * v.dot(v + dt * f) + 0.5 * modal.cwiseAbs2().cwiseQuotient(square_).sum();
}

void Modes::remove_rigid_part(std::vector<Vec3d>& velocity, std::vector<Vec3d>& spin) const {
  const Eigen::VectorXd v = joined(velocity, spin).cwiseProduct(root_mass_);
  const Eigen::VectorXd kept = (shape_ * (shape_.transpose() * v)).cwiseQuotient(root_mass_);
  for (std::size_t i = 0; i < velocity.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(6 * i);
    velocity[i] = {kept(k), kept(k + 1), kept(k + 2)};
    spin[i] = {kept(k + 3), kept(k + 4), kept(k + 5)};
  }
}

Momenta momenta(const test::TestScene& scene, const ParticleState& state, bool displaced) {
  Momenta out;
  for (std::size_t i = 0; i < scene.specimen.size(); ++i) {
    const double m = scene.inertia.mass[i];
    const Vec3d& start = scene.specimen.centre[i];
    out.linear += m * state.velocity[i];
    out.angular += m * cross(displaced ? start + state.displacement[i] : start, state.velocity[i]);
    out.angular += scene.inertia.inertia[i] * state.spin[i];
  }
  return out;
}

}  // namespace macadam::stability
