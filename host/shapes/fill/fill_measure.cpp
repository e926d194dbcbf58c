// SPDX-License-Identifier: GPL-3.0-or-later
/// \file fill_measure.cpp  Measures how well a cluster of spheres represents its shape.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "host/shapes/fill/columns.hpp"
#include "host/shapes/fill/fill.hpp"
#include "host/shapes/files/surface_numbers.hpp"
#include "host/spheres/neighbours.hpp"
#include "host/spheres/size_law.hpp"
#include "host/spheres/specimen_check.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

constexpr double surface_samples = 20'000;

void check(const Surface& surface, const MultiSphere& cluster) {
  if (const SurfaceVerdict verdict = check_surface(surface); !verdict.good())
    throw InputError(surface.name, 0, "surface", verdict.text(), "a surface that can be filled");
  const auto refuse = [&](const std::string& what, const std::string& found, const char* expected) {
    throw InputError(surface.name, 0, "cluster: " + what, found, expected);
  };
  if (cluster.size() == 0) refuse("spheres", "0", "at least 1");
  if (cluster.radius.size() != cluster.size())
    refuse("radii", std::to_string(cluster.radius.size()), "one radius for each centre");
  for (std::size_t i = 0; i < cluster.size(); ++i) {
    const Vec3d& c = cluster.centre[i];
    const std::string sphere = "sphere " + std::to_string(i) + ": ";
    if (!(std::isfinite(cluster.radius[i]) && cluster.radius[i] > 0))
      refuse(sphere + "radius", shown(cluster.radius[i]), "a finite positive number");
    if (!std::isfinite(c.x + c.y + c.z)) refuse(sphere + "centre", shown(c.x + c.y + c.z), "finite coordinates");
  }
}

/// All pairs of spheres of a cluster, including each sphere with itself. Spheres are sorted by the distance between the
/// middle of the cluster and their farthest point, in descending order.
class Pairs {
 public:
  explicit Pairs(const MultiSphere& cluster) : cluster_(cluster), reach_(cluster.size()), order_(cluster.size()) {
    Vec3d middle{};
    for (const Vec3d& c : cluster.centre) middle += (1 / static_cast<double>(cluster.size())) * c;
    for (std::size_t i = 0; i < cluster.size(); ++i) reach_[i] = norm(cluster.centre[i] - middle) + cluster.radius[i];
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::stable_sort(order_.begin(), order_.end(), [&](auto a, auto b) { return reach_[a] > reach_[b]; });
  }

  /// Returns the longest segment between two points of the spheres' surfaces whose direction lies in a subspace. For
  /// spheres with centres a and b, d = b − a is the sum of p in the subspace and q perpendicular to the subspace. The
  /// segment has the length |p| + √((Ra + Rb)² − q²). Its end points are displaced from the two centres along q, and
  /// the ratio of the displacements is Ra : Rb, because this ratio makes the segment longest. If the subspace is the
  /// whole space, the length is |d| + Ra + Rb. `project` returns p for d; `along` receives p of the longest segment.
  template <class Project>
  double longest(const Project& project, Vec3d& along) const {
    double best = 0;
    for (std::size_t m = 0; m < order_.size(); ++m) {
      for (std::size_t n = m; n < order_.size(); ++n) {
        const std::size_t i = order_[m], j = order_[n];
        if (reach_[i] + reach_[j] <= best) break;
        const Vec3d d = cluster_.centre[j] - cluster_.centre[i], p = project(d), q = d - p;
        const double sum = cluster_.radius[i] + cluster_.radius[j], room = sum * sum - dot(q, q);
        if (room < 0) continue;
        if (const double length = norm(p) + std::sqrt(room); length > best) best = length, along = p;
      }
      if (2 * reach_[order_[m]] <= best) break;
    }
    return best;
  }

 private:
  const MultiSphere& cluster_;
  std::vector<double> reach_;
  std::vector<std::size_t> order_;
};

/// Returns `v` as a unit vector. If `v` is zero, which happens for a single sphere, any direction is valid; then
/// returns a unit vector perpendicular to `other`.
Vec3d direction(const Vec3d& v, const Vec3d& other) {
  if (const double length = norm(v); length > 0) return (1 / length) * v;
  const Vec3d least = std::abs(other.x) <= std::min(std::abs(other.y), std::abs(other.z)) ? Vec3d{1, 0, 0}
                      : std::abs(other.y) <= std::abs(other.z)                            ? Vec3d{0, 1, 0}
                                                                                          : Vec3d{0, 0, 1};
  const Vec3d side = least - dot(least, other) * other;
  return (1 / norm(side)) * side;
}

