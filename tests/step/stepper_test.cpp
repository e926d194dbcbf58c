// SPDX-License-Identifier: GPL-3.0-or-later
// stepper_test.cpp  Compares every backend, precision, form and geometry with the reference stepper, on random
// specimens.
#include <gtest/gtest.h>

#include <tuple>

#include "tests/support/cluster_specimens.hpp"
#include "tests/support/stepper_cases.hpp"

namespace macadam::test {
namespace {

using Case = StepperCase;

class StepperAgainstReference : public BackendTest<Case> {
 protected:
  /// Advances the reference stepper and the tested stepper, and compares all motions and wall forces relative to their
  /// largest values.
  void compare(const TestScene& scene, StepperOptions options, std::int64_t steps) {
    const double tolerance = this->tolerance(steps);
    const auto& [backend, precision, form, geometry] = GetParam();
    options.form = form;
    options.geometry = geometry;
    const auto reference =
        make_stepper(Backend::reference, scene.specimen, scene.network, scene.laws, scene.inertia, options);
    options.precision = precision;
    const auto stepper = make_stepper(backend, scene.specimen, scene.network, scene.laws, scene.inertia, options);
    reference->advance(steps);
    stepper->advance(steps / 3);  // a run may be divided anywhere
    stepper->advance(steps - steps / 3);
    const ParticleState expected = reference->particles(), found = stepper->particles();
    EXPECT_LT(relative_difference(found.displacement, expected.displacement), tolerance);
    EXPECT_LT(relative_difference(found.velocity, expected.velocity), tolerance);
    EXPECT_LT(relative_difference(found.spin, expected.spin), tolerance);
    EXPECT_LT(relative_difference(found.force, expected.force), tolerance);
    EXPECT_LT(relative_difference(found.moment, expected.moment), tolerance);
    const Observation want = reference->observe(), have = stepper->observe();
    EXPECT_EQ(have.step, steps);
    EXPECT_LT(relative_difference({have.wall_force.begin(), have.wall_force.end()},
                                  {want.wall_force.begin(), want.wall_force.end()}),
              tolerance);
  }

