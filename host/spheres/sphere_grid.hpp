// SPDX-License-Identifier: GPL-3.0-or-later
/// \file sphere_grid.hpp  Which spheres can matter at a point, for spheres of any mix of sizes.
#pragma once

#include <cstdint>
#include <vector>

#include "macadam/specimen.hpp"

namespace macadam {

/// Cubic cells over a box. Each cell lists the spheres whose reach touches it, so a query looks into one cell only and
/// a few large spheres among many small ones cost nothing extra.
class SphereGrid {
 public:
  /// Cells of edge about `cell` [m], coarser where that would make more than two million of them.
  SphereGrid(const Box& box, double cell);

  /// Empties the cells and keeps their memory.
  void clear();

  /// Adds number `id` to every cell within `reach` of `centre`.
  void insert(std::int32_t id, const Vec3d& centre, double reach);

  std::size_t cells() const { return list_.size(); }

  /// Cell of a point of the box.
  std::size_t cell_of(const Vec3d& point) const;

  /// Lower corner of a cell [m].
  Vec3d corner(std::size_t cell) const;

  /// Edge lengths of every cell [m].
  const Vec3d& edge() const { return edge_; }

  /// Spheres within reach of a cell, in the order of insertion.
  const std::vector<std::int32_t>& near(std::size_t cell) const { return list_[cell]; }

 private:
  Vec3d edge_;
  std::int64_t nx_, ny_, nz_;
  std::vector<std::vector<std::int32_t>> list_;
};

}  // namespace macadam
