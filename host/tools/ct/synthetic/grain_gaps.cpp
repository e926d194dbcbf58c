// SPDX-License-Identifier: GPL-3.0-or-later
// grain_gaps.cpp  Computes distances between the points of one grain and the surface of another.
#include "host/tools/ct/synthetic/grain_gaps.hpp"

#include <limits>

#include "kernels/base/parallel.hpp"
#include "host/shapes/surface/surface_distance.hpp"

namespace macadam::ct {
namespace {

/// Returns the distance of two boxes along an axis; negative if they overlap.
double apart(double low_a, double high_a, double low_b, double high_b) {
  return std::max(low_a - high_b, low_b - high_a);
}

/// Whether the bounding boxes of two surfaces are at most `widest` apart along each axis.
bool near(const SurfaceDistance& a, const SurfaceDistance& b, double widest) {
  const Vec3d &p = a.low(), &q = a.high(), &r = b.low(), &s = b.high();
  return apart(p.x, q.x, r.x, s.x) <= widest && apart(p.y, q.y, r.y, s.y) <= widest &&
         apart(p.z, q.z, r.z, s.z) <= widest;
}

/// Returns the smallest distance of the points of a surface from another surface; 0 if a point is inside it, infinity
/// if all are farther than `widest`.
double gap_of(const Surface& points, const SurfaceDistance& from, double widest) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3d& p : points.points) {
    const bool far = apart(p.x, p.x, from.low().x, from.high().x) > widest ||
                     apart(p.y, p.y, from.low().y, from.high().y) > widest ||
                     apart(p.z, p.z, from.low().z, from.high().z) > widest;
    if (!far) least = std::min(least, std::max(0.0, -from.depth(p)));
  }
  return least;
}

}  // namespace

std::vector<GrainGap> grain_gaps(const std::vector<PhantomGrain>& grains, double widest) {
  std::vector<std::vector<GrainGap>> found(grains.size());
  std::vector<std::unique_ptr<SurfaceDistance>> distance(grains.size());
  for_each_in_parallel(grains.size(),
                       [&](std::size_t k) { distance[k] = std::make_unique<SurfaceDistance>(grains[k].surface); });
  for_each_in_parallel(grains.size(), [&](std::size_t a) {
    for (std::size_t b = a + 1; b < grains.size(); ++b) {
      if (!near(*distance[a], *distance[b], widest)) continue;
      const PhantomGrain &p = grains[a], &q = grains[b];
      double gap = std::numeric_limits<double>::infinity();
      if (p.sphere_radius > 0 && q.sphere_radius > 0 && !p.border && !q.border) {
        gap = std::max(0.0, norm(p.centre - q.centre) - p.sphere_radius - q.sphere_radius);
      } else {
        gap = std::min(gap_of(p.surface, *distance[b], widest), gap_of(q.surface, *distance[a], widest));
      }
      if (gap <= widest) found[a].push_back({p.id, q.id, gap});
    }
  });
  std::vector<GrainGap> out;
  for (const auto& list : found) out.insert(out.end(), list.begin(), list.end());
  return out;
}

}  // namespace macadam::ct
