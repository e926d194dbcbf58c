// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shape_insertion.hpp  Inserts shaped bodies one after another, each at a random position where it touches no
/// earlier body.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "host/specimen/packing/shape_body.hpp"
#include "host/spheres/draws_ahead.hpp"
#include "host/spheres/sphere_grid.hpp"

namespace macadam {

/// Finds places for bodies in the order of their sizes, largest first.
class ShapeInsertion {
 public:
  /// `bodies` are all bodies that will be placed; they and `box` must outlive this object. Two bodies are at least
  /// `spacing` apart [m].
  ShapeInsertion(const Domain& box, const std::vector<ShapeBody>& bodies, double spacing, std::int64_t attempts,
                 RandomStream random);

  /// Sets the rotation and centre of body number `k` such that it is inside the box and touches no body placed so far.
  /// Returns false if `attempts` trials failed. Calls must be in ascending order of `k`; some bodies may be left out.
  /// Trials run on all threads; the result is the same as with one thread.
  bool place(std::size_t k, ShapeBody& body);

 private:
  /// Runs up to `most` trials and applies the first successful one to `body`.
  template <class Attempt>
  bool find(std::int64_t most, std::size_t draws, const Attempt& attempt, ShapeBody& body);
  static Vec3d point(Draws& draws, const Vec3d& from, const Vec3d& to);
  bool inside(const ShapeBody& body, const Extent& extent) const;
  /// Tests quickly, with the inner ball of the body only, whether the body touches a placed body. Returns false if so.
  bool clear_at_centre(const ShapeBody& body) const;
  /// Returns whether a body keeps the spacing to all placed bodies.
  bool clear(const ShapeBody& body) const;
  /// Returns the centre of a cell.
  Vec3d middle(std::size_t cell) const { return grid_.corner(cell) + 0.5 * grid_.edge(); }
  /// Updates room_ for the bodies placed since the last call.
  void measure_room(std::size_t k);
  /// Returns the cells that may contain the centre of body k.
  std::vector<std::size_t> open_cells(std::size_t k, double inner_radius);

  const Domain& box_;
  /// Entry k: the largest radius, and the largest inner radius, of the bodies from number k on [m].
  std::vector<double> radius_to_come_, inner_to_come_;
  SphereGrid near_;  ///< for each cell, the placed bodies that a body not yet placed may touch
  SphereGrid grid_;  ///< fine cells for room_; their lists are not used
  double spacing_;   ///< [m]
  std::int64_t attempts_;
  DrawsAhead random_;
  std::vector<ShapeBody> placed_;
  /// For each cell: an upper bound of the distance from its middle to the first `measured_` bodies and the walls [m].
  std::vector<double> room_;
  std::size_t measured_ = 0;
};

}  // namespace macadam
