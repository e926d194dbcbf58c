// SPDX-License-Identifier: GPL-3.0-or-later
// series_test.cpp  Tests the time step of contacts whose law has its own length and rock in series (Contact::length,
// Contact::series): against the reference stepper, which adds the compliances of the two springs, and against closed
// forms for a single contact.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <tuple>

#include "kernels/step/block_length.hpp"
#include "macadam/error.hpp"
#include "tests/support/stepper_cases.hpp"

namespace macadam::test {
namespace {

constexpr double rock = 4e10;  // modulus of the rock [Pa]

/// Gives every contact a law that fills a random part of the distance, and rock in the remainder. A tenth of the
/// contacts has no rock.
void put_rock_in_series(ContactNetwork& network, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(0.05, 1);
  for (Contact& c : network.contacts) {
    const bool none = random() % 10 == 0;
    c.length = (none ? 1 : part(random)) * c.distance;
    c.series = (c.distance - c.length) / (c.length * rock);
  }
}

/// Returns laws with a shear stiffness of 0.23 or 1 times the normal one.
Laws stiff_in_shear(Laws laws) {
  for (std::size_t pair = 0; pair < pair_types; ++pair)
    std::visit([&](auto& law) { law.alpha = pair % 2 == 0 ? 0.23 : 1; }, *laws[pair]);
  return laws;
}

TestScene scene_with_rock(unsigned seed, const Laws& laws = am1_laws()) {
  TestScene out = make_scene(random_specimen(seed, 6, 6, 7), {}, stiff_in_shear(laws));
  put_rock_in_series(out.network, seed + 1);
  return out;
}

class StepperWithRockInSeries : public BackendTest<StepperCase> {
 protected:
  StepperOptions chosen(StepperOptions options) const {
    options.precision = std::get<Precision>(GetParam());
    options.form = std::get<ContactForm>(GetParam());
    options.geometry = std::get<Geometry>(GetParam());
    return options;
  }
  std::unique_ptr<Stepper> stepper(const TestScene& scene, const StepperOptions& options,
                                   std::unique_ptr<Stepper> used = nullptr) const {
    return make_stepper(backend(), scene.specimen, scene.network, scene.laws, scene.inertia, options, std::move(used));
  }

  /// Compares the motions of all particles with the reference.
  void compare(const TestScene& scene, const StepperOptions& options, std::int64_t steps) const {
    StepperOptions exact = options;
    exact.precision = Precision::double_;
    const auto reference =
        make_stepper(Backend::reference, scene.specimen, scene.network, scene.laws, scene.inertia, exact);
    const auto tested = stepper(scene, options);
    reference->advance(steps);
    tested->advance(steps / 3);
    tested->advance(steps - steps / 3);
    // as in stepper_test.cpp: rounding of the geometry changes the phase of a mode
    const double rounding = options.precision == Precision::double_ ? 100 * 0x1p-53 : 10 * 0x1p-24;
    const double tolerance = rounding * static_cast<double>(std::max<std::int64_t>(steps, 100));
    const ParticleState expected = reference->particles(), found = tested->particles();
    EXPECT_LT(relative_difference(found.displacement, expected.displacement), tolerance);
    EXPECT_LT(relative_difference(found.velocity, expected.velocity), tolerance);
    EXPECT_LT(relative_difference(found.spin, expected.spin), tolerance);
    EXPECT_LT(relative_difference(found.force, expected.force), tolerance);
    EXPECT_LT(relative_difference(found.moment, expected.moment), tolerance);
    expect_forces_of_contacts(scene, *tested, tolerance);
  }

  /// Expects that a device steps condensed contacts in mixed or single precision in tiles.
  void expect_tiles(const TestScene& scene, const StepperOptions& options, const char* way) const {
    if (options.form == ContactForm::points || options.precision == Precision::double_) return;
    const std::string description = stepper(scene, options)->description();
    EXPECT_NE(description.find(way), std::string::npos) << description;
  }