  /// Rounding of the geometry changes every stiffness by the fraction ε, hence the phase of a mode by ε·ω·t ≤ ε·steps
  /// (the step is half of the critical one, so ωΔt ≤ 1). Sums of about ten terms make this ten times as large. In
  /// double precision the error of the reference counts too: the reference computes the distance d from absolute
  /// coordinates, which are five to ten times d.
  double tolerance(std::int64_t steps) const {
    const double rounding = std::get<Precision>(GetParam()) == Precision::double_ ? 100 * 0x1p-53 : 10 * 0x1p-24;
    return rounding * static_cast<double>(std::max<std::int64_t>(steps, 100));
  }
};

TEST_P(StepperAgainstReference, ThousandStepsOfFreshSpecimens) {
  const unsigned seed = test_seed();
  for (unsigned k = 0; k < 2; ++k) {
    SCOPED_TRACE("specimen seed " + std::to_string(seed + k));
    const TestScene scene = make_scene(random_specimen(seed + k));
    for (int pair = 0; pair < pair_types; ++pair) EXPECT_GT(scene.network.count[static_cast<std::size_t>(pair)], 0);
    compare(scene, shaking_options(scene), long_tests ? 1000 : 100);
  }
}

TEST_P(StepperAgainstReference, ClustersOfManySpheres) {
  for (const Laws& laws : {am1_laws(), am2_laws()}) {
    const TestScene scene = make_scene(few_clusters(test_seed()), {}, laws);
    EXPECT_GT(scene.network.count[static_cast<std::size_t>(PairType::inner)], 100);
    compare(scene, shaking_options(scene), long_tests ? 300 : 100);
  }
}

TEST_P(StepperAgainstReference, LawsOfAnyNumberOfUnits) {
  Laws laws = am1_laws();
  laws[static_cast<std::size_t>(PairType::mm)] = laws::GeneralisedKelvin{1e10, INFINITY, {}, {}, 0.2};
  laws[static_cast<std::size_t>(PairType::ma)] =
      laws::GeneralisedKelvin{2e10, 1e6, {1e9, 2e9, 3e9, 4e9, 5e9}, {1e6, 1e5, 1e4, 1e3, 1e7}, 0.1};
  laws[static_cast<std::size_t>(PairType::aa)] = laws::GeneralisedKelvin{3e10, 1e5, {1e10}, {1e5}, 0.0};
  laws[static_cast<std::size_t>(PairType::aw)] = laws::Elastic{1e10, 0.3};
  const TestScene scene = make_scene(random_specimen(7), {}, laws);
  compare(scene, shaking_options(scene), long_tests ? 300 : 100);
}

TEST_P(StepperAgainstReference, DampingScalingAndLateralWalls) {
  NetworkSpec spec;
  spec.lateral_walls = true;
  const TestScene scene = make_scene(random_specimen(11), spec);
  StepperOptions options = shaking_options(scene);
  options.density_scaling = 3;
  options.damping_kind = Damping::viscous;
  options.damping = 5e4;
  compare(scene, options, long_tests ? 300 : 100);
  options.damping_kind = Damping::local;
  options.damping = 0.3;
  // A velocity component that would be zero may get either sign by rounding, so only a few steps can be compared.
  compare(scene, options, 20);
}

TEST_P(StepperAgainstReference, SlowLoadUnderWaves) {
  const TestScene scene = make_scene(random_specimen(13, 6, 6, 7));
  StepperOptions options = slow_options(scene);
  compare(scene, options, long_tests ? 1000 : 100);
  options.damping_kind = Damping::viscous;
  options.damping = 5e4;
  compare(scene, options, long_tests ? 300 : 100);
}

/// On a GPU with two multiprocessors the tiles are full: all registers for contacts are in use.
TEST_P(StepperAgainstReference, ElasticContactsUnderSlowLoad) {
  const TestScene scene = make_scene(random_specimen(19, 8, 8, 9), {}, elastic_laws());
  StepperOptions options = slow_options(scene);
  options.multiprocessors = 2;
  EXPECT_GT(scene.network.contacts.size(), 2 * 48 * 32u);  // each of the 16 warps of a tile has more than three packets
  compare(scene, options, long_tests ? 600 : 100);
}

/// A stepper for laws with memory is reused for laws without memory. The states that it keeps must not affect the
/// result.
TEST_P(StepperAgainstReference, LawsOfAnotherKindThanThoseOfTheUsedStepper) {
  const auto& [on, precision, form, geometry] = GetParam();
  const Backend backend = on;  // clang 16 cannot capture structured bindings
  const TestScene scene = make_scene(random_specimen(19, 6, 6, 7));
  StepperOptions options = slow_options(scene);
  options.form = form;
  options.precision = precision;
  options.geometry = geometry;
  // the new laws are softer, so a time step that is stable for the old laws is stable for the new laws too
  const Laws elastic = elastic_laws();
  Laws slippery = elastic;
  std::get<laws::Elastic>(*slippery[static_cast<std::size_t>(PairType::mm)]).alpha = 0;
  const auto with = [&](const Laws& laws, std::unique_ptr<Stepper> used) {
    auto out = make_stepper(backend, scene.specimen, scene.network, laws, scene.inertia, options, std::move(used));
    out->advance(70);
    return out;
  };
  const ParticleState alone = with(elastic, nullptr)->particles();
  auto stepper = with(scene.laws, nullptr);
  stepper = with(elastic, std::move(stepper));
  const ParticleState after = stepper->particles();
  stepper = with(slippery, std::move(stepper));
  const ParticleState back = stepper->particles(), others = with(slippery, nullptr)->particles();
  for (std::size_t i = 0; i < scene.specimen.size(); ++i) {
    ASSERT_EQ(after.force[i].x, alone.force[i].x);
    ASSERT_EQ(after.velocity[i].z, alone.velocity[i].z);
    ASSERT_EQ(back.force[i].x, others.force[i].x);
    ASSERT_EQ(back.velocity[i].z, others.velocity[i].z);
  }
}

INSTANTIATE_TEST_SUITE_P(All, StepperAgainstReference, all_stepper_cases(),
                         [](const auto& info) { return name_of_case(info); });

/// The particles rotate by large angles, and the frames of the contacts must follow these rotations.
TEST_P(StepperAgainstReference, FreeAssemblyThatTumbles) {
  NetworkSpec spec;
  spec.bottom_top_walls = false;
  const TestScene scene = make_scene(random_specimen(5, 3, 3, 3), spec);
  StepperOptions options;
  options.dt = 0.5 * critical_step(scene.network, scene.laws, scene.inertia, options).dt;
  options.form = std::get<ContactForm>(GetParam());
  options.geometry = Geometry::updated;
  options.precision = std::get<Precision>(GetParam());
  const Vec3d omega{2e3, -1e3, 3e3};  // an eighth of a turn in 2,000 steps
  const Vec3d middle = 0.5 * scene.specimen.box.size;
  std::vector<Vec3d> velocity, spin(scene.specimen.size(), omega);
  for (const auto& x : scene.specimen.centre) velocity.push_back(cross(omega, x - middle));
  StepperOptions exact = options;
  exact.precision = Precision::double_;
  const auto reference =
      make_stepper(Backend::reference, scene.specimen, scene.network, scene.laws, scene.inertia, exact);
  const auto stepper = make_stepper(backend(), scene.specimen, scene.network, scene.laws, scene.inertia, options);
  for (auto* s : {reference.get(), stepper.get()}) {
    s->set_velocities(velocity, spin);
    s->advance(500);
  }
  const double loose = std::get<Precision>(GetParam()) == Precision::double_ ? 1e-9 : 3e-3;
  EXPECT_LT(relative_difference(stepper->particles().displacement, reference->particles().displacement), loose);
  EXPECT_LT(relative_difference(stepper->particles().force, reference->particles().force), 10 * loose);
}

TEST(Stepper, SameBitsForAnyNumberOfThreads) {
  const TestScene scene = make_scene(random_specimen(3, 10, 10, 12));  // large enough for several tiles
  std::vector<ParticleState> states;
  for (const int threads : {1, 2, 3}) {
    StepperOptions options = shaking_options(scene);
    options.threads = threads;
    const auto stepper = make_stepper(Backend::cpu, scene.specimen, scene.network, scene.laws, scene.inertia, options);
    stepper->advance(50);
    states.push_back(stepper->particles());
    EXPECT_NE(stepper->description().find(std::to_string(threads)), std::string::npos) << stepper->description();
  }
  for (std::size_t i = 0; i < scene.specimen.size(); ++i) {
    for (std::size_t k = 1; k < states.size(); ++k) {
      ASSERT_EQ(states[k].velocity[i].x, states[0].velocity[i].x);
      ASSERT_EQ(states[k].spin[i].z, states[0].spin[i].z);
      ASSERT_EQ(states[k].force[i].y, states[0].force[i].y);
      ASSERT_EQ(states[k].displacement[i].z, states[0].displacement[i].z);
    }
  }
}

/// A run that is divided into several calls gives the same bits as a run in one call, on every backend.
TEST_P(StepperAgainstReference, SameBitsHoweverTheRunIsCut) {
  const auto& [backend, precision, form, geometry] = GetParam();
  const TestScene scene = make_scene(random_specimen(17, 8, 8, 9));
  StepperOptions options = shaking_options(scene);
  drives::Cyclic loading = top_drive(options);
  for (const double frequency : {2000.0, 50.0}) {
    loading.frequency = frequency;
    loading.steps_per_period = static_cast<std::int64_t>(1 / (frequency * options.dt)) + 1;
    StepperOptions chosen = options;
    chosen.dt = loading.dt();
    chosen.boundary = moving_top(loading);
    chosen.form = form;
    chosen.precision = precision;
    chosen.geometry = geometry;
    std::vector<ParticleState> states;
    std::vector<Observation> observed;
    for (const std::vector<std::int64_t>& pieces : {std::vector<std::int64_t>{400}, {1, 2, 97, 130, 170}}) {
      const auto stepper = make_stepper(backend, scene.specimen, scene.network, scene.laws, scene.inertia, chosen);
      for (const auto n : pieces) {
        stepper->advance(n);
        stepper->observe();
      }
      states.push_back(stepper->particles());
      observed.push_back(stepper->observe());
    }
    ASSERT_GT(largest(states[0].velocity), 0);
    for (std::size_t i = 0; i < scene.specimen.size(); ++i) {
      ASSERT_EQ(states[1].velocity[i].x, states[0].velocity[i].x) << "particle " << i << " at " << frequency << " Hz";
      ASSERT_EQ(states[1].spin[i].z, states[0].spin[i].z);
      ASSERT_EQ(states[1].force[i].y, states[0].force[i].y);
      ASSERT_EQ(states[1].moment[i].x, states[0].moment[i].x);
      ASSERT_EQ(states[1].displacement[i].z, states[0].displacement[i].z);
    }
    for (std::size_t wall = 0; wall < 6; ++wall)
      ASSERT_EQ(observed[1].wall_force[wall].z, observed[0].wall_force[wall].z);
  }
}

TEST(Stepper, ExactQuadratureChangesTheBendingOnly) {
  NetworkSpec exact;
  exact.quadrature = Quadrature::exact;
  const TestScene lumped = make_scene(random_specimen(9)), polygon = make_scene(random_specimen(9), exact);
  double lumped_sum = 0, exact_sum = 0;
  for (std::size_t c = 0; c < lumped.network.contacts.size(); ++c) {
    const AreaMoments &l = lumped.network.contacts[c].moments, &e = polygon.network.contacts[c].moments;
    EXPECT_NEAR(l.a, e.a, 1e-12 * e.a);
    lumped_sum += l.ss + l.tt;
    exact_sum += e.ss + e.tt;
  }
  EXPECT_GT(lumped_sum, 1.2 * exact_sum);  // points at the rim have larger second moments than the area between them
  StepperOptions options = shaking_options(lumped);
  const auto a = make_stepper(Backend::cpu, lumped.specimen, lumped.network, lumped.laws, lumped.inertia, options);
  const auto b = make_stepper(Backend::cpu, polygon.specimen, polygon.network, polygon.laws, polygon.inertia, options);
  a->advance(200);
  b->advance(200);
  EXPECT_GT(relative_difference(a->particles().spin, b->particles().spin), 1e-4);
}

TEST(Stepper, MissingLawIsNamed) {
  TestScene scene = make_scene(random_specimen(2));
  scene.laws[static_cast<std::size_t>(PairType::ma)].reset();
  StepperOptions options;
  options.dt = 1e-8;
  try {
    make_stepper(Backend::cpu, scene.specimen, scene.network, scene.laws, scene.inertia, options);
    FAIL() << "a pair without a law was accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("M-A"), std::string::npos) << error.what();
  }
}

TEST(Backends, ExplicitCudaNeverFallsBack) {
  const BackendReport report = report_backends();
  EXPECT_FALSE(report.cuda_status.empty());
  EXPECT_GE(report.threads, 1);
  std::string reason;
  if (report.devices.empty()) {
    EXPECT_THROW(select_backend(Backend::cuda), RunError);
    EXPECT_EQ(select_backend(Backend::automatic, &reason), Backend::cpu);
  } else {
    EXPECT_EQ(select_backend(Backend::cuda), Backend::cuda);
    EXPECT_EQ(select_backend(Backend::automatic, &reason), Backend::cuda);
  }
  EXPECT_FALSE(reason.empty());
  EXPECT_EQ(select_backend(Backend::cpu), Backend::cpu);
}

}  // namespace
}  // namespace macadam::test
