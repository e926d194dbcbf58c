// SPDX-License-Identifier: GPL-3.0-or-later
// contact_state_test.cpp  Checks the contact state that a stepper reports: forces add up to the forces on particles and
// walls, deformations follow from the displacements, and the chains match the laws.
#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <limits>

#include "tests/support/stepper_cases.hpp"

namespace macadam::test {
namespace {

class ContactStates : public BackendTest<StepperCase> {
 protected:
  std::unique_ptr<Stepper> make(const TestScene& scene, StepperOptions& options) const {
    std::tie(std::ignore, options.precision, options.form, options.geometry) = GetParam();
    return make_stepper(backend(), scene.specimen, scene.network, scene.laws, scene.inertia, options);
  }
};

/// Expects that the forces and moments of all contacts add up to the forces and moments on every particle and wall.
void expect_sums(const TestScene& scene, const Stepper& stepper, double tolerance) {
  const ContactState contacts = stepper.contacts(scene.network);
  const ParticleState particles = stepper.particles();
  const Observation walls = stepper.observe();
  std::vector<Vec3d> force(scene.specimen.size()), moment(scene.specimen.size()), wall(wall_count);
  for (std::size_t i = 0; i < scene.network.contacts.size(); ++i) {
    const Contact& c = scene.network.contacts[i];
    const auto a = static_cast<std::size_t>(c.a), b = static_cast<std::size_t>(c.b);
    force[a] += contacts.force[i];
    moment[a] += contacts.moment[i] + c.arm_a * cross(c.n, contacts.force[i]);
    if (c.b < 0) {
      wall[wall_index(c.b)] -= contacts.force[i];
      continue;
    }
    force[b] -= contacts.force[i];
    moment[b] += c.arm_b * cross(c.n, contacts.force[i]) - contacts.moment[i];
  }
  double size = 0;  // scale of the tolerance: the largest force of a single contact, because the sums nearly cancel
  for (const Vec3d& f : contacts.force) size = std::max(size, norm(f));
  ASSERT_GT(size, 0);
  for (std::size_t i = 0; i < force.size(); ++i) {
    ASSERT_LT(norm(force[i] - particles.force[i]), tolerance * size) << i;
    // lever arms are about a millimetre
    ASSERT_LT(norm(moment[i] - particles.moment[i]), tolerance * size * 1e-3) << i;
  }
  for (std::size_t w = 0; w < wall.size(); ++w) EXPECT_LT(norm(wall[w] - walls.wall_force[w]), 10 * tolerance * size);
}

TEST_P(ContactStates, ForcesAddUpToThoseOfTheBodies) {
  const TestScene scene = make_scene(random_specimen(test_seed()));
  for (StepperOptions options : {shaking_options(scene), slow_options(scene)}) {
    const auto stepper = make(scene, options);
    // Step 137 lies within a block of steps, for backends that update the viscoelastic state once per block.
    stepper->advance(137);
    // With fixed geometry the stepper keeps the initial lever arms, but the sums here use the current ones. At strains
    // of 1e-4 they differ by 1e-4.
    const bool fixed = options.geometry == Geometry::fixed;
    const double rounding = options.precision == Precision::double_ ? 1e-12 : 2e-5;
    expect_sums(scene, *stepper, std::max(rounding, fixed ? 0.0 : 1e-3));
  }
}

// A state that is read into the memory of another one has the same numbers as a new one, also those of components that
// the stepper leaves out, because no law has shear stiffness.
TEST_P(ContactStates, CanBeReadIntoUsedMemory) {
  Laws without_shear;
  without_shear.fill(laws::Elastic{2e10, 0});
  for (const TestScene& scene :
       {make_scene(random_specimen(test_seed())), make_scene(random_specimen(test_seed()), {}, without_shear)}) {
    StepperOptions options = shaking_options(scene);
    const auto stepper = make(scene, options);
    stepper->advance(20);
    const ContactState fresh = stepper->contacts(scene.network);
    ContactState used = fresh;
    const double none = std::numeric_limits<double>::quiet_NaN();
    std::fill(used.chain.begin(), used.chain.end(), none);
    std::fill(used.force.begin(), used.force.end(), Vec3d{none, none, none});
    used.moment = used.force;
    used.relative.assign(used.relative.size(), {none, none, none, none, none, none});
    used.chain_begin.assign(3, 7);
    used.broken.assign(5, none);
    stepper->read_contacts(scene.network, used);
    EXPECT_TRUE(used.chain == fresh.chain);
    EXPECT_TRUE(used.chain_begin == fresh.chain_begin);
    EXPECT_TRUE(used.relative == fresh.relative);
    EXPECT_TRUE(used.broken.empty());
    for (std::size_t c = 0; c < fresh.force.size(); ++c) {
      ASSERT_EQ(norm(used.force[c] - fresh.force[c]), 0) << c;
      ASSERT_EQ(norm(used.moment[c] - fresh.moment[c]), 0) << c;
    }
  }
}

// With fixed geometry an elastic contact has f = E·x in each of its six components, so the reported deformation times E
// must be f.
TEST_P(ContactStates, RelativeDisplacementIsWhatTheLawSees) {
  Laws laws;
  laws.fill(laws::Elastic{2e10, 0.3});
  const TestScene scene = make_scene(random_specimen(test_seed() + 1), {}, laws);
  StepperOptions options = shaking_options(scene);
  const auto stepper = make(scene, options);
  if (options.form == ContactForm::points) return;  // in this form the chains belong to points, not to contacts
  stepper->advance(60);
  const ContactState state = stepper->contacts(scene.network);
  double largest = 0, worst = 0;
  for (std::size_t c = 0; c < scene.network.contacts.size(); ++c) {
    ASSERT_EQ(state.chain_begin[c + 1] - state.chain_begin[c], 6);
    for (std::size_t k = 0; k < 6; ++k) {
      // Over a facet of a millimetre, slopes and twist (per metre) are a thousand times larger than opening and slip.
      const double scale = k == 0 || k == 3 || k == 4 ? 1 : 1e-3;
      const double f = state.chain[state.chain_begin[c] + k] / 2e10;
      largest = std::max(largest, scale * std::abs(f));
      worst = std::max(worst, scale * std::abs(f - state.relative[c][k]));
    }
  }
  const double rounding = options.precision == Precision::double_ ? 1e-11 : 1e-4;
  EXPECT_LT(worst, std::max(rounding, options.geometry == Geometry::fixed ? 0.0 : 1e-3) * largest);
}

INSTANTIATE_TEST_SUITE_P(All, ContactStates, all_stepper_cases(), [](const auto& info) { return name_of_case(info); });

/// A stepper calls back at the start and after every sample.
TEST(Sampling, TellsTheStartAndEverySample) {
  const TestScene scene = make_scene(random_specimen(3));
  const StepperOptions options = shaking_options(scene);
  const auto stepper = make_stepper(Backend::cpu, scene.specimen, scene.network, scene.laws, scene.inertia, options);
  std::vector<std::int64_t> steps;
  sample(*stepper, 7, 3, [&](const Observation& now) { steps.push_back(now.step); });
  EXPECT_EQ(steps, (std::vector<std::int64_t>{0, 7, 14, 21}));
  EXPECT_THROW(sample(*stepper, 0, 1, [](const Observation&) {}), InputError);
  std::vector<Vec3d> fast(scene.specimen.size()), none(scene.specimen.size());
  fast[4].x = 1e6;
  stepper->set_velocities(fast, none);
  try {
    sample(*stepper, 1, 5, [](const Observation&) {});
    FAIL() << "a run in which a particle leaves the specimen in one step is an error";
  } catch (const DivergenceError& error) { EXPECT_EQ(error.particle, 4); }
}

}  // namespace
}  // namespace macadam::test