void measure_lengths(const MultiSphere& cluster, FillReport& report) {
  const Pairs pairs(cluster);
  Vec3d along{};
  report.d_long = pairs.longest([](const Vec3d& d) { return d; }, along);
  const Vec3d a = direction(along, {});
  along = {};
  report.d_intermediate = pairs.longest([&](const Vec3d& d) { return d - dot(d, a) * a; }, along);
  const Vec3d b = direction(along, a), c = cross(a, b);
  report.d_short = pairs.longest([&](const Vec3d& d) { return dot(d, c) * c; }, along);
}

double largest_overlap(const MultiSphere& cluster) {
  const auto [low, high] = bounds_of(cluster.centre);
  const double r = *std::min_element(cluster.radius.begin(), cluster.radius.end());
  const Specimen boxed = in_box(cluster, low - Vec3d{r, r, r}, high + Vec3d{r, r, r});
  const std::vector<Ball> balls = balls_of(boxed);
  const Neighbours neighbours(boxed.box, balls, 0);
  double largest = 0;
  for (std::size_t i = 0; i < boxed.size(); ++i)
    for (std::int32_t j : neighbours.of(i))
      largest = std::max(largest, 1 - norm(boxed.centre[i] - boxed.centre[j]) / (boxed.radius[i] + boxed.radius[j]));
  return largest;
}

/// Measures the distance to the nearest sphere at the points of the surface and at points on its facets. Each facet is
/// divided into equal parts, and the centroids of the parts are used. Larger facets have more parts.
void measure_deviation(const Surface& surface, const MultiSphere& cluster, FillReport& report) {
  const auto deviation = [&](const Vec3d& point) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < cluster.size(); ++i)
      nearest = std::min(nearest, norm(point - cluster.centre[i]) - cluster.radius[i]);
    return std::abs(nearest);
  };
  const auto area_of = [&](const auto& f) {
    return norm(cross(surface.points[f[1]] - surface.points[f[0]], surface.points[f[2]] - surface.points[f[0]])) / 2;
  };
  double area = 0, sum = 0;
  for (const auto& f : surface.facets) area += area_of(f);
  for (const auto& f : surface.facets) {
    const Vec3d a = surface.points[f[0]], u = surface.points[f[1]] - a, v = surface.points[f[2]] - a;
    const int k = std::max(1, static_cast<int>(std::ceil(std::sqrt(surface_samples * area_of(f) / area))));
    double sum_here = 0;
    const auto sample = [&](double i, double j) {
      const double d = deviation(a + (i / k) * u + (j / k) * v);
      sum_here += d;
      report.deviation_largest = std::max(report.deviation_largest, d);
    };
    for (int i = 0; i < k; ++i)
      for (int j = 0; i + j < k; ++j) {
        sample(i + 1.0 / 3, j + 1.0 / 3);
        if (i + j + 1 < k) sample(i + 2.0 / 3, j + 2.0 / 3);
      }
    sum += area_of(f) * sum_here / (k * k);
  }
  for (const Vec3d& p : surface.points) report.deviation_largest = std::max(report.deviation_largest, deviation(p));
  report.deviation_mean = sum / area;

  // A sphere whose centre is at depth d protrudes by R − d beyond the nearest point of the surface. If the surface is
  // not convex, R − d is only an upper bound.
  const SurfaceDistance distance(surface);
  for (std::size_t i = 0; i < cluster.size(); ++i)
    report.deviation_largest =
        std::max(report.deviation_largest, cluster.radius[i] - distance.depth(cluster.centre[i]));
}

}  // namespace

FillReport measure_fill(const Surface& surface, const MultiSphere& cluster) {
  check(surface, cluster);
  FillReport report;
  for (double r : cluster.radius) report.sphere_volume += sphere_volume(2 * r);
  const SharedVolume volume = shared_volume(surface, cluster);
  report.covered = volume.common / volume.shape;
  report.outside = (volume.spheres - volume.common) / volume.shape;
  report.largest_overlap = largest_overlap(cluster);
  measure_deviation(surface, cluster, report);
  measure_lengths(cluster, report);
  return report;
}

}  // namespace macadam
