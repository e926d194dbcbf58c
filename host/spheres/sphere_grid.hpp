// SPDX-License-Identifier: GPL-3.0-or-later
/// \file sphere_grid.hpp  Which spheres can matter at a point, for spheres of any mix of sizes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
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

  /// Cells of equal z, numbered upwards, and the first and the end of their cells.
  std::size_t layers() const { return static_cast<std::size_t>(nz_); }
  std::size_t layer_begin(std::size_t layer) const { return layer * static_cast<std::size_t>(nx_ * ny_); }

  /// Calls visit(cell) for all cells of a layer that are within `reach` of a point.
  template <class Visit>
  void within(const Vec3d& point, double reach, std::size_t layer, const Visit& visit) const {
    const auto gap2 = [](double p, double cell, double edge) {
      const double gap = std::max({cell * edge - p, p - (cell + 1) * edge, 0.0});
      return gap * gap;
    };
    const double in_z = gap2(point.z, static_cast<double>(layer), edge_.z), reach2 = reach * reach;
    if (in_z > reach2) return;
    const auto [x0, x1] = range(point.x, reach, edge_.x, nx_);
    const auto [y0, y1] = range(point.y, reach, edge_.y, ny_);
    for (std::int64_t y = y0; y <= y1; ++y) {
      const double in_yz = in_z + gap2(point.y, static_cast<double>(y), edge_.y);
      for (std::int64_t x = x0; x <= x1; ++x)
        if (in_yz + gap2(point.x, static_cast<double>(x), edge_.x) <= reach2)
          visit(layer_begin(layer) + static_cast<std::size_t>(y * nx_ + x));
    }
  }

  /// Cell of a point of the box.
  std::size_t cell_of(const Vec3d& point) const;

  /// Lower corner of a cell [m].
  Vec3d corner(std::size_t cell) const;

  /// Edge lengths of every cell [m].
  const Vec3d& edge() const { return edge_; }

  /// Spheres within reach of a cell, in the order of insertion.
  const std::vector<std::int32_t>& near(std::size_t cell) const { return list_[cell]; }

 private:
  /// First and last cell along an axis.
  static std::pair<std::int64_t, std::int64_t> range(double position, double reach, double edge, std::int64_t n);

  Vec3d edge_;
  std::int64_t nx_, ny_, nz_;
  std::vector<std::vector<std::int32_t>> list_;
};

}  // namespace macadam
