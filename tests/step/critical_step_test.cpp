// SPDX-License-Identifier: GPL-3.0-or-later
// critical_step_test.cpp  Compares the computed critical time step with the true stability limit 2/ω_max. The computed
// step must not exceed the limit, and must be at least the limit divided by √2.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <limits>
#include <numbers>
#include <tuple>

#include "host/reference/reference_spectrum.hpp"
#include "tests/support/stepper_cases.hpp"

namespace macadam::test {
namespace {

double true_limit(const TestScene& scene) {
  return 2 / reference_largest_frequency(scene.network, scene.laws, scene.inertia);
}

double computed_limit(const TestScene& scene, const StepperOptions& options = {}) {
  return critical_step(scene.network, scene.laws, scene.inertia, options).dt;
}

Laws elastic_laws() { return same_law(laws::Elastic{3e10, 0.3}); }

/// Returns the same contacts with other points: the midpoints of the sides of every triangle of the fan, each with a
/// third of the triangle's area. This quadrature is exact for second moments, so the stiffnesses of the points equal
/// the stiffnesses of the polygon.
ContactNetwork with_exact_points(const ContactNetwork& network) {
  ContactNetwork out = network;
  out.point_s.clear(), out.point_t.clear(), out.point_area.clear();
  for (Contact& c : out.contacts) {
    const std::uint32_t centroid = c.point_end - 1, begin = c.point_begin;
    c.point_begin = static_cast<std::uint32_t>(out.point_s.size());
    for (std::uint32_t v = begin; v < centroid; ++v) {
      const std::uint32_t corner[3] = {centroid, v, v + 1 < centroid ? v + 1 : begin};
      const double *s = network.point_s.data(), *t = network.point_t.data();
      const double area = 0.5 * ((s[corner[1]] - s[corner[0]]) * (t[corner[2]] - t[corner[0]]) -
                                 (s[corner[2]] - s[corner[0]]) * (t[corner[1]] - t[corner[0]]));
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t p = corner[k], q = corner[(k + 1) % 3];
        out.point_s.push_back(0.5 * (s[p] + s[q]));
        out.point_t.push_back(0.5 * (t[p] + t[q]));
        out.point_area.push_back(area / 3);
      }
    }
    c.point_end = static_cast<std::uint32_t>(out.point_s.size());
  }
  return out;
}

// The energy of a contact is at most twice the sum of two energies, for each of which only one end of the contact
// moves. So ω_max² ≤ 2·max λ(M_i⁻¹·K_ii), and the computed step is safe. Moving only one particle shows that ω_max² ≥
// max λ(M_i⁻¹·K_ii). So the computed step is at least 1/√2 of the true limit.
TEST(CriticalStep, IsBelowTheTrueLimitAndAboveItsRootHalf) {
  const unsigned seed = test_seed() + 99;
  double sum = 0;
  for (unsigned k = 0; k < 10; ++k) {
    SCOPED_TRACE(fmt::format("specimen seed {}", seed + k));
    NetworkSpec spec;
    spec.quadrature = k % 2 == 0 ? Quadrature::lumped : Quadrature::exact;
    spec.lateral_walls = k % 3 == 0;
    TestScene scene = make_scene(random_specimen(seed + k), spec, k < 5 ? am1_laws() : elastic_laws());
    const double computed = computed_limit(scene);
    if (spec.quadrature == Quadrature::exact) scene.network = with_exact_points(scene.network);
    const double share = computed / true_limit(scene);
    // A backward stable eigenvalue solver has a relative error of about n rounding errors in ω_max², the largest of n
    // eigenvalues. The step depends on the square root of ω_max², so its relative error is half of that.
    const double rounding =
        0.5 * static_cast<double>(6 * scene.specimen.size()) * std::numeric_limits<double>::epsilon();
    EXPECT_LE(share, 1 + rounding);
    EXPECT_GE(share, std::sqrt(0.5) * (1 - rounding));
    sum += share;
  }
  fmt::print("computed step over true limit, mean of 10: {:.3f}\n", sum / 10);
}

/// Lumped contact points have larger second moments than the polygon. So their rotational stiffness is larger and the
/// critical step is shorter.
TEST(CriticalStep, LumpedPointsAreStifferThanThePolygon) {
  NetworkSpec exact;
  exact.quadrature = Quadrature::exact;
  EXPECT_LT(computed_limit(make_scene(random_specimen(1))), computed_limit(make_scene(random_specimen(1), exact)));
}

TEST(CriticalStep, ScalesWithDensityAndLocalDamping) {
  const TestScene scene = make_scene(random_specimen(2));
  const double limit = computed_limit(scene);
  StepperOptions options;
  options.density_scaling = 1000;
  EXPECT_NEAR(computed_limit(scene, options) / (std::sqrt(1000.0) * limit), 1, 1e-12);
  options.damping_kind = Damping::local;
  options.damping = 0.3;
  EXPECT_NEAR(computed_limit(scene, options) / (std::sqrt(1000.0 / 1.3) * limit), 1, 1e-12);
}

/// If the mass and inertia of one particle are reduced, this particle limits the step, and the result must name it.
TEST(CriticalStep, NamesTheParticleThatSetsIt) {
  TestScene scene = make_scene(random_specimen(2));
  const double before = computed_limit(scene);
  scene.inertia.mass[17] *= 1e-4;
  scene.inertia.inertia[17] *= 1e-4;
  const CriticalStep step = critical_step(scene.network, scene.laws, scene.inertia, {});
  EXPECT_EQ(step.particle, 17);
  EXPECT_LT(step.dt, 0.1 * before);
}

TEST(Inertia, IsThatOfSolidSpheres) {
  const Specimen specimen = random_specimen(3, 2, 2, 2);
  const Inertia inertia = make_inertia(specimen, 2630, 2110);
  ASSERT_EQ(inertia.mass.size(), specimen.size());
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const double r = specimen.radius[i], density = specimen.phase[i] == Phase::aggregate ? 2630 : 2110;
    const double mass = density * std::numbers::pi * 4 / 3 * r * r * r;
    EXPECT_NEAR(inertia.mass[i] / mass, 1, 1e-15 * 4);
    EXPECT_NEAR(inertia.inertia[i] / (0.4 * mass * r * r), 1, 1e-15 * 4);
  }
}

