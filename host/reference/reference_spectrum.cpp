// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reference_spectrum.cpp  Computes the eigenfrequency by a dense eigenvalue solver, and static equilibrium by
/// LDLᵀ factorisation. Weak springs hold the motions that have no stiffness.
#include "host/reference/reference_spectrum.hpp"

#include <cmath>

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <fmt/format.h>

#include "host/reference/reference_stiffness.hpp"
#include "macadam/error.hpp"

namespace macadam {

double reference_largest_frequency(const ContactNetwork& network, const LawTable& laws, const Inertia& inertia) {
  const std::size_t particles = inertia.mass.size();
  reference::require_inertia(inertia, particles);
  const Eigen::MatrixXd K = reference::assemble_stiffness(network, laws, particles).K;
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(K.rows(), K.cols());
  for (std::size_t i = 0; i < particles; ++i) {
    const auto row = static_cast<Eigen::Index>(6 * i);
    M.diagonal().segment<3>(row).setConstant(inertia.mass[i]);
    M.diagonal().segment<3>(row + 3).setConstant(inertia.inertia[i]);
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(K, M, Eigen::EigenvaluesOnly);
  return std::sqrt(modes.eigenvalues().maxCoeff());
}

// K is singular if some motions have no stiffness. But the load of a wall does no work on these motions, so K·u = f has
// a solution. The solution is found by repeating u += (K + H)⁻¹·(f − K·u) with weak springs H. The error of a motion
// with stiffness shrinks by a factor H/K each time. A free motion gets no force and stays at rest. At the end f − K·u ≈
// 0, so the springs H carry no load.
double reference_static_modulus(const Specimen& specimen, const ContactNetwork& network, const LawTable& laws) {
  // Stiffness of the weak springs as a fraction of the particle's own stiffness. The springs' stiffness is far below
  // the stiffness of the softest elastic motion, and far above the rounding errors of the factorisation.
  constexpr double holding = 1e-8;
  // Largest residual as a fraction of the load. The reaction has about this relative error.
  constexpr double tolerance = 1e-12;
  constexpr int most_rounds = 100;

  const reference::Stiffness stiffness = reference::assemble_stiffness(network, laws, specimen.size());
  Eigen::SparseMatrix<double> held = stiffness.K;
  for (Eigen::Index block = 0; block < held.rows(); block += 3) {
    const double own = held.diagonal().segment<3>(block).sum();
    for (Eigen::Index i = block; i < block + 3; ++i) held.coeffRef(i, i) += own > 0 ? holding * own : 1.0;
  }
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(held);

  const double displacement = gauge_length(specimen);  // a unit strain
  const Eigen::VectorXd load = stiffness.top_wall * displacement;
  // Forces and moments have different units; dividing moments by the particle's radius makes them comparable.
  const auto size_of = [&](const Eigen::VectorXd& v) {
    double sum = 0;
    for (std::size_t i = 0; i < specimen.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(6 * i);
      sum += v.segment<3>(row).squaredNorm() + (v.segment<3>(row + 3) / specimen.radius[i]).squaredNorm();
    }
    return std::sqrt(sum);
  };

  Eigen::VectorXd u = Eigen::VectorXd::Zero(load.size());
  Eigen::VectorXd residual = load;
  for (int round = 0; !(size_of(residual) <= tolerance * size_of(load)); ++round) {
    if (factors.info() != Eigen::Success || round == most_rounds) {
      throw RunError(
          fmt::format("static modulus: found a residual of {:.3g} of the load after {} rounds, expected at most {}",
                      size_of(residual) / size_of(load), round, tolerance));
    }
    u += factors.solve(residual);
    residual = load - stiffness.K * u;
  }
  const double reaction = stiffness.top_stiffness * displacement - stiffness.top_wall.dot(u);
  return reaction / section_area(specimen);
}

}  // namespace macadam
