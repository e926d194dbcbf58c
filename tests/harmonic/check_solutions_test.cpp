// SPDX-License-Identifier: GPL-3.0-or-later
// check_solutions_test.cpp  The check of harmonic solutions computes several tasks (frequencies) at once in vector
// registers. These tests compare it with a plain loop over contacts in complex numbers.
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <numbers>

#include "host/harmonic/check_solutions.hpp"
#include "host/harmonic/harmonic_code.hpp"
#include "tests/support/stepper_cases.hpp"
#include "tests/support/test_networks.hpp"

namespace macadam::test {
namespace {

using harmonic::LinearTask;
using harmonic::SolutionCheck;
using Complex = std::complex<double>;

/// Returns a task with an arbitrary motion, which is not a solution, and with a stiffness and inertia that depend on
/// `number`.
LinearTask any_task(const TestScene& scene, int number) {
  const std::size_t n = scene.specimen.size();
  LinearTask task;
  task.stiffness = harmonic::pair_stiffness(scene.laws, Complex(0, 10.0 * (number + 1)));
  task.inertia = number % 2 == 0 ? Complex(1e7 * (number + 1), -1e6) : 0;
  task.right = harmonic::ContactOperator(scene.network, n).wall_loads(task.stiffness);
  for (std::size_t i = 0; i < 6 * n; ++i) {
    task.motion.emplace_back(std::sin(1.0 + double(i) * (number + 1)), std::cos(double(i)));
  }
  return task;
}

/// Computes the same check with the contact operator and a loop over the contacts.
SolutionCheck one_by_one(const TestScene& scene, const LinearTask& task) {
  SolutionCheck out;
  harmonic::Vector rest;
  harmonic::ContactOperator(scene.network, scene.specimen.size())
      .resistance(task.stiffness, task.inertia, scene.inertia, task.motion, rest);
  for (Complex& z : rest) z = -z;
  for (const harmonic::ParticleLoad& on : task.right) {
    for (std::size_t c = 0; c < 6; ++c) rest[6 * static_cast<std::size_t>(on.particle) + c] += on.load[c];
  }
  out.residual = out.beyond_rounding = harmonic::length(rest);
  for (std::size_t i = 0; i < rest.size(); ++i) {
    out.inertia += harmonic::inertia_at(scene.inertia, i) * task.motion[i] * task.motion[i];
  }
  for (const Contact& c : scene.network.contacts) {
    const std::array<Complex, 6> u = harmonic::relative_motion(c, task.motion, task.wall);
    const auto load = harmonic::facet_load(c, task.stiffness, u);
    const auto pair = static_cast<std::size_t>(c.pair);
    out.parts.normal[pair] += load.n * u[0] - load.moment_t * u[1] + load.moment_s * u[2];
    out.parts.shear[pair] += load.s * u[3] + load.t * u[4] + load.moment_n * u[5];
  }
  return out;
}

// Checks one task, several tasks that do not fill a block of four, and more than one block.
TEST(CheckSolutions, FindsWhatContactsSayOneByOne) {
  const TestScene scene = make_scene(random_specimen(test_seed(), 8, 8, 12));
  for (const int count : {1, 3, 4, 6}) {
    std::vector<LinearTask> tasks;
    std::vector<const LinearTask*> asked;
    for (int f = 0; f < count; ++f) tasks.push_back(any_task(scene, f));
    for (const LinearTask& task : tasks) asked.push_back(&task);
    const std::vector<SolutionCheck> found =
        harmonic::harmonic_code().check_solutions(scene.network, scene.inertia, asked, 0);
    ASSERT_EQ(found.size(), tasks.size());
    for (std::size_t f = 0; f < tasks.size(); ++f) {
      const SolutionCheck expected = one_by_one(scene, tasks[f]);
      // The sums run over a few thousand contacts with a dozen products each, of random signs.
      constexpr double rounding = 1e-13;
      EXPECT_NEAR(found[f].residual, expected.residual, rounding * expected.residual);
      EXPECT_EQ(found[f].beyond_rounding, found[f].residual);
      if (tasks[f].inertia != 0.0) {
        EXPECT_NEAR(std::abs(found[f].inertia - expected.inertia), 0, rounding * std::abs(expected.inertia));
      }
      double scale = 0;
      for (const Complex& e : expected.parts.normal) scale = std::max(scale, std::abs(e));
      for (std::size_t pair = 0; pair < pair_types; ++pair) {
        EXPECT_NEAR(std::abs(found[f].parts.normal[pair] - expected.parts.normal[pair]), 0, rounding * scale) << pair;
        EXPECT_NEAR(std::abs(found[f].parts.shear[pair] - expected.parts.shear[pair]), 0, rounding * scale) << pair;
      }
    }
  }
}

/// The result of the check does not depend on the number of threads, bit by bit.
TEST(CheckSolutions, TheSameBitsForAnyNumberOfThreads) {
  const TestScene scene = make_scene(random_specimen(test_seed(), 8, 8, 12));
  const LinearTask task = any_task(scene, 0);
  const int before = omp_get_max_threads();
  std::vector<SolutionCheck> found;
  for (const int threads : {1, 2, 5}) {
    omp_set_num_threads(threads);
    found.push_back(
        harmonic::harmonic_code().check_solutions(scene.network, scene.inertia, {&task, &task}, 1e-16).back());
  }
  omp_set_num_threads(before);
  for (const SolutionCheck& f : found) {
    EXPECT_EQ(f.residual, found[0].residual);
    EXPECT_EQ(f.beyond_rounding, found[0].beyond_rounding);
    EXPECT_EQ(f.parts.modulus(), found[0].parts.modulus());
  }
}

// Checks how much rounding is subtracted from a residual. One particle rotates by 2i (i² = −1) about y with an arm of
// 3/4, and the other is at rest, so points move by at most 3/2. For every stiffness k, |Re k| + |Im k| is 7. Distance
// and area are 1, and the second moments are 3/4 and 1/4. Without cancellation the force is 7·3/2, and the moment is
// 7·(3/4 + 1/4)·2 plus the force times the arm. A hundredth of this force and moment is subtracted from each actual
// load.
TEST(CheckSolutions, RoundingIsAShareOfLoadsThatDoNotCancel) {
  HandMade made = two_sphere_network();
  Contact& c = made.network.contacts.front();
  c.length = c.distance = 1, c.arm_a = 0.75, c.arm_b = 0.25;
  c.moments = {1, 0, 0, 0.75, 0, 0.25};
  LinearTask task;
  task.stiffness.k.fill({3, 4});
  task.motion.resize(12);
  task.motion[4] = {0, 2};
  harmonic::Vector loads;
  harmonic::ContactOperator(made.network, 2).resistance(task.stiffness, 0.0, made.inertia, task.motion, loads);
  constexpr double rounding = 0.01;
  const double force = 10.5, moment[2] = {14 + 0.75 * force, 14 + 0.25 * force};
  double squares = 0;
  for (std::size_t i = 0; i < 12; ++i) {
    const double largest = i % 6 < 3 ? force : moment[i / 6];
    const double beyond = std::max(std::abs(loads[i]) - rounding * largest, 0.0);
    squares += beyond * beyond;
  }
  for (const std::size_t count : {1, 2}) {
    const std::vector<const LinearTask*> asked(count, &task);
    const SolutionCheck found =
        harmonic::harmonic_code().check_solutions(made.network, made.inertia, asked, rounding).back();
    EXPECT_LT(found.beyond_rounding, 0.999 * found.residual);
    EXPECT_NEAR(found.beyond_rounding, std::sqrt(squares), 1e-14 * found.residual);  // sums of about ten products
  }
}

}  // namespace
}  // namespace macadam::test
