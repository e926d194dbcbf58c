// SPDX-License-Identifier: GPL-3.0-or-later
// critical_step.cpp  Computes masses and moments of inertia of solid spheres, and a time step with which the run is
// certainly stable.
//
// Leapfrog is stable for Δt ≤ 2/ω_max of M⁻¹K. The energy of a contact, ½·k·(a − b)², is at most k·a² + k·b², twice the
// sum of the energies that each end alone would give. So λ_max(M⁻¹K) ≤ 2·max_i λ_max(M_i⁻¹·K_ii) with the 6 × 6 blocks
// K_ii of the particles (model (11.1)).
#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "host/network/contact_stiffness.hpp"
#include "host/spheres/parallel_blocks.hpp"
#include "macadam/stepper.hpp"

namespace macadam {

Inertia make_inertia(const Specimen& specimen, double density_aggregate, double density_mastic) {
  Inertia out;
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const double r = specimen.radius[i];
    const double rho = specimen.phase[i] == Phase::aggregate ? density_aggregate : density_mastic;
    out.mass.push_back(rho * 4.0 / 3.0 * std::numbers::pi * r * r * r);
    out.inertia.push_back(0.4 * out.mass.back() * r * r);
  }
  return out;
}

namespace {

/// Returns the stiffness of all contacts on a wall along an axis [N/m].
double stiffness_on(const ContactNetwork& network, const FactsTable& laws, std::int32_t wall, int axis) {
  double sum = 0;
  for (const Contact& c : network.contacts) {
    if (c.b != wall) continue;
    const LawFacts& law = laws[static_cast<std::size_t>(c.pair)].value();
    const double n[3] = {c.n.x, c.n.y, c.n.z}, normal = n[axis] * n[axis];
    const double weak_n = 1 + c.series * law.instantaneous, weak_s = 1 + c.series * law.alpha * law.instantaneous;
    sum += law.instantaneous * c.moments.a / c.length * (normal / weak_n + law.alpha * (1 - normal) / weak_s);
  }
  return sum;
}

}  // namespace

CriticalStep critical_step(const ContactNetwork& network, const FactsTable& laws, const Inertia& inertia,
                           const StepperOptions& options) {
  std::vector<double> largest(inertia.mass.size());  // largest eigenvalue of each particle
  for_each_in_blocks(largest.size(), true, [&](std::size_t i) {
    Matrix6 block = Matrix6::Zero();
    for (const std::uint32_t number : network.row(i)) {
      const Contact& c = network.contacts[number];
      const LawFacts& law = laws[static_cast<std::size_t>(c.pair)].value();
      const int end = c.a == static_cast<std::int32_t>(i) ? 0 : 1;
      block += contact_block(c, law.instantaneous, law.alpha, end, end);
    }
    Eigen::Matrix<double, 6, 1> scale;  // M_i^(-1/2), which keeps the eigenvalue problem symmetric
    scale.head<3>().setConstant(1 / std::sqrt(inertia.mass[i] * options.density_scaling));
    scale.tail<3>().setConstant(1 / std::sqrt(inertia.inertia[i] * options.density_scaling));
    const Matrix6 scaled = scale.asDiagonal() * block * scale.asDiagonal();
    largest[i] = Eigen::SelfAdjointEigenSolver<Matrix6>(scaled, Eigen::EigenvaluesOnly).eigenvalues()(5);
  });
  double worst = 0;
  CriticalStep out;
  for (std::size_t i = 0; i < largest.size(); ++i) {
    if (largest[i] > worst) worst = largest[i], out.particle = static_cast<std::int32_t>(i);
  }
  for (int w = 0; w < wall_count; ++w) {
    const WallMotionSpec& wall = options.boundary.wall[static_cast<std::size_t>(w)];
    for (int axis = 0; axis < 3; ++axis) {
      if (wall.axis[static_cast<std::size_t>(axis)].by != DrivenBy::force) continue;
      const double lambda = stiffness_on(network, laws, -1 - w, axis) / (wall.mass * options.density_scaling);
      if (lambda > worst) {
        worst = lambda;
        out.particle = -1;
      }
    }
  }
  out.dt = std::sqrt(2 / worst);
  if (options.damping_kind == Damping::local) out.dt /= std::sqrt(1 + options.damping);
  return out;
}

}  // namespace macadam
