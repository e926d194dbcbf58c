// SPDX-License-Identifier: GPL-3.0-or-later
// conservation_test.cpp  Tests free assemblies on every backend: momenta and energy are conserved, and rigid motion
// causes no force.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numbers>
#include <tuple>

#include "tests/support/stepper_cases.hpp"

namespace macadam::test {
namespace {

constexpr double rounding = 0x1p-53;

/// Returns 27 particles without walls.
TestScene free_assembly(unsigned seed, const Laws& laws) {
  NetworkSpec spec;
  spec.bottom_top_walls = false;
  return make_scene(random_specimen(seed, 3, 3, 3), spec, laws);
}

/// Returns elastic laws with the instantaneous moduli of AM1 and with shear stiffness in every pair.
Laws elastic_laws() {
  Laws out;
  const Laws am1 = am1_laws();
  for (std::size_t pair = 0; pair < out.size(); ++pair) {
    out[pair] = laws::Elastic{std::visit([](const auto& law) { return law.instantaneous(); }, *am1[pair]), 0.3};
  }
  return out;
}

struct Motion {
  std::vector<Vec3d> velocity, spin;
};

/// Returns random velocities of up to `speed` in each direction. The spins are such that points on a particle's surface
/// get about the same speed.
Motion random_motion(const TestScene& scene, unsigned seed, double speed) {
  std::mt19937 random(seed);
  const auto component = [&] { return speed * (2 * (static_cast<double>(random()) / 4294967296.0) - 1); };
  Motion out;
  for (const double radius : scene.specimen.radius) {
    out.velocity.push_back({component(), component(), component()});
    out.spin.push_back((1 / radius) * Vec3d{component(), component(), component()});
  }
  return out;
}

struct Momenta {
  Vec3d linear, angular;
};

/// Returns the total momenta. If `displaced`, angular momentum uses the displaced centres, as updated geometry does.
Momenta momenta(const TestScene& scene, const ParticleState& p, bool displaced) {
  Momenta out;
  for (std::size_t i = 0; i < scene.specimen.size(); ++i) {
    const double m = scene.inertia.mass[i];
    const Vec3d& start = scene.specimen.centre[i];
    out.linear += m * p.velocity[i];
    out.angular += m * cross(displaced ? start + p.displacement[i] : start, p.velocity[i]);
    out.angular += scene.inertia.inertia[i] * p.spin[i];
  }
  return out;
}

using Case = std::tuple<Backend, ContactForm, Geometry>;

std::string name_of(const testing::TestParamInfo<Case>& info) {
  const auto& [backend, form, geometry] = info.param;
  return std::string(to_string(backend)) + "_" + to_string(form) + "_" + to_string(geometry);
}

class FreeAssembly : public BackendTest<Case> {
 protected:
  StepperOptions options(const TestScene& scene) const {
    StepperOptions out;
    std::tie(std::ignore, out.form, out.geometry) = GetParam();
    out.dt = 0.8 * critical_step(scene.network, scene.laws, scene.inertia, out).dt;
    out.threads = 1;
    return out;
  }
  std::unique_ptr<Stepper> make(const TestScene& scene, const StepperOptions& options) const {
    return make_stepper(backend(), scene.specimen, scene.network, scene.laws, scene.inertia, options);
  }
};

INSTANTIATE_TEST_SUITE_P(All, FreeAssembly,
                         testing::Combine(all_backends(), testing::Values(ContactForm::condensed, ContactForm::points),
                                          testing::Values(Geometry::updated, Geometry::fixed)),
                         name_of);

// Leapfrog conserves linear and angular momentum exactly if the forces and moments of every contact balance. The
// angular momentum Σ x × m·v changes by Σ x × F alone, because x moves along v.
TEST_P(FreeAssembly, MomentaStayOverAHundredThousandSteps) {
  const std::int64_t steps = long_tests ? 100'000 : 5'000;
  const bool displaced = std::get<Geometry>(GetParam()) == Geometry::updated;
  for (const Laws& laws : {am1_laws(), elastic_laws()}) {
    const TestScene scene = free_assembly(21, laws);
    const double speed = 0.05;
    const Motion motion = random_motion(scene, 22, speed);
    const auto stepper = make(scene, options(scene));
    stepper->set_velocities(motion.velocity, motion.spin);
    const Momenta before = momenta(scene, stepper->particles(), displaced);
    stepper->advance(steps);
    const ParticleState state = stepper->particles();
    ASSERT_EQ(stepper->first_divergent(), -1);
    ASSERT_GT(largest(state.force), 0);
    const Momenta after = momenta(scene, state, displaced);

    // A step rounds the velocity of each of n particles by up to ε·v, and the increments Δt·F/m, which are at most v,
    // by about the same. The errors add up as a random walk of 2·ε·√(steps·n) times the momentum of a particle.
    const double particle = speed * *std::max_element(scene.inertia.mass.begin(), scene.inertia.mass.end());
    const double walk = 2 * rounding * std::sqrt(static_cast<double>(steps * scene.specimen.size()));
    EXPECT_LT(norm(after.linear - before.linear), walk * particle);
    EXPECT_LT(norm(after.angular - before.angular), walk * particle * norm(scene.specimen.box.size));
    EXPECT_GT(norm(before.linear), 0.5 * particle);  // the momentum is not small, so its conservation is not trivial
    EXPECT_GT(norm(before.angular), 0.5 * particle * 1e-3);
  }
}

/// Subtracts the rigid part of a motion, so that the assembly neither drifts nor rotates.
void remove_rigid_part(const TestScene& scene, Motion& motion) {
  Vec3d centre{};
  double mass = 0;
  for (std::size_t i = 0; i < scene.specimen.size(); ++i) {
    centre += scene.inertia.mass[i] * scene.specimen.centre[i];
    mass += scene.inertia.mass[i];
  }
  centre = (1 / mass) * centre;
  Vec3d drift{}, angular{};
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < scene.specimen.size(); ++i) {
    const double m = scene.inertia.mass[i], own = scene.inertia.inertia[i];
    const Vec3d x = scene.specimen.centre[i] - centre;
    const Eigen::Vector3d e(x.x, x.y, x.z);
    inertia += (m * e.squaredNorm() + own) * Eigen::Matrix3d::Identity() - m * e * e.transpose();
    drift += (m / mass) * motion.velocity[i];
    angular += m * cross(x, motion.velocity[i]) + own * motion.spin[i];
  }
  const Eigen::Vector3d w = inertia.ldlt().solve(Eigen::Vector3d(angular.x, angular.y, angular.z));
  const Vec3d turn{w.x(), w.y(), w.z()};
  for (std::size_t i = 0; i < scene.specimen.size(); ++i) {
    motion.velocity[i] -= drift + cross(turn, scene.specimen.centre[i] - centre);
    motion.spin[i] -= turn;
  }
}

// For forces F = −K·q with a symmetric K, leapfrog conserves ½·v(k−½)·M·v(k+½) − ½·q(k)·F(k) exactly. Here q are
// displacements and rotations, and the second term is the elastic energy at the whole step.
TEST_P(FreeAssembly, EnergyOfElasticContactsStays) {
  const int steps = long_tests ? 20'000 : 2'000;
  const TestScene scene = free_assembly(31, elastic_laws());
  const double speed = 1e-3;
  Motion motion = random_motion(scene, 32, speed);
  remove_rigid_part(scene, motion);
  const StepperOptions options = this->options(scene);
  const auto stepper = make(scene, options);
  stepper->set_velocities(motion.velocity, motion.spin);
  stepper->advance(1);

  const std::size_t n = scene.specimen.size();
  std::vector<Vec3d> rotation(n);
  ParticleState now = stepper->particles();
  double first = 0, error = 0, elastic_share = 0, strain = 0;
  for (int k = 0; k < steps; ++k) {
    stepper->advance(1);
    const ParticleState next = stepper->particles();
    double kinetic = 0, elastic = 0;
    for (std::size_t i = 0; i < n; ++i) {
      rotation[i] += options.dt * now.spin[i];
      kinetic += 0.5 * scene.inertia.mass[i] * dot(now.velocity[i], next.velocity[i]);
      kinetic += 0.5 * scene.inertia.inertia[i] * dot(now.spin[i], next.spin[i]);
      elastic -= 0.5 * (dot(now.displacement[i], now.force[i]) + dot(rotation[i], now.moment[i]));
      strain = std::max(strain, norm(now.displacement[i]) / scene.specimen.radius[i]);
    }
    if (k == 0) first = kinetic + elastic;
    error = std::max(error, std::abs((kinetic + elastic) / first - 1));
    elastic_share = std::max(elastic_share, elastic / first);
    now = next;
  }
  // a large fraction of the energy was elastic, so kinetic and elastic energy are exchanged
  EXPECT_GT(elastic_share, 0.3);
  // With fixed geometry the motion is linear: each step rounds by a few ε of the energy, and the errors add up as a
  // random walk. Updated geometry rotates normals and lever arms by angles of about the strain, 1e-6. This changes the
  // stiffness and the energy by a similar fraction.
  EXPECT_LT(error, options.geometry == Geometry::fixed ? 10 * rounding * std::sqrt(steps) : 10 * strain);
}

/// An assembly that moves rigidly, as prescribed for each step, has no contact forces. Particles cannot be fixed here,
/// because all move. Instead their masses are so large that forces do not change their motion.
class RigidMotion : public FreeAssembly {
 protected:
  TestScene heavy_assembly() const {
    TestScene scene = free_assembly(41, elastic_laws());
    scene.inertia.mass.assign(scene.specimen.size(), 1e30);
    scene.inertia.inertia.assign(scene.specimen.size(), 1e30);
    return scene;
  }

