// SPDX-License-Identifier: GPL-3.0-or-later
/// \file columns.hpp  Computes the intersections of bodies with a row of parallel columns (rays along z), and volumes
/// from them.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "macadam/shape.hpp"

namespace macadam {

/// A point on a column where the number of bodies that contain it changes by `step`.
struct Crossing {
  double z;
  int step;
};
using Column = std::vector<Crossing>;

/// Calls visit(low, high) for every interval of the column that lies in at least one body. Sorts the column.
template <class Visit>
void for_each_part(Column& column, const Visit& visit) {
  std::sort(column.begin(), column.end(),
            [](const Crossing& a, const Crossing& b) { return a.z < b.z || (a.z == b.z && a.step > b.step); });
  int depth = 0;
  double low = 0;
  for (const auto& [z, step] : column) {
    if (depth == 0) low = z;
    depth += step;
    if (depth == 0) visit(low, z);
  }
}

/// A row of columns parallel to z with a common y. Column i is at x0 + i·edge.
struct ColumnRow {
  double y, x0, edge;
  std::vector<Column> column;

  double x(std::size_t i) const { return x0 + static_cast<double>(i) * edge; }
  /// Returns the range [first, last) of the columns with low ≤ x ≤ high.
  std::pair<std::size_t, std::size_t> between(double low, double high) const {
    const auto n = static_cast<double>(column.size());
    return {static_cast<std::size_t>(std::clamp(std::ceil((low - x0) / edge), 0.0, n)),
            static_cast<std::size_t>(std::clamp(std::floor((high - x0) / edge) + 1, 0.0, n))};
  }
};

/// Adds the points where the columns of a row enter and leave a closed surface or a set of spheres.
void cross_facets(const Surface& surface, ColumnRow& row);
void cross_spheres(const MultiSphere& spheres, ColumnRow& row);

/// Volume of the shape, of the union of the spheres, and of the part that both have in common [m³].
struct SharedVolume {
  double shape = 0, spheres = 0, common = 0;
};

/// Computes volumes by integration over a regular grid of columns parallel to z, with about 400 columns along the
/// longer side of the bodies' bounding rectangle in the xy plane. The integral is exact along each column and uses the
/// midpoint rule across columns.
SharedVolume shared_volume(const Surface& surface, const MultiSphere& cluster);

}  // namespace macadam