// Tests steppers near the limit: they must be stable just below the computed step, and unstable above the true limit.

using Case = std::tuple<Backend, ContactForm, Geometry, bool /* AM1, else elastic */, bool /* local damping */>;

class AtTheLimit : public BackendTest<Case> {
 protected:
  TestScene scene_ = make_scene(random_specimen(5), {}, std::get<3>(GetParam()) ? am1_laws() : elastic_laws());

  StepperOptions options() const {
    StepperOptions out;
    out.form = std::get<1>(GetParam());
    out.geometry = std::get<2>(GetParam());
    if (std::get<4>(GetParam())) {
      out.damping_kind = Damping::local;
      out.damping = 0.3;
    }
    out.threads = 1;
    return out;
  }

  /// Returns a stepper in which all particles have random velocities and spins, so that every mode is excited.
  std::unique_ptr<Stepper> shaken(const StepperOptions& options) const {
    auto stepper = make_stepper(backend(), scene_.specimen, scene_.network, scene_.laws, scene_.inertia, options);
    std::mt19937 random(6);
    const auto component = [&] { return 1e-3 * (2 * (static_cast<double>(random()) / 4294967296.0) - 1); };
    std::vector<Vec3d> velocity, spin;
    for (const double radius : scene_.specimen.radius) {
      velocity.push_back({component(), component(), component()});
      spin.push_back((1 / radius) * Vec3d{component(), component(), component()});
    }
    stepper->set_velocities(velocity, spin);
    return stepper;
  }

  double kinetic_energy(const ParticleState& p) const {
    double sum = 0;
    for (std::size_t i = 0; i < p.velocity.size(); ++i) {
      sum += 0.5 * scene_.inertia.mass[i] * dot(p.velocity[i], p.velocity[i]);
      sum += 0.5 * scene_.inertia.inertia[i] * dot(p.spin[i], p.spin[i]);
    }
    return sum;
  }
};

INSTANTIATE_TEST_SUITE_P(All, AtTheLimit,
                         testing::Combine(all_backends(), testing::Values(ContactForm::condensed, ContactForm::points),
                                          testing::Values(Geometry::updated, Geometry::fixed), testing::Bool(),
                                          testing::Bool()),
                         [](const testing::TestParamInfo<Case>& info) {
                           return fmt::format("{}_{}_{}_{}_{}", to_string(std::get<0>(info.param)),
                                              to_string(std::get<1>(info.param)), to_string(std::get<2>(info.param)),
                                              std::get<3>(info.param) ? "am1" : "elastic",
                                              std::get<4>(info.param) ? "damped" : "undamped");
                         });

TEST_P(AtTheLimit, StableJustBelowTheComputedOne) {
  StepperOptions options = this->options();
  options.dt = 0.95 * computed_limit(scene_, options);
  const auto stepper = shaken(options);
  const double start = kinetic_energy(stepper->particles());
  // Leapfrog conserves H = ½·v(k−½)·M·v(k+½) + ½·q·K·q. H is at least the kinetic energy at the half step times 1 −
  // (ω_max·Δt/2)². At the start q = 0, so H is the initial kinetic energy. Dashpots and damping only reduce H. The
  // factor 1.01 allows for the change of geometry.
  const double half_phase = options.dt / true_limit(scene_);
  const double bound = 1.01 * start / (1 - half_phase * half_phase);
  const int steps = long_tests ? 20'000 : 2'000;
  for (int k = 0; k < steps / 100; ++k) {
    stepper->advance(100);
    const double energy = kinetic_energy(stepper->particles());
    ASSERT_LE(energy, bound) << "after " << 100 * (k + 1) << " steps";
  }
  EXPECT_EQ(stepper->first_divergent(), -1);
}

TEST_P(AtTheLimit, BlowsUpAboveTheTrueOneAndNamesAParticle) {
  StepperOptions options = this->options();
  options.dt = 1.02 * true_limit(scene_);
  const auto stepper = shaken(options);
  // Above the limit a mode grows by e^{2·arcosh(1.02)} = 1.49 per step. In about fifty steps its velocity grows from
  // 1e-3 m/s to one radius per step.
  stepper->advance(3000);
  const std::int64_t particle = stepper->first_divergent();
  EXPECT_GE(particle, 0);
  EXPECT_LT(particle, static_cast<std::int64_t>(scene_.specimen.size()));
}

}  // namespace
}  // namespace macadam::test
