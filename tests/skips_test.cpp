// SPDX-License-Identifier: GPL-3.0-or-later
// skips_test.cpp  What a step leaves out changes nothing: the same bits, or as little as is said.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "general_laws.hpp"
#include "stepper_cases.hpp"

namespace macadam::test {
namespace {

using Case = std::tuple<Backend, Precision, ContactForm>;

class Skips : public BackendTest<Case> {
 protected:
  ParticleState shaken(const TestScene& scene, const Laws& laws, StepperOptions options) const {
    std::tie(std::ignore, options.precision, options.form) = GetParam();
    const auto stepper = make_stepper(backend(), scene.specimen, scene.network, laws, scene.inertia, options);
    stepper->advance(500);
    return stepper->particles();
  }
  static double difference(const ParticleState& a, const ParticleState& b) {
    return std::max(relative_difference(a.displacement, b.displacement), relative_difference(a.velocity, b.velocity));
  }
  /// Of 500 steps: of 6e-8 each where the geometry is single, and some times more where the states are too.
  double rounding() const {
    return std::get<Precision>(GetParam()) == Precision::double_ ? 1e-11
           : std::get<Precision>(GetParam()) == Precision::mixed ? 3e-5
                                                                 : 2e-4;
  }
};

INSTANTIATE_TEST_SUITE_P(All, Skips,
                         testing::Combine(all_backends(),
                                          testing::Values(Precision::double_, Precision::mixed, Precision::single),
                                          testing::Values(ContactForm::condensed, ContactForm::points)),
                         [](const auto& info) { return name_of_case(info); });

Laws elastic_laws() {
  Laws laws;
  for (std::size_t pair = 0; pair < pair_types; ++pair) laws[pair] = laws::Elastic{1e10 * (1.0 + double(pair)), 0.1};
  return laws;
}

// Units that are not there against units that never move.
TEST_P(Skips, KelvinUnitsThatAreAbsent) {
  const TestScene scene = make_scene(random_specimen(21));
  StepperOptions options = shaking_options(scene);
  options.geometry = Geometry::updated;
  const Laws laws = elastic_laws();
  // the same sums, but a compiler may round a product and a sum at once in one of them
  EXPECT_LT(difference(shaken(scene, laws, options), shaken(scene, general_laws(laws, 3), options)), rounding());
}

TEST_P(Skips, ShearWhereAlphaIsZero) {
  const TestScene scene = make_scene(random_specimen(22));  // its walls have none
  StepperOptions options = shaking_options(scene);
  for (const Geometry geometry : {Geometry::updated, Geometry::fixed}) {
    options.geometry = geometry;
    options.skip_shear = true;
    const ParticleState with = shaken(scene, scene.laws, options);
    options.skip_shear = false;
    EXPECT_EQ(difference(with, shaken(scene, scene.laws, options)), 0) << to_string(geometry);
  }
}

// f = E·x of the displacements of now, against f summed over the steps.
TEST_P(Skips, StatesOfElasticContacts) {
  const TestScene scene = make_scene(random_specimen(23));
  StepperOptions options = shaking_options(scene);
  options.geometry = Geometry::fixed;
  for (const Laws& laws : {elastic_laws(), scene.laws}) {
    EXPECT_LT(difference(shaken(scene, laws, options), shaken(scene, general_laws(laws, 0), options)), rounding());
  }
}

/// Equal spheres on a cubic lattice: every facet is centred.
Specimen lattice() {
  Specimen out;
  out.box.size = {0.006, 0.006, 0.01};
  for (int k = 0; k < 45; ++k)
    out.centre.push_back({1e-3 + 2e-3 * (k % 3), 1e-3 + 2e-3 * (k / 3 % 3), 1e-3 + 2e-3 * (k / 9)});
  out.radius.assign(45, 1.1e-3);
  out.phase.assign(45, Phase::mastic);
  out.body.assign(45, -1);
  return out;
}

TEST_P(Skips, RotationsThatNothingExcites) {
  Laws laws = am1_laws();
  std::get<laws::GeneralisedKelvin>(*laws[int(PairType::mm)]).alpha = 0;
  const TestScene scene = make_scene(lattice(), {}, laws);
  ASSERT_TRUE(nothing_turns(scene.network, laws));
  StepperOptions options = shaking_options(scene);
  for (const Geometry geometry : {Geometry::updated, Geometry::fixed}) {
    options.geometry = geometry;
    options.skip_rotations = true;
    const ParticleState without = shaken(scene, laws, options);
    options.skip_rotations = false;
    // moments of rounding turn the particles by as little
    EXPECT_LT(difference(without, shaken(scene, laws, options)), rounding()) << to_string(geometry);
    EXPECT_EQ(largest(without.spin), 0);
  }
}

TEST(NothingTurns, OnlyWithoutShearAndWithCentredFacets) {
  Laws laws = am1_laws();
  EXPECT_FALSE(nothing_turns(make_scene(lattice()).network, laws));  // shear
  std::get<laws::GeneralisedKelvin>(*laws[int(PairType::mm)]).alpha = 0;
  EXPECT_TRUE(nothing_turns(make_scene(lattice()).network, laws));
  Specimen moved = lattice();
  moved.centre[22].x += 1e-5;
  EXPECT_FALSE(nothing_turns(make_scene(moved).network, laws));
}

TEST(NothingTurns, ASpinIsRefusedWhereRotationsAreSkipped) {
  Laws laws = same_law(laws::Elastic{1e10, 0});
  const TestScene scene = make_scene(lattice(), {}, laws);
  StepperOptions options = shaking_options(scene);
  const std::vector<Vec3d> still(45), spin(45, {1, 0, 0});
  const auto skipping = make_stepper(Backend::cpu, scene.specimen, scene.network, laws, scene.inertia, options);
  EXPECT_NO_THROW(skipping->set_velocities(still, still));
  EXPECT_THROW(skipping->set_velocities(still, spin), InputError);
  options.skip_rotations = false;
  EXPECT_NO_THROW(make_stepper(Backend::cpu, scene.specimen, scene.network, laws, scene.inertia, options)
                      ->set_velocities(still, spin));
}

/// Tiny facets carry about what their area says, the smaller the truer: the effect that the program states.
TEST(TinyFacets, TheirShareOfTheAreaIsTheOrderOfTheirStiffness) {
  const Specimen specimen = read_specimen_csv(MACADAM_TEST_DATA "/t8.csv", {{0.008, 0.008, 0.011}});
  const auto modulus = [](const TestScene& scene) {
    return Harmonic(scene.specimen, scene.network, scene.laws, scene.inertia, {}, 20).solve(20, 0).top.e_star_pa;
  };
  const double whole = modulus(make_scene(specimen));
  for (const double area_min : {0.001, 0.01, 0.026, 0.1}) {
    NetworkSpec spec;
    spec.area_min = area_min;
    const TestScene scene = make_scene(specimen, spec);
    ASSERT_GT(scene.network.dropped_area, 0);
    const double ratio = (1 - modulus(scene) / whole) / scene.network.dropped_share;
    fmt::print("area_min {}: share {:.1e}, loss of |E*| over it {:.2f}\n", area_min, scene.network.dropped_share,
               ratio);
    EXPECT_GT(ratio, 0.3);
    EXPECT_LT(ratio, 3);
  }
}

// One point a facet: three chains there against six on the facet.
TEST(OnePoint, PointsAndCondensedAgree) {
  NetworkSpec spec;
  spec.quadrature = Quadrature::one_point;
  const TestScene scene = make_scene(random_specimen(24), spec);
  EXPECT_EQ(scene.network.point_area.size(), scene.network.contacts.size());
  for (const Contact& c : scene.network.contacts) ASSERT_EQ(c.moments.a, c.area);
  StepperOptions options = shaking_options(scene);
  std::vector<ParticleState> states;
  for (const Backend backend : {Backend::reference, Backend::cpu}) {
    for (const ContactForm form : {ContactForm::points, ContactForm::condensed}) {
      options.form = form;
      const auto stepper = make_stepper(backend, scene.specimen, scene.network, scene.laws, scene.inertia, options);
      stepper->advance(500);
      states.push_back(stepper->particles());
    }
  }
  for (const ParticleState& state : states) {
    EXPECT_LT(relative_difference(state.velocity, states[0].velocity), 1e-10);
  }
}

}  // namespace
}  // namespace macadam::test
