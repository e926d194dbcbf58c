// SPDX-License-Identifier: GPL-3.0-or-later
/// \file placement.hpp  Places spheres at random positions: aggregates without overlap, mastic anywhere outside them.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "host/specimen/composition.hpp"
#include "host/spheres/draws_ahead.hpp"
#include "host/spheres/sphere_grid.hpp"
#include "macadam/specimen.hpp"

namespace macadam {

/// Places spheres one by one, each with a uniform distribution over the positions that are free for it. Trials run on
/// all threads; the positions are those that a single thread would find.
class Placement {
 public:
  /// `specimen` receives the spheres and must outlive this object. `smallest` is the smallest aggregate radius [m].
  /// `attempts` is the number of trials for one sphere. `taken` returns whether a point is inside an object that is not
  /// a sphere (a shape); it is called from several threads. `origin` is the origin of the recipe (file and line), for
  /// messages. `largest_void` is the radius of the largest void that will be placed [m].
  Placement(Specimen& specimen, double smallest, std::int64_t attempts, RandomStream random, const Origin& origin,
            std::function<bool(const Vec3d&)> taken = {}, double largest_void = 0);

  /// Adds all aggregates inside the domain and at least `spacing` [m] apart, largest first over all classes. Returns
  /// the class of each. \throws RunError naming the class that does not fit, and how much of it was placed.
  std::vector<std::int32_t> place_aggregates(const std::vector<Population>& classes, double spacing,
                                             const std::function<void(double share)>& progress);

  /// Adds a sphere of aggregate number `body` at a given position. Spheres that are placed later, and are not larger
  /// than this sphere, keep at least the distance `spacing` [m] from this sphere.
  void add_aggregate(const Vec3d& centre, double radius, std::int32_t body, double spacing = 0);

  /// Adds voids inside the domain, clear of each other and of all spheres placed so far. Voids are stored as aggregates
  /// with body numbers from `body` on. \throws RunError saying how many were placed.
  void place_voids(const Population& voids, std::int32_t body);

  /// Adds the mastic at random positions whose centres are outside the aggregates. Mastic spheres may overlap anything.
  void place_mastic(const Population& mastic);

  /// Returns a random point of the domain outside the aggregates. \throws RunError if `attempts` points were all inside
  /// aggregates.
  Vec3d point_outside_aggregates();

 private:
  /// Returns a random centre for a sphere, if there is room for one.
  std::optional<Vec3d> position_for(double radius, double spacing);
  [[noreturn]] void no_room_for_mastic() const;
  const Domain& domain() const { return specimen_.box; }
  /// Returns whether a point of the bounding box is inside the domain and outside the aggregates.
  bool free_for_mastic(const Vec3d& point) const;
  /// Returns whether a sphere of radius `distance` at this point overlaps no placed sphere and its centre is not taken.
  bool clear_of_placed(const Vec3d& point, double distance) const;
  /// Returns the cells of the grid that may have room for the centre of a sphere.
  std::vector<std::size_t> open_cells(double radius) const;
  /// Appends a sphere to the specimen.
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
