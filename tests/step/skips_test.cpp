// SPDX-License-Identifier: GPL-3.0-or-later
// skips_test.cpp  Tests that skipping unnecessary parts of a step does not change the result: the bits are equal, or
// the result is equal to a stated tolerance.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <set>

#include "tests/support/general_laws.hpp"
#include "tests/support/reference_bilinear.hpp"
#include "tests/support/stepper_cases.hpp"

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
  /// Returns the tolerance after 500 steps. If the geometry is in single precision, each step has a rounding error of
  /// 6e-8; if the states are in single precision too, a few times more.
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

// Compares laws without Kelvin units with laws that have Kelvin units which never move.
TEST_P(Skips, KelvinUnitsThatAreAbsent) {
  const TestScene scene = make_scene(random_specimen(21));
  StepperOptions options = shaking_options(scene);
  options.geometry = Geometry::updated;
  const Laws laws = elastic_laws();
  // The summed terms are the same, but in one of the versions the compiler may fuse a product and a sum.
  EXPECT_LT(difference(shaken(scene, laws, options), shaken(scene, general_laws(laws, 3), options)), rounding());
}

TEST_P(Skips, ShearWhereAlphaIsZero) {
  const TestScene scene = make_scene(random_specimen(22));  // the wall contacts of this scene have α = 0
  StepperOptions options = shaking_options(scene);
  for (const Geometry geometry : {Geometry::updated, Geometry::fixed}) {
    options.geometry = geometry;
    options.skip_shear = true;
    const ParticleState with = shaken(scene, scene.laws, options);
    options.skip_shear = false;
    EXPECT_EQ(difference(with, shaken(scene, scene.laws, options)), 0) << to_string(geometry);
  }
}

// Compares forces f = E·x computed from the current displacement x with forces summed over the steps.
TEST_P(Skips, StatesOfElasticContacts) {
  const TestScene scene = make_scene(random_specimen(23));
  StepperOptions options = shaking_options(scene);
  options.geometry = Geometry::fixed;
  for (const Laws& laws : {elastic_laws(), scene.laws}) {
    EXPECT_LT(difference(shaken(scene, laws, options), shaken(scene, general_laws(laws, 0), options)), rounding());
  }
}

/// Returns equal spheres on a cubic lattice, in which the centroid of every facet is on the line of centres.
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
    // If rotations are not skipped, moments from rounding errors rotate the particles slightly.
    EXPECT_LT(difference(without, shaken(scene, laws, options)), rounding()) << to_string(geometry);
    EXPECT_EQ(largest(without.spin), 0);
  }
}

