// SPDX-License-Identifier: GPL-3.0-or-later
// rigid_turn.cpp  Turns a specimen once about an oblique axis. In one case its particles are moved on exact circles, in
// the other the specimen rotates freely.
#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "bench/stability/modes.hpp"
#include "bench/stability/stability.hpp"

namespace macadam::stability {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;

test::TestScene free_assembly() {
  NetworkSpec spec;
  spec.bottom_top_walls = false;
  return test::make_scene(test::random_specimen(41, 3, 3, 3), spec, elastic_laws());
}

const Vec3d oblique = (1 / std::sqrt(14.0)) * Vec3d{1, -2, 3};

Vec3d turned(const Vec3d& v, double by, const Vec3d& axis = oblique) {  // rotation by Rodrigues' formula
  return std::cos(by) * v + std::sin(by) * cross(axis, v) + (1 - std::cos(by)) * dot(axis, v) * axis;
}

Vec3d centre_of_mass(const test::TestScene& scene) {
  Vec3d sum{};
  double mass = 0;
  for (std::size_t i = 0; i < scene.specimen.size(); ++i) {
    sum += scene.inertia.mass[i] * scene.specimen.centre[i];
    mass += scene.inertia.mass[i];
  }
  return (1 / mass) * sum;
}

/// Returns the axis of the largest moment of inertia, about which a free body rotates steadily.
Vec3d principal_axis(const test::TestScene& scene, const Vec3d& centre) {
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < scene.specimen.size(); ++i) {
    const Vec3d x = scene.specimen.centre[i] - centre;
    const Eigen::Vector3d e(x.x, x.y, x.z);
    inertia += scene.inertia.mass[i] * (e.squaredNorm() * Eigen::Matrix3d::Identity() - e * e.transpose());
  }
  const Eigen::Vector3d axis = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia).eigenvectors().col(2);
  return {axis.x(), axis.y(), axis.z()};
}

/// Returns half the box's diagonal divided by the smallest distance of a contact. The velocities and their rounding
/// errors are larger than the relative velocities at a contact by this factor.
double extent(const test::TestScene& scene) {
  double least = INFINITY;
  for (const Contact& c : scene.network.contacts) least = std::min(least, c.distance);
  return norm(scene.specimen.box.size) / 2 / least;
}

/// Moves the particles on exact circles for a full turn. Their masses are so large that the given velocities do not
/// change.
void led(Rows& rows, const Setting& setting, ContactForm form, std::int64_t steps) {
  test::TestScene scene = free_assembly();
  scene.inertia.mass.assign(scene.specimen.size(), 1e30);
  scene.inertia.inertia.assign(scene.specimen.size(), 1e30);
  StepperOptions options;
  options.dt = 1e-6;
  options.form = form;
  const auto stepper = make(setting, scene, options);
  const double angle = full_turn / static_cast<double>(steps);
  const std::size_t n = scene.specimen.size();
  const Vec3d middle = 0.5 * scene.specimen.box.size;
  std::vector<Vec3d> velocity(n);
  const std::vector<Vec3d> spin(n, (angle / options.dt) * oblique);
  double force = 0;
  for (std::int64_t k = 0; k < steps; ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3d x = scene.specimen.centre[i] - middle;
      const double from = static_cast<double>(k) * angle;
      velocity[i] = (1 / options.dt) * (turned(x, from + angle) - turned(x, from));
    }
    stepper->set_velocities(velocity, spin);
    stepper->advance(1);
    if (k % 1000 == 999 || k + 1 == steps) force = std::max(force, test::largest(stepper->particles().force));
  }
  double area = 0;
  for (const Contact& c : scene.network.contacts) area = std::max(area, c.area);
  // Particles move along the chord 2·sin(θ/2)·d but rotate by the arc θ·d, which causes a slip of d·θ³/24 in each step.
  // The rounding error of velocities is ε times the assembly's extent. In double and mixed precision these errors add
  // up like a random walk; in single precision displacements, and therefore normals, are rounded too.
  const double slip = full_turn * angle * angle / 24;
  const double walk = setting.rounding() * extent(scene) * std::sqrt(static_cast<double>(steps)) *
                      (setting.precision == Precision::single ? full_turn : 10 * angle);
  rows.push_back({fmt::format("led, {}, {} steps", to_string(form), steps), setting.name(),
                  "largest force on a particle / (E·A)", 0, 14 * (0.3 * slip + walk),
                  "no force but from the chord and arc of a step, turn·θ²/24 × α in some 14 contacts, and rounding",
                  force / (3e10 * area)});
}

