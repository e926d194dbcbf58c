// SPDX-License-Identifier: GPL-3.0-or-later
/// \file placement.hpp  Random positions: aggregates without overlap, mastic anywhere outside them.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "host/specimen/composition.hpp"
#include "host/specimen/random_stream.hpp"
#include "host/specimen/sphere_grid.hpp"
#include "macadam/specimen.hpp"

namespace macadam {

/// Places spheres one by one, uniformly over the room that is left to each.
class Placement {
 public:
  /// `specimen` receives the spheres and must outlive this; `smallest` is the smallest aggregate radius [m].
  Placement(Specimen& specimen, double smallest, std::int64_t attempts, RandomStream random);

  /// Adds all aggregates, largest first over all classes, inside the box and clear of each other.
  /// \throws RunError naming the class that found no room, and how much of it had.
  void place_aggregates(const std::vector<Population>& classes, const std::function<void(double share)>& progress);

  /// Adds the mastic with centres outside the aggregates; mastic spheres may overlap anything.
  void place_mastic(const Population& mastic);

  /// A random point of the box outside the aggregates.
  /// \throws RunError when `attempts` points all lay inside aggregates.
  Vec3d point_outside_aggregates();

 private:
  std::optional<Vec3d> position_for(double radius);
  Vec3d random_point(const Vec3d& low, const Vec3d& high);
  bool clear_of_placed(const Vec3d& point, double distance) const;
  std::vector<std::size_t> open_cells(double radius) const;
  void add(const Vec3d& centre, double radius, Phase phase);

  Specimen& specimen_;
  SphereGrid grid_;
  std::int64_t attempts_;
  RandomStream random_;
};

}  // namespace macadam
