// SPDX-License-Identifier: GPL-3.0-or-later
// sphere_cluster.cpp  Lists the spheres of a cluster by the cells of a grid over the cube that contains the cluster. A
// point outside the cube uses the nearest cell, whose list contains all spheres within `reach` of the point.
#include "host/specimen/packing/sphere_cluster.hpp"

#include <algorithm>
#include <limits>

namespace macadam {
namespace {

double farthest(const MultiSphere& spheres) {
  double most = 0;
  for (std::size_t i = 0; i < spheres.size(); ++i) most = std::max(most, norm(spheres.centre[i]) + spheres.radius[i]);
  return most;
}

}  // namespace

SphereCluster::SphereCluster(MultiSphere spheres, double reach)
    : spheres_(std::move(spheres)),
      radius_(farthest(spheres_)),
      reach_(reach),
      low_(-radius_ * Vec3d{1, 1, 1}),
      grid_(Box{-2.0 * low_}, reach) {
  for (std::size_t i = 0; i < spheres_.size(); ++i)
    grid_.insert(static_cast<std::int32_t>(i), spheres_.centre[i] - low_, spheres_.radius[i] + reach);
}

/// Calls visit for the spheres near a point until visit returns false. For a point outside the cube, uses the cell of
/// the nearest point of the cube. That point is nearer to every sphere, so no near sphere is missed.
template <class Visit>
void SphereCluster::each_near(const Vec3d& point, const Visit& visit) const {
  for (const std::int32_t i : grid_.near(grid_.cell_of(point - low_))) {
    const auto k = static_cast<std::size_t>(i);
    if (!visit(spheres_.centre[k] - point, spheres_.radius[k])) return;
  }
}

bool SphereCluster::touches(const Vec3d& point, double radius) const {
  const double far = radius_ + radius;
  if (dot(point, point) > far * far) return false;
  bool found = false;
  const auto clear = [&](const Vec3d& way, double r) {
    const double least = r + radius;
    found = dot(way, way) <= least * least;
    return !found;
  };
  if (radius <= reach_) {
    each_near(point, clear);
  } else {
    for (std::size_t i = 0; i < spheres_.size() && !found; ++i) clear(spheres_.centre[i] - point, spheres_.radius[i]);
  }
  return found;
}

double SphereCluster::distance_at_most(const Vec3d& point) const {
  double least = std::numeric_limits<double>::infinity();
  each_near(point, [&](const Vec3d& way, double r) {
    least = std::min(least, norm(way) - r);
    return true;
  });
  return least;
}

}  // namespace macadam
