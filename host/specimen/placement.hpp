// SPDX-License-Identifier: GPL-3.0-or-later
/// \file placement.hpp  Random positions: aggregates without overlap, mastic anywhere outside them.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "host/specimen/composition.hpp"
#include "host/spheres/draws_ahead.hpp"
#include "host/spheres/sphere_grid.hpp"
#include "macadam/specimen.hpp"

namespace macadam {

/// Places spheres one by one, uniformly over the room that is left to each. Tries run on all threads; the places are
/// those that one thread alone would have found.
class Placement {
 public:
  /// `specimen` receives the spheres and must outlive this; `smallest` is the smallest aggregate radius [m]; `taken`
  /// tells of points where nothing else may be, on several threads at a time; `origin` is the recipe's; `largest_void`:
  /// radius of the largest of the voids that will be placed [m].
  Placement(Specimen& specimen, double smallest, std::int64_t attempts, RandomStream random, const Origin& origin,
            std::function<bool(const Vec3d&)> taken = {}, double largest_void = 0);

  /// Adds all aggregates, largest first over all classes, inside the box and `spacing` [m] from each other; returns the
  /// class of each. \throws RunError naming the class that found no room, and how much of it had.
  std::vector<std::int32_t> place_aggregates(const std::vector<Population>& classes, double spacing,
                                             const std::function<void(double share)>& progress);

  /// Adds a sphere of aggregate number `body` where it is; none larger that comes later is nearer than `spacing` [m].
  void add_aggregate(const Vec3d& centre, double radius, std::int32_t body, double spacing = 0);

  /// Adds voids inside the box, clear of each other and of all that is there, as if they were aggregates: bodies from
  /// `body` on. \throws RunError naming how many found room.
  void place_voids(const Population& voids, std::int32_t body);

  /// Adds the mastic with centres outside the aggregates; mastic spheres may overlap anything.
  void place_mastic(const Population& mastic);

  /// A random point of the box outside the aggregates.
  /// \throws RunError when `attempts` points all lay inside aggregates.
  Vec3d point_outside_aggregates();

 private:
  std::optional<Vec3d> position_for(double radius, double spacing);
  [[noreturn]] void no_room_for_mastic() const;
  /// Whether a sphere of radius `distance` would overlap none, with its centre where nothing is taken.
  bool clear_of_placed(const Vec3d& point, double distance) const;
  std::vector<std::size_t> open_cells(double radius) const;
  void add(const Vec3d& centre, double radius, Phase phase, std::int32_t body);

  Specimen& specimen_;
  SphereGrid grid_;
  std::int64_t attempts_;
  DrawsAhead random_;
  Origin origin_;
  std::function<bool(const Vec3d&)> taken_;
  double largest_void_;
};

}  // namespace macadam
