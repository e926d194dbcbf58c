// SPDX-License-Identifier: GPL-3.0-or-later
// stepper_state_test.cpp  Tests that a stepper (the object that advances particles in time) continues with the same
// bits when it is set to the state of another stepper.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <complex>
#include <random>

#include "tests/support/general_laws.hpp"
#include "tests/support/test_files.hpp"
#include "tests/support/stepper_cases.hpp"

namespace macadam::test {
namespace {

using Case = StepperCase;
class StepperState : public BackendTest<Case> {
 protected:
  StepperState() : scene_(make_scene(random_specimen(21))), options_(shaking_options(scene_)) {
    std::tie(backend_, options_.precision, options_.form, options_.geometry) = GetParam();
  }
  std::unique_ptr<Stepper> stepper(const StepperOptions& options) const {
    return make_stepper(backend_, scene_.specimen, scene_.network, scene_.laws, scene_.inertia, options);
  }
  /// Returns options for the same specimen that use every feature of a boundary.
  StepperOptions pushed() const {
    StepperOptions out = options_;
    const double area = scene_.specimen.box.size.x * scene_.specimen.box.size.y;
    out.boundary = Boundary()
                       .load(wall_z_hi, 2, std::make_shared<drives::Ramp>(-1e5 * area, out.dt, 300), 1e-4)
                       .move(wall_z_lo, 0, std::make_shared<drives::ConstantRate>(1e-3, out.dt, 1.0));
    out.boundary.fixed = {7, 20};
    for (const double m : scene_.inertia.mass) out.boundary.body_force.push_back({0, 10 * m, -981 * m});
    return out;
  }

  /// Compares steps on a whole GPU with steps on some of its multiprocessors.
  void compare_sizes(const TestScene& scene, StepperOptions options) const {
    std::tie(options.precision, options.form, options.geometry) =
        std::tie(options_.precision, options_.form, options_.geometry);
    const auto of = [&](int multiprocessors) {
      options.multiprocessors = multiprocessors;
      return make_stepper(backend_, scene.specimen, scene.network, scene.laws, scene.inertia, options);
    };
    const auto whole = of(0);
    whole->advance(150);
    const std::vector<StateArray> state = whole->state();
    whole->advance(200);
    for (const int multiprocessors : {1, 3, 5}) {
      const auto small = of(multiprocessors), taken = of(multiprocessors);
      small->advance(350);
      EXPECT_TRUE(same_bits(small->state(), whole->state())) << multiprocessors;
      EXPECT_EQ(small->observe().top_force(), whole->observe().top_force()) << multiprocessors;
      taken->set_state(state);
      taken->advance(200);
      EXPECT_TRUE(same_bits(taken->state(), whole->state())) << multiprocessors;
    }
  }

