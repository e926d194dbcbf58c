// SPDX-License-Identifier: GPL-3.0-or-later
/// \file sphere_bins.hpp  Sorts spheres of similar size into the cells of a grid by their centres.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "macadam/specimen.hpp"

namespace macadam {

/// Centre and radius of a sphere [m], adjacent in memory because they are always used together.
struct Ball {
  Vec3d centre;
  double radius;
};

/// Returns the spheres of a specimen in the order of the specimen.
std::vector<Ball> balls_of(const Specimen& specimen);

/// A grid over the box in which each sphere belongs to the cell of its centre. The spheres of a row of cells along x
/// are contiguous, so that a query reads only a few pieces of memory. The distance to which a query searches depends on
/// the largest sphere, so the spheres should be of similar size.
class SphereBins {
 public:
  /// Takes the spheres with the indices `ids`, in ascending order. `skin` [m] is the distance that queries add to the
  /// sum of two radii.
  SphereBins(const Box& box, std::span<const Ball> spheres, std::vector<std::int32_t> ids, double skin);

  /// Sorts all spheres again by their present centres.
  void sort(std::span<const Ball> spheres);

  /// Moves one sphere. Until the next sort(), every query visits all spheres that were moved, so call sort() when there
  /// are many.
  void move(std::int32_t id, const Vec3d& centre);
  /// Returns the number of spheres moved since the last sort().
  std::size_t moved() const { return ball_.size() - given_.size(); }

  double largest() const { return largest_; }
  /// ball() returns the sphere at a slot, and id() returns its index. Slots are numbered cell by cell.
  const Ball& ball(std::size_t slot) const { return ball_[slot]; }
  std::int32_t id(std::size_t slot) const { return id_[slot]; }

  /// ids() returns the indices given to the constructor. in_order() returns them sorted by cell, provided that no
  /// sphere was moved.
  std::span<const std::int32_t> ids() const { return given_; }
  std::span<const std::int32_t> in_order() const { return id_; }

  /// Calls visit(first, last) for ranges of slots that contain all spheres with centres within `range` [m] of a point.
  template <class Visit>
  void near(const Vec3d& point, double range, const Visit& visit) const {
    const auto [x0, x1] = x_.between(point.x - range, point.x + range);
    const auto [y0, y1] = y_.between(point.y - range, point.y + range);
    const auto [z0, z1] = z_.between(point.z - range, point.z + range);
    for (std::int64_t z = z0; z <= z1; ++z)
      for (std::int64_t y = y0; y <= y1; ++y) {
        const std::int64_t row = (z * y_.cells + y) * x_.cells;
        const std::uint32_t first = start_[row + x0], last = start_[row + x1 + 1];
        if (first < last) visit(first, last);
      }
    if (moved() > 0) visit(static_cast<std::uint32_t>(given_.size()), static_cast<std::uint32_t>(ball_.size()));
  }

 private:
  struct Axis {
    std::int64_t cells = 1;
    double per_length = 0;  ///< cells per metre

    std::int64_t cell(double x) const;
    std::pair<std::int64_t, std::int64_t> between(double low, double high) const { return {cell(low), cell(high)}; }
  };

  std::vector<std::int32_t> given_;
  double largest_ = 0;  ///< largest radius of a sphere [m]
  Axis x_, y_, z_;
  std::vector<std::uint32_t> start_;           ///< first slot of each cell, and the end
  std::vector<std::uint32_t> cell_, slot_of_;  ///< cell and slot of each sphere in given_
  std::vector<Ball> ball_;  ///< sorted by cell, then by index; spheres that were moved follow at the end
  std::vector<std::int32_t> id_;
};

}  // namespace macadam
