// SPDX-License-Identifier: GPL-3.0-or-later
/// \file block_length.hpp  Chooses the number of steps of a block, after which the viscoelastic states are updated, and
/// computes the coefficients of a block.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <variant>

#include "macadam/stepper.hpp"

namespace macadam::kernels {

/// Largest number of steps in a block. Sums over the steps of a block are in single precision. Up to 1024 steps, their
/// rounding errors do not grow with the number of steps (bench/block_precision.cpp); longer blocks were not measured.
inline constexpr int longest_block = 1024;

/// Returns whether blocks are exact: no law has a memory, and contacts keep their initial geometry.
inline bool blocks_are_exact(Geometry geometry, const FactsTable& laws) {
  const auto has_none = [](const auto& law) { return !law || law->memoryless; };
  return geometry == Geometry::fixed && std::all_of(laws.begin(), laws.end(), has_none);
}

/// Number of blocks of steps within the shortest characteristic time of the load that is sufficient if blocks are
/// exact. The change of f within such a block, which is rounded, is a small part of the amplitude of f; and when the
/// block ends, f is computed afresh from the displacements.
inline constexpr double exact_blocks = 400;

/// Returns the number of steps of a block, at most longest_block. A block is at most the shortest characteristic time
/// of the load or the laws, divided by `options.blocks` (exact blocks: up to ten times that). With updated geometry,
/// the shortest time is at most 4,000 times the time in which a normal turns by 1e-6 at the specimen's strain rate. If
/// possible, the length of a block divides the interval between observations or is a multiple of it; otherwise a block
/// ends early at each observation. Returns 0 in four cases: blocks would be too short to save time; no wall is driven
/// by a displacement, so it is unknown how fast the load changes; a law cannot be stepped in blocks; a wall is driven
/// by a force, so the sum of its loads is needed at every step. `size`: edges of the specimen [m].
inline int block_steps(const StepperOptions& options, const FactsTable& laws, const Vec3d& size) {
  if (!options.boundary.any(DrivenBy::displacement) || options.boundary.any(DrivenBy::force)) return 0;
  constexpr double pi = std::numbers::pi;
  double shortest = std::numeric_limits<double>::infinity();
  const double extent[3] = {size.x, size.y, size.z};
  for (std::size_t w = 0; w < wall_count; ++w) {
    for (const WallAxis& axis : options.boundary.wall[w].axis) {
      if (axis.by != DrivenBy::displacement) continue;
      shortest = std::min(shortest, axis.drive->shortest_time());
      const double strain_rate = axis.drive->fastest() / extent[w / 2];  // along the wall's normal
      if (options.geometry == Geometry::updated && strain_rate > 0)
        shortest = std::min(shortest, 4000 * 1e-6 / strain_rate);
    }
  }
  for (const auto& law : laws) {
    if (!law) continue;
    if (!law->blocks) return 0;
    shortest = std::min(shortest, 2 * pi * law->shortest_time);
  }
  double blocks = options.blocks;
  if (blocks_are_exact(options.geometry, laws)) blocks = std::min(blocks, std::max(exact_blocks, blocks / 10));
  const auto most =
      static_cast<std::int64_t>(std::min<double>(longest_block, std::floor(shortest / (blocks * options.dt))));
  if (most < 4) return 0;
  // If blocks were shorter than half of `most`, their updates would cost more time than is saved by ending blocks at
  // observations.
  for (std::int64_t steps = most; 2 * steps >= most; --steps) {
    const std::int64_t observed = options.observed_every;
    if (observed > 0 && (observed % steps == 0 || steps % observed == 0)) return static_cast<int>(steps);
  }
  return static_cast<int>(most);
}

/// Returns the coefficients of the law for a block of `steps` steps that follows a block of `ended` steps.
template <class L>
typename L::Block block_after(const L& law, double dt, int ended, int steps) {
  typename L::Block out = law.block(dt, steps);
  if (ended != steps) out.settled_as(law.block(dt, ended));
  return out;
}

}  // namespace macadam::kernels