  TestScene scene_;
  StepperOptions options_;
  Backend backend_{};
};

INSTANTIATE_TEST_SUITE_P(All, StepperState, all_stepper_cases(), [](const auto& info) { return name_of_case(info); });

// If one call takes several samples, they equal the observations of a stepper that stops at each sample. A GPU takes
// such samples without stopping.
TEST_P(StepperState, SamplesAreObservationsOneByOne) {
  const auto check = [&](const char* what, const StepperOptions& options) {
    SCOPED_TRACE(what);
    const auto at_once = stepper(options), one_by_one = stepper(options);
    for (const std::int64_t every : {3, 1, 60, 300}) {
      for (std::int64_t times = 90 / every + 2; times > 0;) {
        const std::vector<Sample> samples = at_once->advance_sampled(every, times);
        ASSERT_GE(samples.size(), 1u);
        ASSERT_LE(static_cast<std::int64_t>(samples.size()), times);
        times -= static_cast<std::int64_t>(samples.size());
        for (const Sample& sample : samples) {
          one_by_one->advance(every);
          const Observation now = one_by_one->observe();
          EXPECT_EQ(sample.now.step, now.step);
          EXPECT_EQ(sample.now.time, now.time);
          for (std::size_t wall = 0; wall < wall_count; ++wall) {
            for (const auto part : {&Vec3d::x, &Vec3d::y, &Vec3d::z}) {
              EXPECT_EQ(sample.now.wall_force[wall].*part, now.wall_force[wall].*part) << wall;
              EXPECT_EQ(sample.now.wall_displacement[wall].*part, now.wall_displacement[wall].*part) << wall;
              EXPECT_EQ(sample.now.wall_velocity[wall].*part, now.wall_velocity[wall].*part) << wall;
            }
          }
          EXPECT_EQ(sample.divergent, -1);
        }
      }
      EXPECT_TRUE(same_bits(at_once->state(), one_by_one->state())) << every;
    }
    std::vector<Vec3d> fast(scene_.specimen.size()), none(scene_.specimen.size());
    fast[5].y = 1e6;
    at_once->set_velocities(fast, none);
    EXPECT_EQ(at_once->advance_sampled(1, 2).front().divergent, 5);
  };
  StepperOptions slow = slow_options(scene_);
  std::tie(slow.precision, slow.form, slow.geometry) = std::tie(options_.precision, options_.form, options_.geometry);
  check("fast load", options_);
  check("slow load", slow);
  slow.observed_every = 60;
  check("blocks that end at samples", slow);
  check("a platen, a particle that is held, and weights", pushed());
}

TEST_P(StepperState, GoesOnToTheSameBits) {
  const auto check = [&](const char* what, const StepperOptions& options) {
    SCOPED_TRACE(what);
    const auto whole = stepper(options), first = stepper(options), second = stepper(options);
    whole->advance(400);
    first->advance(277);  // longer than any block of steps, so that arrays of a block are not zero
    const std::vector<StateArray> state = first->state();
    EXPECT_FALSE(same_bits(state, whole->state()));
    second->advance(5);  // the state that `second` has before set_state() must not matter
    second->set_state(state);
    EXPECT_TRUE(same_bits(second->state(), state));
    EXPECT_EQ(second->observe().top_force(), first->observe().top_force());
    second->advance(123);
    EXPECT_TRUE(same_bits(second->state(), whole->state()));
    EXPECT_EQ(second->observe().step, 400);
    EXPECT_EQ(second->observe().top_force(), whole->observe().top_force());
    const ParticleState a = whole->particles(), b = second->particles();
    for (std::size_t i = 0; i < a.velocity.size(); ++i) {
      ASSERT_EQ(a.force[i].x, b.force[i].x);
      ASSERT_EQ(a.spin[i].y, b.spin[i].y);
      ASSERT_EQ(a.displacement[i].z, b.displacement[i].z);
    }
    for (std::size_t k = 0; k < state.size(); ++k) {
      const std::string& name = state[k].name;
      // The step recomputes these arrays; only observe() reads the wall loads.
      if (name == "gathered_velocity" || name == "wall_loads") continue;
      // Zeroing any array must change the result; this finds arrays that the comparison would not notice.
      std::vector<StateArray> other = state;
      std::visit([](auto& list) { std::fill(list.begin(), list.end(), 0); }, other[k].values);
      second->set_state(other);
      second->advance(123);
      EXPECT_FALSE(same_bits(second->state(), whole->state())) << name;
    }
    second->set_state(state);
    second->advance(123);
    for (std::size_t k = 0; k < state.size(); ++k) {
      std::vector<StateArray> less = state;
      less.erase(less.begin() + static_cast<std::ptrdiff_t>(k));
      EXPECT_THROW(second->set_state(less), RunError) << state[k].name;
    }
    EXPECT_TRUE(same_bits(second->state(), whole->state())) << "a refused state was set in part";
  };
  StepperOptions slow = slow_options(scene_);
  std::tie(slow.precision, slow.form, slow.geometry) = std::tie(options_.precision, options_.form, options_.geometry);
  check("fast load", options_);
  check("slow load", slow);
  check("a platen, a particle that is held, and weights", pushed());
  scene_.laws = general_laws(scene_.laws, 5);
  check("laws of five units", options_);
  if (options_.form != ContactForm::points) return;
  scene_.laws.fill(laws::BrittleBond{2e10, 3e4, 2e4, 0.3});
  check("bonds, many of them broken", options_);
}

// A GPU with fewer multiprocessors divides the specimen into other tiles, or streams the tiles from memory. Such a GPU
// must give the same bits as a whole GPU, and must be able to continue from the state of a whole GPU. Elastic scenes
// have kernels of their own.
TEST_P(StepperState, IsThatOfADeviceOfAnySize) {
  if (backend_ != Backend::cuda) GTEST_SKIP() << "of devices alone";
  for (const Laws& laws : {am1_laws(), elastic_laws()}) {
    const TestScene scene = make_scene(random_specimen(22, 9, 9, 9), {}, laws);
    for (const StepperOptions& load : {shaking_options(scene), slow_options(scene)}) compare_sizes(scene, load);
  }
}
/// Returns an arbitrary complex motion for a start without physical meaning.
std::vector<std::complex<double>> some_motion(std::size_t particles) {
  std::mt19937 random(5);
  std::vector<std::complex<double>> out(6 * particles);
  const auto draw = [&] { return 1e-3 * (static_cast<double>(random()) / 4294967296.0 - 0.5); };
  for (auto& z : out) {
    const double real = draw();
    z = {real, draw()};
  }
  return out;
}

// Makes steppers from used ones, as a run does for consecutive frequencies. The used stepper had other steps, masses,
// loads and starts. The result must behave like a new stepper.
TEST_P(StepperState, OfAUsedStepperIsThatOfAFreshOne) {
  StepperOptions slow = slow_options(scene_);
  std::tie(slow.precision, slow.form, slow.geometry) = std::tie(options_.precision, options_.form, options_.geometry);
  StepperOptions slower = slow;
  drives::Cyclic at_70_hz = top_drive(slow), at_once = at_70_hz;
  at_70_hz.frequency = 70;
  at_70_hz.ramp_steps = at_once.ramp_steps = 0;
  slower.boundary = moving_top(at_70_hz);
  slower.dt = at_70_hz.dt();
  slower.density_scaling = 3;
  slower.blocks = 900;
  slower.observed_every = 60;
  slower.damping_kind = Damping::viscous;
  slower.damping = 100;
  StepperOptions started = slow;
  started.boundary = moving_top(at_once);
  const StartState start = steady_start(scene_.network, scene_.laws, some_motion(scene_.specimen.size()), at_once);
  started.start = &start;
  // blocks of steps end at these samples, although the run starts one step before a sample
  started.observed_every = 60;
  StepperOptions resting = slow;
  resting.boundary = {};
  const StepperOptions pushed = this->pushed();
  StepperOptions other_geometry = slow;
  other_geometry.geometry = slow.geometry == Geometry::fixed ? Geometry::updated : Geometry::fixed;
  struct Use {
    const char* name;
    const StepperOptions* options;
    /// Whether the CPU reuses the stepper. A GPU reuses fewer parts of it if the run before or after takes steps in
    /// blocks.
    bool kept;
  };
  std::unique_ptr<Stepper> used;
  for (const Use& use : {Use{"slow", &slow, false}, Use{"slower, heavier, damped", &slower, true},
                         Use{"from a steady state", &started, true}, Use{"slow again", &slow, true},
                         Use{"pushed", &pushed, true}, Use{"pushed again", &pushed, true}, Use{"fast", &options_, true},
                         Use{"fast again", &options_, true}, Use{"at rest", &resting, true},
                         Use{"of another geometry", &other_geometry, false}, Use{"slow once more", &slow, false}}) {
    SCOPED_TRACE(use.name);
    const Stepper* before = used.get();
    used = make_stepper(backend_, scene_.specimen, scene_.network, scene_.laws, scene_.inertia, *use.options,
                        std::move(used));
    if (use.kept && backend_ == Backend::cpu) { EXPECT_EQ(used.get(), before); }
    const auto fresh = stepper(*use.options);
    EXPECT_TRUE(same_bits(used->state(), fresh->state()));
    for (const std::int64_t steps : {1, 277}) {
      used->advance(steps);
      fresh->advance(steps);
      EXPECT_TRUE(same_bits(used->state(), fresh->state()));
      EXPECT_EQ(used->observe().step, steps == 1 ? 1 : 278);
      EXPECT_EQ(used->observe().top_force(), fresh->observe().top_force());
      EXPECT_EQ(used->first_divergent(), fresh->first_divergent());
    }
    EXPECT_EQ(used->description(), fresh->description());
    EXPECT_EQ(used->bytes(), fresh->bytes());
    EXPECT_EQ(used->traffic(), fresh->traffic());
  }
}

TEST_P(StepperState, OfAnotherPrecisionIsRefused) {
  StepperOptions other = options_;
  other.precision = options_.precision == Precision::single ? Precision::double_ : Precision::single;
  const std::vector<StateArray> state = stepper(options_)->state();
  const auto stranger = stepper(other);
  EXPECT_HAS(message_of([&] { stranger->set_state(state); }), "precision");
}

TEST(ReferenceState, IsNotKept) {
  const TestScene scene = make_scene(random_specimen(1, 2, 2, 2));
  const auto stepper = make_stepper(Backend::reference, scene.specimen, scene.network, scene.laws, scene.inertia,
                                    shaking_options(scene));
  EXPECT_HAS(message_of([&] { stepper->state(); }), "reference keeps no checkpoints");
  EXPECT_THROW(stepper->set_state({}), RunError);
}

}  // namespace
}  // namespace macadam::test