  /// Expects that the forces of the contacts that a stepper reports add up to the forces on the particles.
  static void expect_forces_of_contacts(const TestScene& scene, const Stepper& stepper, double tolerance) {
    const ContactState contacts = stepper.contacts(scene.network);
    std::vector<Vec3d> sum(scene.specimen.size());
    for (std::size_t c = 0; c < scene.network.contacts.size(); ++c) {
      const Contact& contact = scene.network.contacts[c];
      sum[static_cast<std::size_t>(contact.a)] += contacts.force[c];
      if (contact.b >= 0) sum[static_cast<std::size_t>(contact.b)] += -contacts.force[c];
    }
    EXPECT_LT(relative_difference(sum, stepper.particles().force), tolerance);
  }
};

TEST_P(StepperWithRockInSeries, AgreesWithTheReference) {
  const unsigned seed = test_seed() + 30;
  for (const Laws& laws : {am1_laws(), elastic_laws()}) {
    const TestScene scene = scene_with_rock(seed, laws);
    compare(scene, chosen(shaking_options(scene)), long_tests ? 600 : 100);
  }
}

/// Mixed and single precision take these steps in blocks.
TEST_P(StepperWithRockInSeries, AgreesWithTheReferenceUnderSlowLoad) {
  const unsigned seed = test_seed() + 40;
  for (const Laws& laws : {am1_laws(), elastic_laws()}) {
    const TestScene scene = scene_with_rock(seed, laws);
    const StepperOptions options = chosen(slow_options(scene));
    EXPECT_GE(kernels::block_steps(options, facts_of(scene.laws), scene.specimen.box.size), 16);
    compare(scene, options, long_tests ? 600 : 100);
    if (backend() == Backend::cuda) expect_tiles(scene, options, "tiles");
  }
}

/// Tiles of a specimen that is too large for the multiprocessors that it may use are read from memory in every step.
TEST_P(StepperWithRockInSeries, IsSteppedInStreamedTilesToo) {
  if (backend() != Backend::cuda) return;  // the CPU has one way to step a specimen
  TestScene scene = make_scene(random_specimen(test_seed() + 80, 14, 14, 16), {}, stiff_in_shear(am1_laws()));
  put_rock_in_series(scene.network, test_seed() + 81);
  StepperOptions options = chosen(slow_options(scene));
  options.multiprocessors = 1;
  compare(scene, options, 60);
  expect_tiles(scene, options, "tiles streamed");
}

TEST_P(StepperWithRockInSeries, TakesLawsOfAnyNumberOfUnits) {
  Laws laws = am1_laws();
  laws[static_cast<std::size_t>(PairType::mm)] = laws::GeneralisedKelvin{1e10, INFINITY, {}, {}, 0.2};
  laws[static_cast<std::size_t>(PairType::ma)] =
      laws::GeneralisedKelvin{2e10, 1e6, {1e9, 2e9, 3e9, 4e9, 5e9}, {1e6, 1e5, 1e4, 1e3, 1e7}, 0.1};
  laws[static_cast<std::size_t>(PairType::aa)] =
      laws::GeneralisedKelvin{3e10, 1e9, {1e9, 2e9, 3e9, 4e9, 5e9, 6e9, 7e9}, {1e6, 1e5, 1e4, 1e3, 1e7, 1e8, 1e9}, 0.0};
  const TestScene scene = scene_with_rock(test_seed() + 50, laws);
  compare(scene, chosen(shaking_options(scene)), long_tests ? 300 : 100);
}

/// The factors of rock in series depend on the time step and on the law, so a stepper that is used again computes them
/// again.
TEST_P(StepperWithRockInSeries, MayBeUsedAgainWithAnotherTimeStep) {
  const TestScene scene = scene_with_rock(test_seed() + 60);
  const StepperOptions options = chosen(slow_options(scene));
  drives::Cyclic loading = top_drive(options);
  loading.steps_per_period *= 2;
  StepperOptions shorter = options;
  shorter.boundary = moving_top(loading);
  shorter.dt = loading.dt();
  const auto fresh = stepper(scene, shorter);
  auto again = stepper(scene, options);
  again->advance(70);
  again = stepper(scene, shorter, std::move(again));
  fresh->advance(70);
  again->advance(70);
  const ParticleState expected = fresh->particles(), found = again->particles();
  for (std::size_t i = 0; i < scene.specimen.size(); ++i) {
    ASSERT_EQ(found.force[i].x, expected.force[i].x);
    ASSERT_EQ(found.velocity[i].z, expected.velocity[i].z);
  }
}

/// A compliance that is too small to matter gives the result of a network without rock; the code that steps contacts
/// with rock computes it.
TEST_P(StepperWithRockInSeries, OfNoComplianceStepsLikeNone) {
  TestScene scene = make_scene(random_specimen(test_seed() + 70), {}, stiff_in_shear(am1_laws()));
  const StepperOptions options = chosen(slow_options(scene));
  const auto without = stepper(scene, options);
  for (Contact& c : scene.network.contacts) c.series = 1e-35;  // times 1e11 Pa: far below the rounding of 1
  const auto with = stepper(scene, options);
  without->advance(100);
  with->advance(100);
  const double tolerance = 100 * (options.precision == Precision::double_ ? 0x1p-53 : 0x1p-24);
  EXPECT_LT(relative_difference(with->particles().velocity, without->particles().velocity), tolerance);
  EXPECT_LT(relative_difference(with->particles().force, without->particles().force), tolerance);
}

/// Particle B of a pair opens and slips at constant velocity v. The force of a spring k is k·v·t, and the force of a
/// Maxwell unit is C·v·(1 − exp(−k·t/C)), where k is the stiffness of the law's spring in series with the rock.
TEST_P(StepperWithRockInSeries, FollowsTheClosedFormOfASingleContact) {
  PairShape shape;
  shape.mass_a = shape.mass_b = 1e15;  // the forces do not change the velocities
  HandMade made = two_sphere_network(shape);
  Contact& c = made.network.contacts[0];
  c.length = 0.3 * c.distance;
  c.series = (c.distance - c.length) / (c.length * rock);
  const double E = 1e10, C = 1e9, v = 1e-9, time = 2 * C / E, scale = c.area / c.length;
  const std::int64_t steps = 1000;
  // of the trapezoidal rule: (Δt·k/C)²/12 = 3e-7
  const double tolerance = std::get<Precision>(GetParam()) == Precision::double_ ? 1e-6 : 1e-4;
  for (const double alpha : {0.23, 1.0}) {
    const double normal = 1 / (1 / E + c.series), shear = 1 / (1 / (alpha * E) + c.series);  // k/(1 + r·k)
    for (const bool flows : {false, true}) {
      StepperOptions options = chosen({});
      options.dt = time / static_cast<double>(steps);
      const Law law = flows ? Law(laws::GeneralisedKelvin{E, C, {}, {}, alpha}) : Law(laws::Elastic{E, alpha});
      const auto stepper = make_stepper(backend(), made.specimen, made.network, same_law(law), made.inertia, options);
      stepper->set_velocities({{}, {v, 0, v}}, {{}, {}});
      stepper->advance(steps);
      const auto force = [&](double k, double viscosity) {
        return scale * v * (flows ? viscosity * -std::expm1(-k * time / viscosity) : k * time);
      };
      const Vec3d found = stepper->particles().force[0];
      EXPECT_NEAR(found.z / force(normal, C), 1, tolerance) << "alpha " << alpha << ", flows: " << flows;
      EXPECT_NEAR(found.x / force(shear, alpha * C), 1, tolerance) << "alpha " << alpha << ", flows: " << flows;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, StepperWithRockInSeries, all_stepper_cases(),
                         [](const auto& info) { return name_of_case(info); });

TEST(RockInSeries, IsRefusedForALawThatIsNotLinear) {
  HandMade made = two_sphere_network();
  StepperOptions options;
  options.dt = 1e-8;
  options.form = ContactForm::points;
  const auto message = [&](Backend backend) -> std::string {
    try {
      make_stepper(backend, made.specimen, made.network, same_law(laws::BrittleBond{1e9, 1e6}), made.inertia, options);
    } catch (const InputError& error) { return error.what(); }
    return "taken";
  };
  for (const Backend backend : {Backend::cpu, Backend::reference}) {
    EXPECT_EQ(message(backend), "taken");
    made.network.contacts[0].series = 1e-11;
    EXPECT_NE(message(backend).find("contact 0 of pair M-M: compliance of the rock in series: found 1e-11 1/Pa"),
              std::string::npos)
        << message(backend);
    made.network.contacts[0].series = 0;
    made.network.contacts[0].length /= 2;
    EXPECT_NE(message(backend).find("brittle_bond is not linear"), std::string::npos) << message(backend);
    made.network.contacts[0].length = made.network.contacts[0].distance;
  }
}

/// A law whose advance() has no factor.
struct WithoutFactor : laws::Elastic {
  template <class R>
  struct Step {
    static constexpr bool memoryless = false;
    R E;
    template <int L, class S, class Units>
    S advance(S f, S dx, Units&&) const {
      return f + S(E) * dx;
    }
    R step_stiffness() const { return E; }
  };
  template <class R>
  Step<R> step(double) const {
    return {static_cast<R>(E)};
  }
};
static_assert(laws::SteppableLaw<WithoutFactor> && !series_law<WithoutFactor>);
static_assert(series_law<laws::Elastic> && series_law<laws::GeneralisedKelvin> && !series_law<laws::BrittleBond>);

TEST(RockInSeries, ShortensTheCriticalStepByLengthAndLengthensItByCompliance) {
  HandMade made = two_sphere_network();
  const Laws laws = same_law(laws::Elastic{1e10, 0.23});
  const auto limit = [&] { return critical_step(made.network, laws, made.inertia, {}).dt; };
  const double plain = limit();
  Contact& c = made.network.contacts[0];
  c.length /= 4;
  EXPECT_NEAR(limit(), plain / 2, 1e-12 * plain);
  c.series = 3 / 1e10;  // k/(1 + 3) along the normal, α·k/(1 + 3·α) in shear
  EXPECT_GT(limit(), plain / 2);
}

}  // namespace
}  // namespace macadam::test