/// nothing_turns() is true only if no contact has shear stiffness and all facets are centred.
TEST(NothingTurns, OnlyWithoutShearAndWithCentredFacets) {
  Laws laws = am1_laws();
  EXPECT_FALSE(nothing_turns(make_scene(lattice()).network, laws));  // has shear stiffness
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

/// Solves the specimen t8 with and without its tiny facets. The parameter is area_min.
class TinyFacets : public testing::TestWithParam<double> {
 protected:
  struct Solved {
    TestScene scene;
    Eigen::VectorXcd motion;
    Complex modulus;
  };
  static Solved solve(const Specimen& specimen, const Laws& laws, std::optional<double> area_min) {
    NetworkSpec spec;
    spec.area_min = area_min;
    Solved out{make_scene(specimen, spec, laws), {}, {}};
    const TestScene& s = out.scene;
    const HarmonicResult r = Harmonic(s.specimen, s.network, s.laws, s.inertia, {}, 20).solve(20);
    out.motion = motion_of(r), out.modulus = complex_of(r.top);
    return out;
  }
  static Specimen t8() { return read_specimen_csv(MACADAM_TEST_DATA "/t8.csv", {{0.008, 0.008, 0.011}}); }
  /// Returns the contacts of `whole` that are missing in `less`.
  static ContactNetwork dropped(const Solved& whole, const Solved& less) {
    std::set<std::pair<std::int32_t, std::int32_t>> kept;
    for (const Contact& c : less.scene.network.contacts) kept.emplace(c.a, c.b);
    ContactNetwork out = whole.scene.network;
    std::erase_if(out.contacts, [&](const Contact& c) { return kept.contains({c.a, c.b}); });
    return out;
  }
};
INSTANTIATE_TEST_SUITE_P(AreaMin, TinyFacets, testing::Values(0.001, 0.01, 0.026, 0.1));

/// The fraction of the area that the network reports as dropped equals the area of the dropped facets over the area of
/// all facets.
TEST_P(TinyFacets, TheShareIsThatOfTheirAreas) {
  const Solved whole = solve(t8(), am1_laws(), std::nullopt), less = solve(t8(), am1_laws(), GetParam());
  const auto area = [](const ContactNetwork& network) {
    double sum = 0;
    for (const Contact& c : network.contacts) sum += c.b >= 0 ? c.area : 0;
    return sum;
  };
  const ContactNetwork gone = dropped(whole, less);
  ASSERT_FALSE(gone.contacts.empty());
  EXPECT_EQ(static_cast<std::int64_t>(gone.contacts.size()), less.scene.network.dropped_area);
  EXPECT_NEAR(less.scene.network.dropped_share / (area(gone) / area(whole.scene.network)), 1,
              1e-12);  // rounding of a sum of a thousand terms
}

/// Computes the loss of modulus by dropped facets in a second way. Let a be the bilinear form of the whole network, d
/// the bilinear form of the dropped contacts, u the motion of the whole network and v the motion without the dropped
/// contacts. Each motion is in equilibrium in its own network, so the moduli are E = a(u, v) and E − ΔE = a(u, v) −
/// d(u, v). So the loss is d(u, v), computed with the matrices of the reference implementation. Elastic contacts
/// minimize energy. Therefore the loss is at least what the dropped contacts carry in u, and at most what they would
/// carry in v.
TEST_P(TinyFacets, TheLossIsWhatTheyCarry) {
  Laws elastic = am1_laws();
  for (auto& law : elastic) law = laws::Elastic{std::abs(chain_stiffness(*law, 1)), 0.1};
  for (const Laws& laws : {am1_laws(), elastic}) {
    const Solved whole = solve(t8(), laws, std::nullopt), less = solve(t8(), laws, GetParam());
    const BilinearForm d = bilinear_form(dropped(whole, less), laws, whole.scene.specimen.size(), 20);
    const Box& box = whole.scene.specimen.box;
    const Complex loss = whole.modulus - less.modulus, carried = modulus_of(d(whole.motion, less.motion), box);
    // The error of both moduli is the residual of the harmonic solver, 1e-11, times a condition number.
    const double rounding = 1e-9 * std::abs(whole.modulus);
    EXPECT_LT(std::abs(loss - carried), rounding);
    EXPECT_GT(std::abs(loss), 100 * rounding);  // the loss is large enough to compare
    const double with = modulus_of(d(whole.motion, whole.motion), box).real();
    const double without = modulus_of(d(less.motion, less.motion), box).real();
    fmt::print("area_min {}: share {:.2e} of the area, {:.2e} of the modulus; carried {:.2e} with, {:.2e} without\n",
               GetParam(), less.scene.network.dropped_share, std::abs(loss / whole.modulus),
               with / std::abs(whole.modulus), without / std::abs(whole.modulus));
    if (std::holds_alternative<laws::Elastic>(*laws[0])) {
      EXPECT_GE(loss.real(), with - rounding);
      EXPECT_LE(loss.real(), without + rounding);
    }
    // The fraction of the area is known before the solution. It predicts the loss within a factor of about three,
    // because contacts of all stiffnesses and distances have similar fractions of small facets.
    EXPECT_GT(std::abs(loss / whole.modulus) / less.scene.network.dropped_share, 0.3);
    EXPECT_LT(std::abs(loss / whole.modulus) / less.scene.network.dropped_share, 3);
  }
}

// With one point per facet, a contact in the form `points` has three chains of springs and dashpots, and a contact in
// the condensed form has six. Both forms must give the same motion.
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
