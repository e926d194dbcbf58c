// SPDX-License-Identifier: GPL-3.0-or-later
/// \file surface_samples.cpp  Samples the corners and edges of a surface. The tree splits the samples into halves along
/// their longest extent until a node has few samples.
#include "host/specimen/packing/surface_samples.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "host/shapes/files/surface_numbers.hpp"

namespace macadam {
namespace {

constexpr std::uint32_t leaf_size = 12;
// Limits the number of samples on very long or sharp edges.
constexpr double most_samples_an_edge = 64;

Vec3d unit_normal(const Surface& s, const std::array<std::int32_t, 3>& f) {
  const Vec3d n = cross(s.points[f[1]] - s.points[f[0]], s.points[f[2]] - s.points[f[0]]);
  const double length = norm(n);
  return length > 0 ? (1 / length) * n : Vec3d{};
}

}  // namespace

SurfaceSamples::SurfaceSamples(const Surface& s, double tolerance) : point_(s.points) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> facet_of;  // the facet of each directed edge
  for (std::size_t f = 0; f < s.facets.size(); ++f)
    for (int k = 0; k < 3; ++k) facet_of[{s.facets[f][k], s.facets[f][(k + 1) % 3]}] = f;
  for (const auto& [edge, facet] : facet_of) {
    const auto other = facet_of.find({edge.second, edge.first});
    if (other == facet_of.end() || edge.first > edge.second) continue;
    const Vec3d a = s.points[edge.first], b = s.points[edge.second];
    // If a plane just touches two neighbouring samples of an edge, the edge can penetrate the plane between the samples
    // unnoticed. The depth is at most x·sin(half of the angle by which the surface turns at the edge), where x is the
    // distance from the nearest sample.
    const double turn = norm(cross(unit_normal(s, s.facets[facet]), unit_normal(s, s.facets[other->second])));
    const double pieces = std::clamp(std::ceil(norm(b - a) * turn / (4 * tolerance)), 1.0, most_samples_an_edge);
    for (int k = 1; k < pieces; ++k) point_.push_back(a + (k / pieces) * (b - a));
  }
  build(0, static_cast<std::uint32_t>(point_.size()));
}

void SurfaceSamples::build(std::uint32_t begin, std::uint32_t end) {
  const auto [low, high] = bounds_of(std::span(point_).subspan(begin, end - begin));
  const Vec3d centre = 0.5 * (low + high), size = high - low;
  double radius = 0;
  for (std::uint32_t i = begin; i < end; ++i) radius = std::max(radius, norm(point_[i] - centre));
  const std::size_t me = node_.size();
  const bool leaf = end - begin <= leaf_size;
  node_.push_back({centre, radius, begin, leaf ? end : begin, 0});
  if (!leaf) {
    const double longest = std::max({size.x, size.y, size.z});
    const auto along = [&](const Vec3d& p) { return size.x == longest ? p.x : size.y == longest ? p.y : p.z; };
    const std::uint32_t middle = begin + (end - begin) / 2;
    // Sorts by all coordinates, so that the order, and with it every sum over samples, is the same on every machine.
    std::sort(point_.begin() + begin, point_.begin() + end, [&](const Vec3d& p, const Vec3d& q) {
      return std::tuple(along(p), p.x, p.y, p.z) < std::tuple(along(q), q.x, q.y, q.z);
    });
    build(begin, middle);
    build(middle, end);
  }
  node_[me].next = static_cast<std::uint32_t>(node_.size());
}

}  // namespace macadam
