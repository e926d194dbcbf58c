// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shape_insertion.hpp  Random places one after another, each clear of all before it.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "host/specimen/shape_body.hpp"
#include "host/spheres/draws_ahead.hpp"
#include "host/spheres/sphere_grid.hpp"

namespace macadam {

/// Finds places for bodies that come in the order of their sizes, largest first.
class ShapeInsertion {
 public:
  /// `bodies` are those that will come; they and `box` must outlive this. Two are at least `spacing` apart [m].
  ShapeInsertion(const Box& box, const std::vector<ShapeBody>& bodies, double spacing, std::int64_t attempts,
                 RandomStream random);

  /// Turns body number `k` and moves it to where it is inside the box and touches nothing placed so far; false where
  /// `attempts` rotations and positions all failed. Bodies come in order; one may be left out. Tries run on all
  /// threads; the place is the one that the first good try of one thread alone would have found.
  bool place(std::size_t k, ShapeBody& body);

 private:
  template <class Attempt>
  bool find(std::int64_t most, std::size_t draws, const Attempt& attempt, ShapeBody& body);
  static Vec3d point(Draws& draws, const Vec3d& from, const Vec3d& to);
  bool inside(const ShapeBody& body, const Extent& extent) const;
  bool clear_at_centre(const ShapeBody& body) const;
  bool clear(const ShapeBody& body) const;
  Vec3d middle(std::size_t cell) const { return grid_.corner(cell) + 0.5 * grid_.edge(); }
  void measure_room(std::size_t k);
  std::vector<std::size_t> open_cells(std::size_t k, double inner_radius);

  const Box& box_;
  std::vector<double> radius_to_come_, inner_to_come_;  ///< largest of this body and those after it [m]
  SphereGrid near_;                                     ///< lists the bodies that one to come may touch
  SphereGrid grid_;                                     ///< cells that may be open; no lists
  double spacing_;                                      ///< [m]
  std::int64_t attempts_;
  DrawsAhead random_;
  std::vector<ShapeBody> placed_;
  std::vector<double>
      room_;  ///< at most, from the middle of each cell to the first `measured_` bodies and the walls [m]
  std::size_t measured_ = 0;
};

}  // namespace macadam