/// Lets a free assembly rotate once. The assembly stretches by ρω²R²/E and oscillates about the stretched state.
void spun(Rows& rows, const Setting& setting, std::int64_t steps) {
  const test::TestScene scene = free_assembly();
  StepperOptions options;
  options.dt = 0.5 * critical_step(scene.network, scene.laws, scene.inertia, options).dt;
  const auto stepper = make(setting, scene, options);
  const double rate = full_turn / (static_cast<double>(steps) * options.dt);
  const Vec3d centre = centre_of_mass(scene), axis = principal_axis(scene, centre);
  const std::size_t n = scene.specimen.size();
  std::vector<Vec3d> velocity(n);
  // the velocity is the chord from the initial position to the position after one step
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3d x = scene.specimen.centre[i] - centre;
    velocity[i] = (1 / options.dt) * (turned(x, rate * options.dt, axis) - x);
  }
  stepper->set_velocities(velocity, std::vector<Vec3d>(n, rate * axis));
  const ParticleState before = stepper->particles();
  const double energy = kinetic_energy(scene, before);
  stepper->advance(steps);
  const ParticleState after = stepper->particles();

  const double radius = norm(scene.specimen.box.size) / 2;
  const double strain = 2630 * rate * rate * radius * radius / 3e10;  // centrifugal strain at the farthest point
  const double angle = full_turn / static_cast<double>(steps);
  const double walk = setting.rounding() * extent(scene) * std::sqrt(static_cast<double>(steps));
  const double rounding = setting.precision == Precision::single ? full_turn * walk : 10 * walk;
  const std::string name = fmt::format("spun, {} steps, centrifugal strain {:.1e}", steps, strain);
  rows.push_back({name, setting.name(), "largest displacement after the turn / half the box's diagonal", 0,
                  2 * full_turn * 2 * strain + full_turn * angle * angle + rounding,
                  "it comes back, late by the strain: inertia grows by twice it, twice that while it swings",
                  test::largest(after.displacement) / radius});
  rows.push_back({name, setting.name(), "kinetic energy / initial kinetic energy − 1", -4 * strain - rounding,
                  4 * strain + rounding, "what stretches it is taken from the motion: of the order of the strain",
                  kinetic_energy(scene, after) / energy - 1});
  // Velocities belong to the middle of a step, positions to its end. Both angular momenta are computed with the
  // positions at the end of the step, so both have the same error.
  const Momenta first = momenta(scene, before), last = momenta(scene, after, true);
  rows.push_back({name, setting.name(), "angular momentum gained, relative", 0,
                  2 * setting.rounding() * std::sqrt(static_cast<double>(steps * static_cast<std::int64_t>(n))),
                  "every contact's forces and moments balance: rounding alone",
                  norm(last.angular - first.angular) / norm(first.angular)});
}

}  // namespace

Rows rigid_turn(Effort effort) {
  Rows rows;
  const auto steps = by_effort<std::int64_t>(effort, 5000, 20000, 200000);
  for (const Setting& setting : settings()) {
    for (const ContactForm form : {ContactForm::condensed, ContactForm::points}) led(rows, setting, form, steps);
    spun(rows, setting, steps);
  }
  return rows;
}

}  // namespace macadam::stability
