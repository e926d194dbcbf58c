// SPDX-License-Identifier: GPL-3.0-or-later
// recovery.cpp  Loads, holds, reverses, holds and releases particles, and checks how much deformation remains: springs
// and Kelvin units recover completely, the dashpot in series does not.
//
// Positions are imposed until the release; then the particles are free. They go from rest to rest after the release, so
// the forces have no net impulse, and the dashpot in series keeps the displacement that it had at the release, whatever
// the masses: u(∞) = y(t₃), y = ∫f/C_m dt.
#include <Eigen/Dense>
#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include <fmt/format.h>

#include "bench/stability/stability.hpp"

namespace macadam::stability {
namespace {

/// A stage of the loading with constant velocity.
struct Stage {
  double steps;     ///< duration in steps of the coarsest Δt
  double velocity;  ///< displacement per coarsest step, as a fraction of the largest displacement
};
/// The stages. The displacement, as a fraction of the largest one, rises to 1, is held, falls to −0.5, and is held.
constexpr Stage stages[] = {{1000, 1e-3}, {2000, 0}, {1500, -1e-3}, {1000, 0}};
constexpr double relaxing = 25000;  ///< duration of the recovery in coarsest steps: fifty times the 500 steps of the
                                    ///< slower Kelvin unit

/// Returns a law whose relaxation times are given in coarsest steps: 2000 for the dashpot in series (`flows`), 500 and
/// 100 for the Kelvin units.
laws::GeneralisedKelvin test_law(double step, bool flows) {
  return {1e10, flows ? 1e10 * 2000 * step : INFINITY, {0.5e10, 2e10}, {0.5e10 * 500 * step, 2e10 * 100 * step}, 0.3};
}

/// The exact solution of the stages of loading for one chain. x is the imposed displacement, y the displacement of the
/// Maxwell dashpot, x_l that of Kelvin unit l, and f the force: y' = f/C_m, x_l' = (f − E_l·x_l)/C_l,
/// f = E_m·(x − y − Σ x_l). The rate x' is constant within a stage, so (y, x_1, x_2, x, x') follows a linear system
/// with a constant matrix. The largest imposed displacement is 1.
struct Exact {
  std::vector<double> force;  ///< f/E_m at the end of each stage
  double flow = 0;            ///< y at the release
};
/// Integrates the stages with matrix exponentials.
Exact exact_solution(const laws::GeneralisedKelvin& law, double step) {
  Eigen::Matrix<double, 5, 5> A = Eigen::Matrix<double, 5, 5>::Zero();
  Eigen::Matrix<double, 1, 5> f;
  f << -1, -1, -1, 1, 0;
  f *= law.E_m;
  if (std::isfinite(law.C_m)) A.row(0) = f / law.C_m;
  for (int l = 0; l < 2; ++l) {
    A.row(1 + l) = f / law.C[static_cast<std::size_t>(l)];
    A(1 + l, 1 + l) -= law.E[static_cast<std::size_t>(l)] / law.C[static_cast<std::size_t>(l)];
  }
  A(3, 4) = 1;
  Eigen::Matrix<double, 5, 1> z = Eigen::Matrix<double, 5, 1>::Zero();
  Exact out;
  for (const Stage& stage : stages) {
    z(4) = stage.velocity / step;
    const Eigen::Matrix<double, 5, 5> over = (A * stage.steps * step).exp();
    z = over * z;
    out.force.push_back(f.dot(z) / law.E_m);
  }
  out.flow = z(0);
  return out;
}

/// Results of a stepped run.
struct Measured {
  std::vector<double> force;  ///< force on the observed particle along its displacement, at the end of each stage [N]
  double impulse = 0;         ///< trapezoidal time integral of that force up to the release [N·s]
  std::vector<Vec3d> left;    ///< displacements at the end [m]
};

/// Moves every particle along its own `direction`, and then releases it. `direction` is the displacement of the
/// particle when the displacement of the stages is 1.
Measured run(Stepper& stepper, const test::TestScene& scene, const std::vector<Vec3d>& direction, std::size_t observed,
             double dt, double step, double settle) {
  const std::size_t n = scene.specimen.size();
  Measured out;
  const double along = dot(direction[observed], direction[observed]);
  std::vector<Vec3d> velocity(n), spin(n);
  ParticleState state = stepper.particles();
  // The step changes the velocity by Δt·force/mass. This change is subtracted beforehand, so that the step moves the
  // particle at exactly the wanted velocity.
  const auto set = [&](double rate, double share) {
    for (std::size_t i = 0; i < n; ++i) {
      velocity[i] = rate * direction[i] - (share * dt / scene.inertia.mass[i]) * state.force[i];
      spin[i] = (-share * dt / scene.inertia.inertia[i]) * state.moment[i];
    }
    stepper.set_velocities(velocity, spin);
  };
  double force = 0;
  for (const Stage& stage : stages) {
    const auto steps = std::llround(stage.steps * step / dt);
    for (std::int64_t k = 0; k < steps; ++k) {
      set(stage.velocity / step, 1);
      stepper.advance(1);
      state = stepper.particles();
      const double now = -dot(state.force[observed], direction[observed]) / std::sqrt(along);
      out.impulse += 0.5 * dt * (force + now);
      force = now;
    }
    out.force.push_back(force);
  }
  set(0, 0.5);  // half a step's velocity change is subtracted, so that particles are at rest at the full step
  stepper.advance(std::llround(settle * step / dt));
  out.left = stepper.particles().displacement;
  return out;
}

/// Checks two particles along z. The lower one is too heavy to move.
void pair_rows(Rows& rows, const Setting& setting, bool flows, Effort effort) {
  test::HandMade made = test::two_sphere_network();
  made.inertia.mass[0] = made.inertia.inertia[0] = 1e30;
  test::TestScene scene{made.specimen, made.network, test::same_law(laws::Elastic{1e10, 0.3}), made.inertia};
  const Contact& contact = scene.network.contacts[0];
  const double stiffness = 1e10 * contact.area / contact.length;
  const double step = 0.1 * std::sqrt(scene.inertia.mass[1] / stiffness);  // ωΔt = 0.1
  const auto law = test_law(step, flows);
  scene.laws = test::same_law(law);
  const Exact exact = exact_solution(law, step);
  const double largest = 1e-7;  // displacement [m]: a strain of 6e-5
  const double peak = *std::max_element(exact.force.begin(), exact.force.end());
  const std::string name = flows ? "pair, with a dashpot in series" : "pair, without a dashpot in series";

  std::vector<double> error;
  const std::vector<double> fractions = effort == Effort::test ? std::vector{1.0} : std::vector{1.0, 0.5};
  for (const double fraction : fractions) {
    StepperOptions options;
    options.dt = fraction * step;
    options.geometry = Geometry::fixed;
    const auto stepper = make(setting, scene, options);
    const Measured found = run(*stepper, scene, {Vec3d{}, Vec3d{0, 0, largest}}, 1, options.dt, step, relaxing);
    const double left = found.left[1].z / largest;
    // Rounding errors add up like a random walk over the steps. In single precision each step changes a state of size 1
    // by up to half an ulp (2⁻²⁴).
    const double steps = (5500 + relaxing) / fraction;
    const double rounding = setting.precision == Precision::single  ? 10 * 0x1p-24 * std::sqrt(steps)
                            : setting.precision == Precision::mixed ? 0x1p-24
                                                                    : 10 * 0x1p-53 * std::sqrt(steps);
    const double order =
        1e-4 / 12 * fraction * fraction;  // (Δt·rate)²/12, rate = Σ E_m/C + E_l/C_l < 0.01 per coarsest step
    double worst = 0;
    for (std::size_t s = 0; s < exact.force.size(); ++s) {
      worst = std::max(worst, std::abs(found.force[s] / (stiffness * largest) - exact.force[s]) / peak);
    }
    const std::string run_name = fmt::format("{}, Δt = {} of 1/(10·ω)", name, fraction);
    rows.push_back({run_name, setting.name(), "force at the ends of four stages, worst error / peak", 0,
                    order + rounding, "the exact solution of the chain; the trapezoidal rule errs by (Δt·rate)²/12",
                    worst});
    if (flows) {
      rows.push_back({run_name, setting.name(), "permanent displacement − exact ∫f/C_m dt, of the largest",
                      -order - rounding, order + rounding,
                      "no impulse after the release: the dashpot keeps its displacement", left - exact.flow});
      const double stepped = found.impulse / (law.C_m * contact.area / contact.length) / largest;
      rows.push_back({run_name, setting.name(), "permanent displacement − trapezoidal ∫f/C_m dt, of the largest",
                      -rounding, rounding, "the rule keeps this to rounding at any Δt", left - stepped});
      error.push_back(left - exact.flow);
    } else {
      rows.push_back({run_name, setting.name(), "displacement left, of the largest", -rounding, rounding,
                      "springs and Kelvin units give everything back", left});
    }
  }
  if (flows && setting.precision == Precision::double_ && error.size() == 2) {
    rows.push_back({name, setting.name(), "error of the permanent displacement, Δt over Δt/2", 3.8, 4.2,
                    "second order in Δt: exact in the limit", error[0] / error[1]});
  }
}

/// Returns the largest length of δ after its rigid rotation about the centre of mass is subtracted.
double beyond_rigid(const test::TestScene& scene, std::vector<Vec3d> delta, const std::vector<Vec3d>& arm) {
  Vec3d turning{};
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < delta.size(); ++i) {
    const Eigen::Vector3d e(arm[i].x, arm[i].y, arm[i].z);
    inertia += scene.inertia.mass[i] * (e.squaredNorm() * Eigen::Matrix3d::Identity() - e * e.transpose());
    turning += scene.inertia.mass[i] * cross(arm[i], delta[i]);
  }
  const Eigen::Vector3d w = inertia.ldlt().solve(Eigen::Vector3d(turning.x, turning.y, turning.z));
  for (std::size_t i = 0; i < delta.size(); ++i) delta[i] -= cross(Vec3d{w.x(), w.y(), w.z()}, arm[i]);
  return test::largest(delta);
}

/// Stretches and shears a free assembly uniformly and then releases it. All contacts have the same law and the same
/// history, so the permanent displacements of their dashpots fit together without residual forces. The permanent
/// deformation is therefore y(t₃) times the imposed one, where y is computed for an imposed displacement of at most 1
/// (see Exact).
void assembly_rows(Rows& rows, const Setting& setting, bool flows) {
  NetworkSpec spec;
  spec.bottom_top_walls = false;
  auto scene = test::make_scene(test::random_specimen(12, 3, 3, 3), spec, test::same_law(laws::Elastic{1e10, 0.3}));
  const double step = 0.1 * true_limit(scene) / 2;
  const auto law = test_law(step, flows);
  scene.laws = test::same_law(law);
  const double strain = 1e-4;
  Vec3d centre{};
  double mass = 0;
  for (std::size_t i = 0; i < scene.specimen.size(); ++i) {
    centre += scene.inertia.mass[i] * scene.specimen.centre[i];
    mass += scene.inertia.mass[i];
  }
  centre = (1 / mass) * centre;
  std::vector<Vec3d> arm, direction;
  for (const Vec3d& x : scene.specimen.centre) {
    const Vec3d a = x - centre;
    arm.push_back(a);
    direction.push_back(strain * Vec3d{-0.3 * a.x + 0.4 * a.y, 0.4 * a.x - 0.3 * a.y + 0.2 * a.z, 0.2 * a.y + a.z});
  }
  StepperOptions options;
  options.dt = step;
  options.geometry = Geometry::fixed;
  const auto stepper = make(setting, scene, options);
  const Measured found = run(*stepper, scene, direction, 0, step, step, relaxing);
  const double flow = exact_solution(law, step).flow;
  std::vector<Vec3d> delta = found.left;
  for (std::size_t i = 0; i < delta.size(); ++i) delta[i] -= flow * direction[i];
  const double steps = 5500 + relaxing;
  const double rounding = setting.precision == Precision::double_ ? 1e-10
                          : setting.precision == Precision::mixed ? 1e-5
                                                                  : 100 * 0x1p-24 * std::sqrt(steps);
  rows.push_back({flows ? "27 particles, with dashpots in series" : "27 particles, without dashpots in series",
                  setting.name(), "displacements left − exact, of the largest imposed", 0,
                  (flows ? 1e-4 / 12 : 0) + rounding,
                  flows ? "the permanent field is y(t₃) of the imposed one; (Δt·rate)²/12 of the rule"
                        : "everything comes back; slow modes of the assembly decay to 1e-10",
                  beyond_rigid(scene, delta, arm) / test::largest(direction)});
}

}  // namespace

Rows recovery(Effort effort) {
  Rows rows;
  for (const Setting& setting : settings()) {
    if (effort == Effort::test && setting.precision == Precision::mixed) continue;
    for (const bool flows : {true, false}) pair_rows(rows, setting, flows, effort);
  }
  for (const Setting& setting : settings()) {
    if (effort == Effort::test && setting.precision != Precision::double_) continue;
    for (const bool flows : {true, false}) assembly_rows(rows, setting, flows);
  }
  return rows;
}

}  // namespace macadam::stability
