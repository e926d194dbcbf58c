// SPDX-License-Identifier: GPL-3.0-or-later
/// \file sphere_grid.hpp  Finds the spheres that are within reach of a point, for spheres with any distribution of
/// sizes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "macadam/specimen.hpp"

namespace macadam {

/// A grid of nearly cubic cells over a box. Each sphere is inserted with a reach, a distance from its centre. Each cell
/// lists all spheres whose reach touches the cell. A query therefore looks into one cell only, and a few large spheres
/// among many small ones do not slow it down.
class SphereGrid {
 public:
  /// Makes cells with edges of about `cell` [m]; they are larger if there would be more than two million cells.
  SphereGrid(const Box& box, double cell);

  /// Empties the lists and keeps their memory.
  void clear();

  /// Adds the number `id` to the lists of all cells within `reach` of `centre`.
  void insert(std::int32_t id, const Vec3d& centre, double reach);

  std::size_t cells() const { return list_.size(); }

  /// layers() returns the number of layers (cells with equal z). layer_begin() returns the number of the first cell of
  /// a layer.
  std::size_t layers() const { return static_cast<std::size_t>(nz_); }
  std::size_t layer_begin(std::size_t layer) const { return layer * static_cast<std::size_t>(nx_ * ny_); }

  /// Calls visit(cell) for all cells of a layer within `reach` of a point.
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

  /// Returns the cell that contains a point of the box.
  std::size_t cell_of(const Vec3d& point) const;

  /// Returns the lower corner of a cell [m].
  Vec3d corner(std::size_t cell) const;

  /// Returns the edge lengths of the cells [m].
  const Vec3d& edge() const { return edge_; }

  /// Returns the spheres within reach of a cell, in the order of insertion.
  const std::vector<std::int32_t>& near(std::size_t cell) const { return list_[cell]; }

 private:
  /// Returns the first and the last cell along an axis that are within `reach` of `position`.
  static std::pair<std::int64_t, std::int64_t> range(double position, double reach, double edge, std::int64_t n);

  Vec3d edge_;
  std::int64_t nx_, ny_, nz_;
  std::vector<std::vector<std::int32_t>> list_;
};

}  // namespace macadam
