// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shape_insertion.hpp  Random places one after another, each clear of all before it.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "host/specimen/shape_body.hpp"
#include "host/spheres/sphere_grid.hpp"

namespace macadam {

/// Finds places for bodies that come in the order of their sizes, largest first.
class ShapeInsertion {
 public:
  /// `bodies` are those that will come; they and `box` must outlive this.
  ShapeInsertion(const Box& box, const std::vector<ShapeBody>& bodies, std::int64_t attempts, RandomStream random);

  /// Turns body number `k` and moves it to where it is inside the box and touches nothing placed so far; false where
  /// `attempts` rotations and positions all failed. Bodies come in order; one may be left out.
  bool place(std::size_t k, ShapeBody& body);

 private:
  bool clear(const ShapeBody& body) const;
  std::vector<std::size_t> open_cells(double inner_radius) const;

  const Box& box_;
  std::vector<double> radius_to_come_;  ///< largest of this body and those after it [m]
  SphereGrid grid_;
  std::int64_t attempts_;
  RandomStream random_;
  std::vector<ShapeBody> placed_;
};

}  // namespace macadam
