// SPDX-License-Identifier: GPL-3.0-or-later
// voxelise.cpp  Intersects a body with vertical columns (see columns.hpp) and distributes the lengths to the voxels.
#include "host/tools/ct/synthetic/voxelise.hpp"

#include <limits>

#include "host/shapes/fill/columns.hpp"

namespace macadam::ct {
namespace {

/// Returns the bounding box of the body within the core.
std::array<Vec3d, 2> extent(const Body& body, const SawnCore& core) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Vec3d low{-infinite, -infinite, -infinite}, high{infinite, infinite, infinite};
  if (body.surface) {
    std::swap(low, high);
    for (const Vec3d& p : body.surface->points) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
  } else if (body.radius > 0) {
    const Vec3d r{body.radius, body.radius, body.radius};
    low = body.centre - r, high = body.centre + r;
  }
  return {Vec3d{std::max(low.x, core.low.x), std::max(low.y, core.low.y), std::max(low.z, core.low.z)},
          Vec3d{std::min(high.x, core.high.x), std::min(high.y, core.high.y), std::min(high.z, core.high.z)}};
}

/// Intersects the body with a row of columns.
void cross(const Body& body, const SawnCore& core, ColumnRow& row) {
  if (body.surface) {
    cross_facets(*body.surface, row);
  } else if (body.radius > 0) {
    cross_spheres({{body.centre}, {body.radius}}, row);
  } else {
    for (Column& c : row.column) c = {{core.low.z, 1}, {core.high.z, -1}};
  }
}

/// Returns the lower corner of the first voxel.
Vec3d corner_of(const Image<float>& grid) { return grid.origin - 0.5 * grid.spacing; }

/// Returns an empty Coverage for the voxels that intersect a box.
Coverage voxels_between(const Vec3d& low, const Vec3d& high, const Image<float>& grid) {
  const Vec3d corner = corner_of(grid);
  const std::array<double, 3> from{low.x - corner.x, low.y - corner.y, low.z - corner.z},
      to{high.x - corner.x, high.y - corner.y, high.z - corner.z}, edge{grid.spacing.x, grid.spacing.y, grid.spacing.z};
  Coverage out;
  std::int64_t count = 1;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto voxel = [&](double at) {
      return std::clamp(static_cast<std::int64_t>(std::floor(at / edge[a])), std::int64_t{0}, grid.size[a] - 1);
    };
    out.begin[a] = voxel(from[a]);
    out.end[a] = from[a] < to[a] ? voxel(to[a]) + 1 : out.begin[a];
    count *= out.end[a] - out.begin[a];
  }
  out.share.assign(static_cast<std::size_t>(count), 0);
  return out;
}

/// Adds the part of a column from one height to another to the filled fractions of the voxels (i, j, …).
void fill(Coverage& out, std::int64_t i, std::int64_t j, double from, double to, const Image<float>& grid,
          int samples) {
  const double first = corner_of(grid).z, edge = grid.spacing.z;
  const double weight = 1 / (static_cast<double>(samples * samples) * edge);
  const auto voxel = [&](double z) {
    return std::clamp(static_cast<std::int64_t>(std::floor((z - first) / edge)), out.begin[2], out.end[2] - 1);
  };
  for (std::int64_t k = voxel(from); k <= voxel(to); ++k) {
    const double bottom = first + edge * static_cast<double>(k);
    const double part = std::min(to, bottom + edge) - std::max(from, bottom);
    out.share[out.index(i, j, k)] += static_cast<float>(weight * std::max(0.0, part));
  }
}

}  // namespace

bool SawnCore::holds(double x, double y) const {
  if (x < low.x || x > high.x || y < low.y || y > high.y) return false;
  if (!cylinder) return true;
  const double radius = 0.5 * std::min(high.x - low.x, high.y - low.y);
  return std::hypot(x - 0.5 * (low.x + high.x), y - 0.5 * (low.y + high.y)) <= radius;
}

Coverage cover(const Body& body, const SawnCore& core, const Image<float>& grid, int samples) {
  const auto [low, high] = extent(body, core);
  Coverage out = voxels_between(low, high, grid);
  if (out.share.empty()) return out;
  const Vec3d corner = corner_of(grid);
  const double dx = grid.spacing.x / samples, dy = grid.spacing.y / samples;
  Vec3d moment{};
  double length = 0;  // total length of the columns within the body
  ColumnRow row{0, corner.x + grid.spacing.x * static_cast<double>(out.begin[0]) + 0.5 * dx, dx, {}};
  for (std::int64_t sub = 0; sub < (out.end[1] - out.begin[1]) * samples; ++sub) {
    const std::int64_t j = out.begin[1] + sub / samples;
    row.y = corner.y + grid.spacing.y * static_cast<double>(out.begin[1]) + (static_cast<double>(sub) + 0.5) * dy;
    row.column.assign(static_cast<std::size_t>((out.end[0] - out.begin[0]) * samples), {});
    cross(body, core, row);
    for (std::size_t k = 0; k < row.column.size(); ++k) {
      const double x = row.x(k);
      if (!core.holds(x, row.y)) continue;
      for_each_part(row.column[k], [&](double from, double to) {
        from = std::max(from, core.low.z), to = std::min(to, core.high.z);
        if (!(from < to)) return;
        length += to - from;
        moment += (to - from) * Vec3d{x, row.y, 0.5 * (from + to)};
        fill(out, out.begin[0] + static_cast<std::int64_t>(k) / samples, j, from, to, grid, samples);
      });
    }
  }
  out.volume = length * dx * dy;
  if (length > 0) out.centroid = (1 / length) * moment;
  return out;
}

}  // namespace macadam::ct
