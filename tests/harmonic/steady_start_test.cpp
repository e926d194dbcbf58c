// SPDX-License-Identifier: GPL-3.0-or-later
// steady_start_test.cpp  A run that starts from the harmonic solution is periodic from the first cycle.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "tests/support/stepper_cases.hpp"

namespace macadam::test {
namespace {

TestScene t8() { return make_scene(read_specimen_csv(MACADAM_TEST_DATA "/t8.csv", {{0.008, 0.008, 0.011}})); }

/// Returns the specimen of examples/demo.
TestScene demo() {
  const Scene scene = read_scene(MACADAM_EXAMPLES "/demo/scene.toml");
  return make_scene(generate_specimen(scene.specimen).specimen, scene.network, scene.laws);
}

/// Runs one cycle from the steady start. Returns the error of |E*| (relative) and φ [degrees] against the harmonic
/// solution with the same inertia.
Stiffness error_of_one_cycle(const TestScene& scene, double frequency, Backend backend, StepperOptions options) {
  constexpr int samples = 200;
  const double viscous = options.damping_kind == Damping::viscous ? options.damping : 0;
  Harmonic harmonic(scene.specimen, scene.network, scene.laws, scene.inertia, {}, frequency);
  const HarmonicResult known = harmonic.solve(frequency, options.density_scaling, viscous);
  drives::Cyclic loading;
  loading.amplitude = 1e-4 * scene.specimen.box.size.z;
  loading.frequency = frequency;
  const double limit = critical_step(scene.network, scene.laws, scene.inertia, options).dt;
  const auto stride = static_cast<std::int64_t>(std::ceil(1 / (0.9 * limit * frequency * samples)));
  loading.steps_per_period = samples * stride;
  options.boundary = moving_top(loading);
  options.dt = loading.dt();
  const StartState start = steady_start(scene.network, scene.laws, known.motion, loading);
  options.start = &start;
  const auto stepper = make_stepper(backend, scene.specimen, scene.network, scene.laws, scene.inertia, options);
  const Vec3d& box = scene.specimen.box.size;
  std::vector<ResponseSample> response;
  sample(*stepper, stride, samples, [&](const Observation& now) {
    EXPECT_EQ(now.step, static_cast<std::int64_t>(response.size()) * stride);
    response.push_back({frequency, now.time, now.top_displacement() / box.z, -now.top_force() / (box.x * box.y)});
  });
  const Stiffness found = evaluate_cyclic(response, frequency, 1).fit;
  return {found.e_star_pa / known.top.e_star_pa - 1, found.phase_deg - known.top.phase_deg};
}

void expect_periodic(const Stiffness& error) {  // tolerances for one cycle from the steady start
  EXPECT_LT(std::abs(error.e_star_pa), 1e-5);
  EXPECT_LT(std::abs(error.phase_deg), 0.002);
  fmt::print("|E*| {:.1e}, phase {:.1e} deg\n", error.e_star_pa, error.phase_deg);
}

using Case = StepperCase;
class SteadyStart : public BackendTest<Case> {};

INSTANTIATE_TEST_SUITE_P(All, SteadyStart, all_stepper_cases(), [](const auto& info) { return name_of_case(info); });

TEST_P(SteadyStart, OneCycleOfT8) {
  StepperOptions options;
  Backend backend{};
  std::tie(backend, options.precision, options.form, options.geometry) = GetParam();
  options.threads = 1;
  if (long_tests) {
    options.density_scaling = 5e5;
    expect_periodic(error_of_one_cycle(t8(), 2, backend, options));
  }
  options.density_scaling = 5e3;
  expect_periodic(error_of_one_cycle(t8(), 20, backend, options));
}

TEST(SteadyStartDemo, OneCycleAtTwoAndTwentyHertz) {
  if (!long_tests) GTEST_SKIP() << "ten thousand steps of 2,391 particles";
  const TestScene scene = demo();
  StepperOptions options;
  for (const double frequency : {2.0, 20.0}) {
    options.density_scaling = 2e6 / (frequency * frequency);
    options.geometry = frequency == 2 ? Geometry::fixed : Geometry::updated;
    expect_periodic(error_of_one_cycle(scene, frequency, Backend::cpu, options));
  }
}

// Mass-proportional damping is linear, so the harmonic solution contains it. The damping here changes φ by more than
// half a degree.
TEST(SteadyStartDamped, ViscousDampingIsInTheSolution) {
  const TestScene scene = t8();
  StepperOptions options;
  options.density_scaling = 5e3;
  options.damping_kind = Damping::viscous;
  options.damping = 2000;
  Harmonic harmonic(scene.specimen, scene.network, scene.laws, scene.inertia, {}, 20);
  const double shift = harmonic.solve(20, 5e3, 2000).top.phase_deg - harmonic.solve(20, 5e3).top.phase_deg;
  EXPECT_GT(std::abs(shift), 0.5);
  expect_periodic(error_of_one_cycle(scene, 20, Backend::cpu, options));
}

// The reference stepper computes the start state of its Kelvin chains itself, from the same harmonic solution, and must
// agree.
TEST(SteadyStartReference, AgreesOverTheFirstSteps) {
  const TestScene scene = t8();
  StepperOptions options = shaking_options(scene);
  drives::Cyclic loading = top_drive(options);
  loading.ramp_steps = 0;
  options.boundary = moving_top(loading);
  Harmonic harmonic(scene.specimen, scene.network, scene.laws, scene.inertia, {}, 2000);
  for (const auto& [geometry, damping] :
       {std::pair{Geometry::updated, 0.0}, {Geometry::fixed, 0.0}, {Geometry::fixed, 2e4}}) {
    options.geometry = geometry;
    options.damping_kind = damping > 0 ? Damping::viscous : Damping::none;
    options.damping = damping;
    const StartState start = steady_start(scene.network, scene.laws, harmonic.solve(2000, 1, damping).motion, loading);
    options.start = &start;
    std::vector<ParticleState> states;
    for (const auto& [backend, form] : {std::pair{Backend::reference, ContactForm::points},
                                        {Backend::cpu, ContactForm::points},
                                        {Backend::cpu, ContactForm::condensed}}) {
      options.form = form;
      const auto stepper = make_stepper(backend, scene.specimen, scene.network, scene.laws, scene.inertia, options);
      EXPECT_EQ(stepper->observe().step, 0);
      EXPECT_NEAR(stepper->observe().top_displacement(), 0, 1e-18);
      stepper->advance(200);
      states.push_back(stepper->particles());
    }
    for (const ParticleState& state : states) {
      EXPECT_LT(relative_difference(state.displacement, states[0].displacement), 1e-11);
      EXPECT_LT(relative_difference(state.velocity, states[0].velocity), 1e-11);
    }
  }
}

TEST(SteadyStartInput, ARampOrAnotherNetworksStateIsRefused) {
  const TestScene scene = t8(), other = make_scene(random_specimen(3));
  StepperOptions options = shaking_options(scene);  // these options have a ramp
  const drives::Cyclic with_ramp = top_drive(options);
  drives::Cyclic without = with_ramp;
  without.ramp_steps = 0;
  Harmonic harmonic(scene.specimen, scene.network, scene.laws, scene.inertia, {}, 20);
  const StartState start = steady_start(scene.network, scene.laws, harmonic.solve(20, 1).motion, with_ramp);
  options.start = &start;
  const auto make = [&](const TestScene& of, Backend backend) {
    make_stepper(backend, of.specimen, of.network, of.laws, of.inertia, options);
  };
  for (const Backend backend : {Backend::cpu, Backend::reference}) {
    EXPECT_THROW(make(scene, backend), InputError);
    options.boundary = moving_top(without);
    EXPECT_NO_THROW(make(scene, backend));
    EXPECT_THROW(make(other, backend), InputError);
    options.boundary = moving_top(with_ramp);
  }
}

}  // namespace
}  // namespace macadam::test