  /// Returns the largest E·A over all contacts, the force at a strain of one [N].
  static double force_scale(const TestScene& scene) {
    double area = 0;
    for (const Contact& c : scene.network.contacts) area = std::max(area, c.area);
    return 1.151e11 * area;
  }
};

INSTANTIATE_TEST_SUITE_P(All, RigidMotion,
                         testing::Combine(all_backends(), testing::Values(ContactForm::condensed, ContactForm::points),
                                          testing::Values(Geometry::updated)),
                         name_of);

TEST_P(RigidMotion, TranslationCreatesNoForce) {
  const TestScene scene = heavy_assembly();
  StepperOptions options = this->options(scene);
  options.dt = 1e-6;
  const auto stepper = make(scene, options);
  const std::size_t n = scene.specimen.size();
  stepper->set_velocities(std::vector<Vec3d>(n, {3, -5, 7}), std::vector<Vec3d>(n));
  stepper->advance(10'000);
  ASSERT_GT(norm(stepper->particles().displacement[0]), 0.05);  // a distance of about twenty diameters
  // All displacements are the same to the last bit, so their differences are zero.
  EXPECT_EQ(largest(stepper->particles().force), 0);
  EXPECT_EQ(largest(stepper->particles().moment), 0);
}

TEST_P(RigidMotion, AFullTurnCreatesNoForce) {
  constexpr int steps = 20'000;
  constexpr double angle = 2 * std::numbers::pi, step_angle = angle / steps;
  const TestScene scene = heavy_assembly();
  StepperOptions options = this->options(scene);
  options.dt = 1e-6;
  const auto stepper = make(scene, options);
  const double root = std::sqrt(14.0);
  const Vec3d axis{1 / root, -2 / root, 3 / root}, middle = 0.5 * scene.specimen.box.size;
  const auto turned = [&](const Vec3d& v, double by) {  // Rodrigues' formula
    return std::cos(by) * v + std::sin(by) * cross(axis, v) + (1 - std::cos(by)) * dot(axis, v) * axis;
  };
  const std::size_t n = scene.specimen.size();
  std::vector<Vec3d> velocity(n);
  const std::vector<Vec3d> spin(n, (step_angle / options.dt) * axis);
  double force = 0, moment = 0;
  for (int k = 0; k < steps; ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3d x = scene.specimen.centre[i] - middle;
      velocity[i] = (1 / options.dt) * (turned(x, (k + 1) * step_angle) - turned(x, k * step_angle));
    }
    stepper->set_velocities(velocity, spin);
    stepper->advance(1);
    if (k % 1000 == 999) {
      force = std::max(force, largest(stepper->particles().force));
      moment = std::max(moment, largest(stepper->particles().moment));
    }
  }
  const ParticleState end = stepper->particles();
  ASSERT_LT(largest(end.displacement), 1e-12);  // it is back at the start
  // In a step the particles rotate by θ, but their centres move along the chord 2·sin(θ/2)·d, which is shorter than the
  // arc. This causes a slip of d·θ³/24 per step. Over all steps the slip is a strain of angle·θ²/24 = 2.6e-8. A contact
  // has the force of this strain times α = 0.3. A particle has about fourteen contacts, in many directions.
  const double strain = angle * step_angle * step_angle / 24;
  EXPECT_LT(force, 14 * 0.3 * strain * force_scale(scene));
  EXPECT_LT(moment, 14 * 0.3 * strain * force_scale(scene) * 1.5e-3);  // lever arms of up to 1.5 mm
}

}  // namespace
}  // namespace macadam::test
