// SPDX-License-Identifier: GPL-3.0-or-later
// surface_pieces.cpp  Finds pieces by common points, and inner pieces by exact containment tests.
#include "host/shapes/surface/surface_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/base/disjoint_sets.hpp"
#include "host/shapes/files/equal_points.hpp"
#include "host/shapes/surface/shape_solid.hpp"
#include "host/shapes/files/surface_numbers.hpp"

namespace macadam {

SurfacePieces::SurfacePieces(const Surface& surface) : surface_(surface) {
  DisjointSets points(surface.points.size());
  for (const auto& f : surface.facets) points.join(f[0], f[1]), points.join(f[1], f[2]);
  std::vector<std::int32_t> number(surface.points.size(), -1);
  for (const auto& f : surface.facets) {
    std::int32_t& n = number[points.find(f[0])];
    if (n < 0) n = count_++;
    piece_of_.push_back(n);
  }
}

std::vector<double> SurfacePieces::areas() const {
  std::vector<double> area(count_, 0.0);
  const std::vector<Vec3d>& p = surface_.points;
  for (std::size_t f = 0; f < piece_of_.size(); ++f) {
    const auto& [a, b, c] = surface_.facets[f];
    area[piece_of_[f]] += 0.5 * norm(cross(p[b] - p[a], p[c] - p[a]));
  }
  return area;
}

Surface SurfacePieces::without(const std::vector<bool>& dropped) const {
  Surface kept{surface_.name, surface_.points, {}};
  for (std::size_t f = 0; f < piece_of_.size(); ++f) {
    if (!dropped[piece_of_[f]]) kept.facets.push_back(surface_.facets[f]);
  }
  std::vector<std::int32_t> same(kept.points.size());
  std::iota(same.begin(), same.end(), 0);
  replace_points(kept, same);
  return kept;
}

std::vector<bool> SurfacePieces::find_inner(const SurfaceVerdict& verdict) const {
  std::vector<bool> inner(count_, false);
  if (count_ == 1) return inner;
  std::vector<bool> faulty(count_, false);
  for (const auto* facets :
       {&verdict.degenerate, &verdict.non_manifold, &verdict.open, &verdict.misoriented, &verdict.self_intersecting}) {
    for (const std::int32_t f : *facets) faulty[piece_of_[f]] = true;
  }
  std::vector<double> volume(count_, 0.0);
  std::vector<std::int32_t> a_point(count_, 0);
  const Vec3d middle = middle_of(surface_.points);
  for (std::size_t f = 0; f < piece_of_.size(); ++f) {
    const auto& [a, b, c] = surface_.facets[f];
    const std::vector<Vec3d>& p = surface_.points;
    volume[piece_of_[f]] += dot(p[a] - middle, cross(p[b] - middle, p[c] - middle));
    a_point[piece_of_[f]] = a;
  }
  for (double& v : volume) v = std::abs(v);
  const auto largest = static_cast<std::int32_t>(std::max_element(volume.begin(), volume.end()) - volume.begin());
  if (faulty[largest]) return inner;
  std::vector<bool> others(count_, true);
  others[largest] = false;
  const ShapeSolid solid(without(others));
  for (std::int32_t n = 0; n < count_; ++n)
    inner[n] = n != largest && !faulty[n] && solid.contains(surface_.points[a_point[n]]);
  return inner;
}

}  // namespace macadam
