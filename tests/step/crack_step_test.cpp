// SPDX-License-Identifier: GPL-3.0-or-later
// crack_step_test.cpp  Tests specimens whose contacts crack, with every backend: bars that separate at one facet,
// comparisons with the reference implementation, conserved momentum, and refused options.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/stepper_cases.hpp"
#include "tests/support/test_files.hpp"

namespace macadam::test {
namespace {

/// Cracks are not linear and need double states, so every case uses the contact form `points` in double or mixed.
using Case = std::tuple<Backend, Precision, Geometry>;

class CrackStep : public BackendTest<Case> {
 protected:
  StepperOptions options() const {
    StepperOptions out;
    out.form = ContactForm::points;
    out.precision = std::get<Precision>(GetParam());
    out.geometry = std::get<Geometry>(GetParam());
    return out;
  }
  bool in_double() const { return std::get<Precision>(GetParam()) == Precision::double_; }
  double rounding() const { return in_double() ? 0x1p-53 : 0x1p-24; }
};

INSTANTIATE_TEST_SUITE_P(All, CrackStep,
                         testing::Combine(all_backends(), testing::Values(Precision::double_, Precision::mixed),
                                          testing::Values(Geometry::updated, Geometry::fixed)),
                         [](const auto& info) { return name_of_case(info); });

/// Returns a law with a crack in series whose two fracture energies are equal.
template <class Chain>
Law cracked(const Chain& chain, double strength, double energy, double friction = 0,
            laws::Softening softening = laws::Softening::linear) {
  return laws::Cracked<Chain>{chain, {strength, energy, 1.5 * strength, energy, friction, friction, softening}};
}

/// A bar of cubes along z, which is pulled slowly until the middle contact has separated. This contact has another
/// pair type and 98 % of the strength of the others.
struct Bar {
  static constexpr double side = 2e-3, strength = 2e6, energy = 60, modulus = 1e10;
  HandMade made;
  Laws laws;
  std::size_t weak = 0;  ///< number of the contact that separates
  std::unique_ptr<Stepper> stepper;
  double dt = 0, rate = 0;  ///< rate of the top wall [m/s]

