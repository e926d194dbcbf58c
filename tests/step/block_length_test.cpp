// SPDX-License-Identifier: GPL-3.0-or-later
// block_length_test.cpp  Tests the number of time steps per block. A block is a group of steps, at the end of which the
// viscoelastic states are updated. It lasts a set fraction of the shortest time scale of laws and load, and ends at
// observations if that costs little.
#include "kernels/step/block_length.hpp"

#include <gtest/gtest.h>

#include "tests/support/test_networks.hpp"

namespace macadam::test {
namespace {

using kernels::block_steps;
constexpr Vec3d size{0.05, 0.05, 0.1};

/// Returns options with a load of 10 Hz and 1e6 steps per period. With the law lasting() and fixed geometry, the period
/// of 0.1 s is the shortest time scale.
StepperOptions options_of_10_hz() {
  StepperOptions out;
  const drives::Cyclic loading(1e-5, 10, 1000000);
  out.boundary = moving_top(loading);
  out.dt = loading.dt();
  out.geometry = Geometry::fixed;
  return out;
}
Laws elastic() {
  Laws out;
  out[0] = laws::Elastic{1e10, 0};
  return out;
}
/// Returns a law whose relaxation time is longer than the period of any load here.
Laws lasting() {
  Laws out;
  out[0] = laws::GeneralisedKelvin{1e10, 1e15, {}, {}, 0};
  return out;
}

/// By default a block of steps lasts 1/4000 of the shortest time scale. This may be a time scale of the load, of a law,
/// or of the rotation of contacts in updated geometry.
TEST(BlockLength, IsAFourThousandthOfTheShortestTimeWhereNobodyAsks) {
  StepperOptions options = options_of_10_hz();
  EXPECT_EQ(block_steps(options, facts_of(lasting()), size), 250);
  Laws slow = lasting();
  slow[1] = laws::GeneralisedKelvin{1e10, 1e8, {}, {}, 0};  // its time scale is 2π times the relaxation time of 0.01 s
  EXPECT_EQ(block_steps(options, facts_of(slow), size), 157);
  // The time scale of the geometry is 4e-3 / (1e-4·20π/s) = 0.64 s, longer than the period of the load, 0.1 s.
  options.geometry = Geometry::updated;
  EXPECT_EQ(block_steps(options, facts_of(lasting()), size), 250);
  // The time scale of the geometry is 4e-3 / (1e-2·20π/s) = 6.4e-3 s, shorter than the period of the load, 0.1 s.
  options.boundary = moving_top(drives::Cyclic(1e-3, 10, 1000000));
  EXPECT_EQ(block_steps(options, facts_of(lasting()), size), 15);
  options.boundary = {};
  EXPECT_EQ(block_steps(options, facts_of(lasting()), size), 0);
}

/// With elastic laws and fixed geometry nothing changes within a block, so the block may be longer. If only one law has
/// a memory, or if the geometry is updated, the block must be short.
TEST(BlockLength, IsLongerWhereNothingHasAMemory) {
  StepperOptions options = options_of_10_hz();
  EXPECT_EQ(block_steps(options, facts_of(elastic()), size), kernels::longest_block);
  options.blocks = 20000;
  EXPECT_EQ(block_steps(options, facts_of(lasting()), size), 50);
  EXPECT_EQ(block_steps(options, facts_of(elastic()), size), 500);
  options.blocks = 200;
  options.dt *= 10;
  EXPECT_EQ(block_steps(options, facts_of(lasting()), size), 500);
  // without a memory a block could be longer than 500 steps, but then rounding errors would be larger
  EXPECT_EQ(block_steps(options, facts_of(elastic()), size), 500);
  options.blocks = 20000;
  options.dt /= 10;
  Laws one_of_two = elastic();
  one_of_two[1] = lasting()[0];
  EXPECT_EQ(block_steps(options, facts_of(one_of_two), size), 50);
  options.geometry = Geometry::updated;
  EXPECT_EQ(block_steps(options, facts_of(elastic()), size), 50);
}

TEST(BlockLength, FollowsTheNumberOfBlocks) {
  StepperOptions options = options_of_10_hz();
  options.blocks = 8000;
  EXPECT_EQ(block_steps(options, facts_of(lasting()), size), 125);
  options.blocks = 1e6 / 3.9;  // blocks of three steps would not save time, so the steps are not grouped
  EXPECT_EQ(block_steps(options, facts_of(lasting()), size), 0);
  options.blocks = 10;  // gives the longest block for which sums over its steps are still accurate in single precision
  EXPECT_EQ(block_steps(options, facts_of(lasting()), size), kernels::longest_block);
}

/// A block is shortened so that its length divides the observation interval, unless that makes the block much shorter.
TEST(BlockLength, EndsAtObservationsWhereThatIsNotMuchShorter) {
  StepperOptions options = options_of_10_hz();
  const auto steps = [&](std::int64_t observed_every) {
    options.observed_every = observed_every;
    return block_steps(options, facts_of(lasting()), size);
  };
  EXPECT_EQ(steps(0), 250);
  EXPECT_EQ(steps(500), 250);
  EXPECT_EQ(steps(212), 212);
  EXPECT_EQ(steps(424), 212);
  EXPECT_EQ(steps(600), 200);
  EXPECT_EQ(steps(251), 250);  // 251 is a prime number, so no useful length divides it
  EXPECT_EQ(steps(100), 200);  // two observations per block
  EXPECT_EQ(steps(1), 250);
}

// The number of steps per block changes from 1 to 50. The block that ends must update its state for its own length, 1
// step. The next block must be prepared for the new length, 50 steps.
TEST(BlockLength, MayChangeFromABlockToTheNext) {
  const laws::GeneralisedKelvin law = mastic_am1();
  constexpr double dt = 1e-5;
  const auto changed = kernels::block_after(law, dt, 1, 50), one = law.block(dt, 1), fifty = law.block(dt, 50);
  const auto settled = [&](const auto& block) {
    std::vector<double> x{1e-3, 2e-3, 3e-3};
    block.template settle<-1>(1e6, [&](int l) -> double& { return x[static_cast<std::size_t>(l)]; });
    return x;
  };
  const auto drive = [&](const auto& block) {
    std::vector<double> x{1e-3, 2e-3, 3e-3};
    return block.template drift<-1>(1e6, [&](int l) -> double& { return x[static_cast<std::size_t>(l)]; });
  };
  EXPECT_EQ(settled(changed), settled(one));
  EXPECT_NE(settled(changed), settled(fifty));
  EXPECT_EQ(drive(changed), drive(fifty));
  EXPECT_NE(drive(changed), drive(one));
  EXPECT_EQ(settled(kernels::block_after(law, dt, 50, 50)), settled(fifty));
}

}  // namespace
}  // namespace macadam::test
