// SPDX-License-Identifier: GPL-3.0-or-later
/// \file block_length.hpp  How many steps are taken before the laws are settled, and with which coefficients.
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

/// Sums over the steps of a block are in single precision: up to here more steps do not round worse
/// (bench/block_precision.cpp); beyond, it was not looked at.
inline constexpr int longest_block = 1024;

/// Whether a block neglects nothing: no law has a memory, and contacts keep the geometry of the start.
inline bool blocks_are_exact(Geometry geometry, const FactsTable& laws) {
  const auto has_none = [](const auto& law) { return !law || law->memoryless; };
  return geometry == Geometry::fixed && std::all_of(laws.begin(), laws.end(), has_none);
}

/// So many blocks in the load's shortest time are then enough: the change within one, which is rounded, is a small part
/// of the force's amplitude, and forces are made anew of the displacements when it ends.
inline constexpr double exact_blocks = 400;

/// Steps of a block: at most longest_block, at most the `options.blocks`-th part of the shortest time in the load or
/// the laws (exact ones up to ten times that), and so few that at the specimen's strain a carried normal turns by less
/// than 1e-6 in a 4,000th of that time. Where this allows it, blocks end at the observations, which otherwise cut them.
/// 0: blocks would be too short to pay, or nothing says how fast the load changes, a law has no blocks, or a wall
/// follows a force, which needs the sum on it at every step. `size`: of the specimen [m].
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
  for (std::int64_t steps = most; 2 * steps >= most; --steps) {  // of less than half, more would be lost than is won
    const std::int64_t observed = options.observed_every;
    if (observed > 0 && (observed % steps == 0 || steps % observed == 0)) return static_cast<int>(steps);
  }
  return static_cast<int>(most);
}

/// The coefficients with which a block of `steps` is begun where the one before it had `ended` steps.
template <class L>
typename L::Block block_after(const L& law, double dt, int ended, int steps) {
  typename L::Block out = law.block(dt, steps);
  if (ended != steps) out.settled_as(law.block(dt, ended));
  return out;
}

}  // namespace macadam::kernels