  Bar(Backend backend, StepperOptions options, int facets, PairType weak_pair, bool viscoelastic)
      : made(cubic_lattice_network(1, 1, facets, side, 1e-5)) {
    const laws::Elastic elastic{modulus, 0.1};
    const laws::GeneralisedKelvin chain{modulus, 1e9, {1e10, 2e10, 5e9}, {1e7, 1e5, 1e3}, 0.1};
    laws.fill(laws::Elastic{modulus, 0});
    const auto law = [&](double part) {
      return viscoelastic ? cracked(chain, part * strength, energy) : cracked(elastic, part * strength, energy);
    };
    laws[static_cast<std::size_t>(PairType::mm)] = law(1);
    laws[static_cast<std::size_t>(weak_pair)] = law(0.98);
    std::vector<Contact>& contacts = made.network.contacts;
    weak = contacts.size() / 2;
    for (std::size_t c = weak; contacts[c].b < 0;) weak = ++c % contacts.size();
    contacts[weak].pair = weak_pair;
    --made.network.count[static_cast<std::size_t>(PairType::mm)];
    ++made.network.count[static_cast<std::size_t>(weak_pair)];
    dt = options.dt = 0.5 * critical_step(made.network, laws, made.inertia, options).dt;
    options.damping = 0.3;  // otherwise the waves of the separation crack other facets
    rate = 1e-2;
    // The crack is separated at an opening of 2·G_f/f_t = 6.1e-5 m
    const double end = 1e-4 / rate;
    options.boundary.move(wall_z_hi, 2,
                          std::make_shared<drives::Table>(dt, std::vector{0.0, end}, std::vector{0.0, rate * end}));
    stepper = make_stepper(backend, made.specimen, made.network, laws, made.inertia, options);
  }
};

// The crack takes G_f·A for any length of the bar, and nothing else is damaged. The top wall does this work and the
// work of the damping.
TEST_P(CrackStep, ABarOfAnyLengthTakesTheFractureEnergy) {
  for (const int facets : {2, 4, 8}) {
    for (const PairType weak : {PairType::ma, PairType::inner}) {
      Bar bar(backend(), options(), facets, weak, weak == PairType::ma);
      const Contact& contact = bar.made.network.contacts[bar.weak];
      double work = 0, force = 0;
      bool separated = false;
      for (int k = 0; k < 2000 && !separated; ++k) {
        const std::int64_t steps = 100;
        bar.stepper->advance(steps);
        const double now = -bar.stepper->observe().wall_force[wall_index(wall_z_hi)].z;
        work += 0.5 * (now + force) * bar.rate * bar.dt * static_cast<double>(steps);
        force = now;
        const auto breaks = bar.stepper->point_breaks(bar.made.network);
        separated = std::all_of(breaks.begin() + contact.point_begin, breaks.begin() + contact.point_end,
                                [](Break how) { return how == Break::tension; });
      }
      ASSERT_TRUE(separated) << facets;
      const auto cracks = bar.stepper->point_cracks(bar.made.network);
      ASSERT_EQ(cracks.size(), bar.made.network.point_area.size());
      double energy = 0;
      for (std::size_t j = 0; j < cracks.size(); ++j) {
        const bool weak_point = j >= contact.point_begin && j < contact.point_end;
        energy += cracks[j].energy * bar.made.network.point_area[j];
        EXPECT_EQ(cracks[j].damage, weak_point ? 1 : 0) << facets << " " << j;
        // without friction only the rounding of stresses does work, a part of 1e-16 of the stress over a slip
        EXPECT_NEAR(cracks[j].friction, 0, 1e-15 * Bar::energy);
      }
      const double right = Bar::energy * contact.area;
      EXPECT_NEAR(energy, right, 1e-8 * right) << facets;
      // The sum over samples of 100 steps misses a part of the first wave, and the damping of waves takes some energy;
      // viscoelastic contacts dissipate too
      EXPECT_GT(work, 0.97 * right) << facets;
      EXPECT_LT(work, (weak == PairType::ma ? 1.2 : 1.02) * right) << facets;
    }
  }
}

/// Returns a random specimen whose particle pairs crack at low stresses. The pairs have three, two and no Kelvin units
/// and different softening.
TestScene cracking_scene(unsigned seed, const NetworkSpec& spec = {}) {
  using laws::Softening;
  Laws laws = am1_laws();
  const auto at = [&](PairType pair) -> Law& { return *laws[static_cast<std::size_t>(pair)]; };
  at(PairType::mm) = cracked(mastic_am1(), 2e4, 0.0025, 0.5);
  at(PairType::ma) =
      cracked(laws::GeneralisedKelvin{3e10, 8e9, {1e9, 5e9}, {2e4, 1e6}, 0.1}, 3e4, 0.004, 0.3, Softening::bilinear);
  at(PairType::aa) = cracked(laws::Elastic{5e10, 0.05}, 5e4, 0.015, 0.6, Softening::exponential);
  at(PairType::inner) = cracked(laws::Elastic{5e10, 0.05}, 8e4, 0.02, 0.6);
  return make_scene(random_specimen(seed), spec, laws);
}

/// Returns shaking_options() with a load of 10 kHz, which opens and closes cracks within some hundred steps.
StepperOptions fast_options(const TestScene& scene) {
  StepperOptions out = shaking_options(scene);
  drives::Cyclic loading = top_drive(out);
  loading.frequency = 1e4;
  loading.steps_per_period = static_cast<std::int64_t>(1 / (loading.frequency * out.dt)) + 1;
  out.boundary = moving_top(loading);
  out.dt = loading.dt();
  return out;
}

/// Counts of a list of cracks: damaged, separated, shut although damaged.
struct CrackCounts {
  int damaged = 0, separated = 0, shut = 0;
};
CrackCounts counts_of(const std::vector<laws::PointCrack>& cracks) {
  CrackCounts out;
  for (const laws::PointCrack& crack : cracks)
    out.damaged += crack.damage > 0, out.separated += crack.damage == 1,
        out.shut += crack.damage > 0 && !(crack.opening > 0);
  return out;
}

// A specimen is shaken until most of its points are damaged and many have closed again. It must agree with the
// reference implementation, which solves each point by bisection. Where faces meet again, rounding errors grow
// exponentially with time: from 1e-16 to 1e-12 of the forces in 300 steps, and to 1e-8 in 600. So the comparison is
// tight at 300 steps; at 600, where many points have separated, it is wider, and only for double precision.
TEST_P(CrackStep, SpecimensCrackAsTheReferenceDoes) {
  const TestScene scene = cracking_scene(12);
  StepperOptions given = fast_options(scene);
  given.form = options().form, given.geometry = options().geometry;
  const auto reference =
      make_stepper(Backend::reference, scene.specimen, scene.network, scene.laws, scene.inertia, given);
  given.precision = options().precision;
  const auto stepper = make_stepper(backend(), scene.specimen, scene.network, scene.laws, scene.inertia, given);
  const auto compare = [&](double tolerance) {
    const ParticleState want = reference->particles(), have = stepper->particles();
    EXPECT_LT(relative_difference(have.displacement, want.displacement), tolerance);
    EXPECT_LT(relative_difference(have.velocity, want.velocity), 100 * tolerance);
    EXPECT_LT(relative_difference(have.spin, want.spin), 100 * tolerance);
    EXPECT_LT(relative_difference(have.force, want.force), 100 * tolerance);
    const auto right = reference->point_cracks(scene.network), found = stepper->point_cracks(scene.network);
    ASSERT_EQ(found.size(), right.size());
    double energy[2] = {0, 0}, friction[2] = {0, 0};
    for (std::size_t j = 0; j < right.size(); ++j) {
      const double area = scene.network.point_area[j];
      energy[0] += found[j].energy * area, energy[1] += right[j].energy * area;
      friction[0] += found[j].friction * area, friction[1] += right[j].friction * area;
      EXPECT_NEAR(found[j].damage, right[j].damage, 1000 * tolerance) << j;
      EXPECT_NEAR(found[j].opening, right[j].opening, 1e-6 * 100 * tolerance) << j;  // openings are about 1e-6 m
      EXPECT_NEAR(found[j].slip, right[j].slip, 1e-6 * 100 * tolerance) << j;
    }
    EXPECT_NEAR(energy[0], energy[1], 100 * tolerance * energy[1]);
    EXPECT_NEAR(friction[0], friction[1], 100 * tolerance * energy[1]);
    EXPECT_GT(friction[1], 0);
    EXPECT_GT(counts_of(right).damaged, std::ssize(right) / 3);
    EXPECT_GT(counts_of(right).shut, 50);
  };
  for (Stepper* one : {reference.get(), stepper.get()}) one->advance(100), one->advance(200);
  compare(in_double() ? 2e-12 : 2e-6);
  if (!in_double()) return;
  for (Stepper* one : {reference.get(), stepper.get()}) one->advance(300);
  compare(2e-8);
  EXPECT_GT(counts_of(reference->point_cracks(scene.network)).separated, 100);
  EXPECT_EQ(stepper->point_breaks(scene.network), reference->point_breaks(scene.network));
}

// A crack exerts equal and opposite forces on its two particles, at the same points, so a free assembly keeps its
// momentum and angular momentum.
TEST_P(CrackStep, FreeAssembliesKeepTheirMomentum) {
  NetworkSpec spec;
  spec.bottom_top_walls = false;
  const TestScene scene = cracking_scene(5, spec);
  StepperOptions given = options();
  given.dt = 0.5 * critical_step(scene.network, scene.laws, scene.inertia, given).dt;
  const auto stepper = make_stepper(backend(), scene.specimen, scene.network, scene.laws, scene.inertia, given);
  std::vector<Vec3d> kick;
  for (std::size_t i = 0; i < scene.specimen.size(); ++i) {
    const double n = static_cast<double>(i);
    kick.push_back({0.2 * std::sin(n), 0.2 * std::cos(3 * n), 0.2 * std::sin(7 * n)});
  }
  stepper->set_velocities(kick, std::vector<Vec3d>(kick.size()));
  const std::int64_t steps = 500;
  /// Momentum, angular momentum about the origin, and the sums of their magnitudes.
  struct Momentum {
    Vec3d linear, angular;
    double size = 0, turning = 0;
  };
  const auto momentum_of = [&](const ParticleState& state) {
    Momentum out;
    for (std::size_t i = 0; i < state.velocity.size(); ++i) {
      Vec3d x = scene.specimen.centre[i];
      if (given.geometry == Geometry::updated) x += state.displacement[i];
      const Vec3d p = scene.inertia.mass[i] * state.velocity[i], turn = scene.inertia.inertia[i] * state.spin[i];
      out.linear += p, out.angular += cross(x, p) + turn;
      out.size += norm(p), out.turning += norm(cross(x, p)) + norm(turn);
    }
    return out;
  };
  const Momentum before = momentum_of(stepper->particles());
  stepper->advance(steps);
  const Momentum after = momentum_of(stepper->particles());
  const auto [damaged, separated, shut] = counts_of(stepper->point_cracks(scene.network));
  EXPECT_GT(damaged, 1000);
  EXPECT_GT(separated, 10);
  // Velocities are rounded in every step, forces in mixed precision too
  const double tolerance = in_double() ? 1e-14 : steps * rounding();
  EXPECT_LT(norm(after.linear - before.linear), tolerance * before.size);
  EXPECT_LT(norm(after.angular - before.angular), tolerance * before.turning);
}

// As long as no point cracks, the crack changes no force.
TEST_P(CrackStep, IntactContactsMoveAsWithoutACrack) {
  Laws plain = am1_laws(), strong = plain;
  for (const PairType pair : {PairType::mm, PairType::ma}) {
    Law& law = *strong[static_cast<std::size_t>(pair)];
    law = cracked(std::get<laws::GeneralisedKelvin>(law), 1e12, 1e20);
  }
  const TestScene scene = make_scene(random_specimen(3), {}, plain);
  StepperOptions given = shaking_options(scene);
  given.form = options().form, given.geometry = options().geometry, given.precision = options().precision;
  const auto run = [&](const Laws& laws) {
    const auto stepper = make_stepper(backend(), scene.specimen, scene.network, laws, scene.inertia, given);
    stepper->advance(300);
    return stepper->particles();
  };
  const ParticleState want = run(plain), have = run(strong);
  const double tolerance = backend() == Backend::cpu ? 0 : 300 * rounding();  // a device may fuse other operations
  EXPECT_LE(relative_difference(have.displacement, want.displacement), tolerance);
  EXPECT_LE(relative_difference(have.force, want.force), tolerance);
}

// A run that continues from a state takes the same steps to the bit.
TEST_P(CrackStep, AStateContinuesToTheSameBits) {
  const TestScene scene = cracking_scene(8);
  StepperOptions given = shaking_options(scene);
  given.form = options().form, given.geometry = options().geometry, given.precision = options().precision;
  const auto made = [&] {
    return make_stepper(backend(), scene.specimen, scene.network, scene.laws, scene.inertia, given);
  };
  const auto whole = made(), first = made(), second = made();
  whole->advance(400);
  first->advance(250);
  second->set_state(first->state());
  second->advance(150);
  EXPECT_EQ(relative_difference(second->particles().displacement, whole->particles().displacement), 0);
  const auto want = whole->point_cracks(scene.network), have = second->point_cracks(scene.network);
  EXPECT_GT(counts_of(want).damaged, 0);
  for (std::size_t j = 0; j < want.size(); ++j) {
    EXPECT_EQ(have[j].energy, want[j].energy) << j;
    EXPECT_EQ(have[j].friction, want[j].friction) << j;
  }
}

/// Single precision and the condensed form are refused; the reference checks the values of a crack.
TEST(CrackInput, IsSteppedByPointsInDoubleOrMixed) {
  TestScene scene = cracking_scene(2);
  StepperOptions options = shaking_options(scene);
  const auto message = [&](Backend backend) {
    return message_of(
        [&] { make_stepper(backend, scene.specimen, scene.network, scene.laws, scene.inertia, options); });
  };
  EXPECT_HAS(message(Backend::cpu), "generalised_kelvin with crack, which is not linear, expected \"points\"");
  options.form = ContactForm::points;
  EXPECT_EQ(message(Backend::cpu), "nothing was thrown");
  options.precision = Precision::single;
  EXPECT_HAS(message(Backend::cpu), "found single beside law generalised_kelvin with crack of pair M-M");
  options.precision = Precision::double_;
  auto& law = std::get<laws::Cracked<laws::GeneralisedKelvin>>(*scene.laws[static_cast<std::size_t>(PairType::mm)]);
  law.crack.fracture_energy = 0;
  EXPECT_HAS(message(Backend::reference), "crack of pair M-M: fracture_energy");
}

}  // namespace
}  // namespace macadam::test
