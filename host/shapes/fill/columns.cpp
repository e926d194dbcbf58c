// SPDX-License-Identifier: GPL-3.0-or-later
/// \file columns.cpp  Intersects columns (rays along z) with a surface of facets and with spheres, and integrates
/// the volumes of the surface, of the union of the spheres, and of the part that lies in both.
#include "host/shapes/fill/columns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace macadam {
namespace {

/// Number of columns along the longer side of the rectangle, in the xy plane, that bounds all bodies. With this number
/// the volumes of a cube and a sphere are accurate to about 1e-5.
constexpr double columns_along = 400;

/// Returns the length of the part of the column that lies in at least one body.
double length(Column& column) {
  double sum = 0;
  for_each_part(column, [&](double low, double high) { sum += high - low; });
  return sum;
}

/// Returns whether (x, y) lies left of the edge a → b. The edge is always evaluated from its lower to its higher point
/// number. The two facets at the edge therefore get opposite answers, and a column passes through exactly one of them
/// even where rounding decides.
bool left_of(const Surface& s, std::int32_t a, std::int32_t b, double x, double y) {
  const Vec3d& p = s.points[std::min(a, b)];
  const Vec3d& q = s.points[std::max(a, b)];
  const bool left = (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x) > 0;
  return a < b ? left : !left;
}

/// Rotates one point by the unit quaternion (1, 2, 4, 8)/√85. After this rotation, facets of boxes and similar shapes
/// are not parallel to the rows of columns. A row parallel to a facet would hit the facet with all of its columns or
/// with no column.
Vec3d turned(const Vec3d& p) {
  static const double w = 1 / std::sqrt(85.0);
  return Pose{{}, {w, 2 * w, 4 * w, 8 * w}}(p);
}

}  // namespace

void cross_facets(const Surface& s, ColumnRow& row) {
  for (const auto& f : s.facets) {
    const Vec3d a = s.points[f[0]], b = s.points[f[1]], c = s.points[f[2]];
    if (row.y < std::min({a.y, b.y, c.y}) || row.y > std::max({a.y, b.y, c.y})) continue;
    const Vec3d normal = cross(b - a, c - a);
    const auto [first, last] = row.between(std::min({a.x, b.x, c.x}), std::max({a.x, b.x, c.x}));
    for (std::size_t i = first; i < last; ++i) {
      const double x = row.x(i);
      const int left =
          left_of(s, f[0], f[1], x, row.y) + left_of(s, f[1], f[2], x, row.y) + left_of(s, f[2], f[0], x, row.y);
      if (left != 0 && left != 3) continue;
      const double rise = normal.z == 0 ? 0 : (normal.x * (x - a.x) + normal.y * (row.y - a.y)) / normal.z;
      const double z = std::clamp(a.z - rise, std::min({a.z, b.z, c.z}), std::max({a.z, b.z, c.z}));
      // If the column is left of all three edges, the facet faces upwards and the column leaves the body there.
      row.column[i].push_back({z, left == 3 ? -1 : 1});
    }
  }
}

void cross_spheres(const MultiSphere& cluster, ColumnRow& row) {
  for (std::size_t k = 0; k < cluster.size(); ++k) {
    const Vec3d& c = cluster.centre[k];
    const double r2 = cluster.radius[k] * cluster.radius[k] - (row.y - c.y) * (row.y - c.y);
    if (r2 <= 0) continue;
    const auto [first, last] = row.between(c.x - std::sqrt(r2), c.x + std::sqrt(r2));
    for (std::size_t i = first; i < last; ++i) {
      const double half = std::sqrt(std::max(0.0, r2 - (row.x(i) - c.x) * (row.x(i) - c.x)));
      row.column[i].push_back({c.z - half, 1});
      row.column[i].push_back({c.z + half, -1});
    }
  }
}

SharedVolume shared_volume(const Surface& given_surface, const MultiSphere& given_cluster) {
  Surface surface = given_surface;
  MultiSphere cluster = given_cluster;
  for (Vec3d& p : surface.points) p = turned(p);
  for (Vec3d& c : cluster.centre) c = turned(c);

  constexpr double infinite = std::numeric_limits<double>::infinity();
  double x0 = infinite, x1 = -infinite, y0 = infinite, y1 = -infinite;
  const auto include = [&](const Vec3d& p, double r) {
    x0 = std::min(x0, p.x - r), x1 = std::max(x1, p.x + r);
    y0 = std::min(y0, p.y - r), y1 = std::max(y1, p.y + r);
  };
  for (const Vec3d& p : surface.points) include(p, 0);
  for (std::size_t k = 0; k < cluster.size(); ++k) include(cluster.centre[k], cluster.radius[k]);

  const double edge = std::max(x1 - x0, y1 - y0) / columns_along;
  const auto number = [&](double side) { return static_cast<std::size_t>(std::ceil(side / edge)); };
  std::vector<Column> shape(number(x1 - x0)), spheres(shape.size());
  SharedVolume sum;
  for (std::size_t j = 0; j < number(y1 - y0); ++j) {
    ColumnRow row{y0 + (static_cast<double>(j) + 0.5) * edge, x0 + 0.5 * edge, edge, std::move(shape)};
    cross_facets(surface, row);
    shape = std::move(row.column);
    row.column = std::move(spheres);
    cross_spheres(cluster, row);
    spheres = std::move(row.column);
    for (std::size_t i = 0; i < shape.size(); ++i) {
      const double in_shape = length(shape[i]), in_spheres = length(spheres[i]);
      sum.shape += in_shape, sum.spheres += in_spheres;
      // common volume = shape + spheres − union
      shape[i].insert(shape[i].end(), spheres[i].begin(), spheres[i].end());
      sum.common += in_shape + in_spheres - length(shape[i]);
      shape[i].clear(), spheres[i].clear();
    }
  }
  const double area = edge * edge;
  return {area * sum.shape, area * sum.spheres, area * sum.common};
}

}  // namespace macadam
