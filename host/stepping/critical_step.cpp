// SPDX-License-Identifier: GPL-3.0-or-later
// critical_step.cpp  Inertia of solid spheres, and a time step that cannot blow up.
//
// Leapfrog is stable for Δt ≤ 2/ω_max of M⁻¹K. A contact's energy ½·k·(a − b)² is at most k·a² + k·b²: twice the sum of
// its ends' own. So λ_max(M⁻¹K) ≤ 2·max_i λ_max(M_i⁻¹·K_ii) with the 6 × 6 blocks K_ii of the particles.
#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "macadam/stepper.hpp"

namespace macadam {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

Eigen::Vector3d eigen(const Vec3d& v) { return {v.x, v.y, v.z}; }

/// Adds the stiffness that one contact gives one of its ends: lever is signed along n (arm_a for A, −arm_b for B).
/// Displacement of the end's point (s, t): v + ω × (lever·n + s·ŝ + t·t̂).
void add_block(Matrix6& block, const Contact& c, double lever, double k, double alpha) {
  const Eigen::Vector3d n = eigen(c.n), s = eigen(c.s), t = eigen(c.t);
  auto row = [](const Eigen::Vector3d& v, const Eigen::Vector3d& w) {
    Vector6 r;
    r << v, w;
    return r;
  };
  // the six generalised displacements of this end as rows over (v, ω)
  const Vector6 open = row(n, Eigen::Vector3d::Zero());
  const Vector6 bend_s = row(Eigen::Vector3d::Zero(), -t), bend_t = row(Eigen::Vector3d::Zero(), s);
  const Vector6 slip_s = row(s, lever * t), slip_t = row(t, -lever * s);
  const Vector6 twist = row(Eigen::Vector3d::Zero(), n);
  const AreaMoments& m = c.moments;
  auto outer = [&](double weight, const Vector6& p, const Vector6& q) {
    block += 0.5 * k / c.distance * weight * (p * q.transpose() + q * p.transpose());
  };
  outer(m.a, open, open);
  outer(2 * m.s, open, bend_s);
  outer(2 * m.t, open, bend_t);
  outer(m.ss, bend_s, bend_s);
  outer(2 * m.st, bend_s, bend_t);
  outer(m.tt, bend_t, bend_t);
  outer(alpha * m.a, slip_s, slip_s);
  outer(alpha * m.a, slip_t, slip_t);
  outer(-2 * alpha * m.t, slip_s, twist);
  outer(2 * alpha * m.s, slip_t, twist);
  outer(alpha * (m.ss + m.tt), twist, twist);
}

}  // namespace

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

CriticalStep critical_step(const ContactNetwork& network, const std::array<std::optional<Law>, pair_types>& laws,
                           const Inertia& inertia, const StepperOptions& options) {
  double worst = 0;
  CriticalStep out;
  for (std::size_t i = 0; i < inertia.mass.size(); ++i) {
    Matrix6 block = Matrix6::Zero();
    for (const std::uint32_t number : network.row(i)) {
      const Contact& c = network.contacts[number];
      const auto [k, alpha] = std::visit(
          [](const auto& law) {
            return std::pair{law.instantaneous(), law.alpha};
          },
          laws[static_cast<std::size_t>(c.pair)].value());
      add_block(block, c, c.a == static_cast<std::int32_t>(i) ? c.arm_a : -c.arm_b, k, alpha);
    }
    Vector6 scale;  // M_i^(-1/2), so that the eigenproblem stays symmetric
    scale.head<3>().setConstant(1 / std::sqrt(inertia.mass[i] * options.density_scaling));
    scale.tail<3>().setConstant(1 / std::sqrt(inertia.inertia[i] * options.density_scaling));
    const Matrix6 scaled = scale.asDiagonal() * block * scale.asDiagonal();
    const double lambda = Eigen::SelfAdjointEigenSolver<Matrix6>(scaled, Eigen::EigenvaluesOnly).eigenvalues()(5);
    if (lambda > worst) {
      worst = lambda;
      out.particle = static_cast<std::int32_t>(i);
    }
  }
  out.dt = std::sqrt(2 / worst);
  if (options.damping_kind == Damping::local) out.dt /= std::sqrt(1 + options.damping);
  return out;
}

}  // namespace macadam
