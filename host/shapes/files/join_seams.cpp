// SPDX-License-Identifier: GPL-3.0-or-later
// join_seams.cpp  Finds points at open edges that are near each other, with a grid of cubic cells.
#include "host/shapes/files/join_seams.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "host/shapes/files/equal_points.hpp"
#include "host/shapes/files/surface_numbers.hpp"

namespace macadam {
namespace {

/// Calls visit(lower point, higher point) for each edge of each facet that has three different corners.
template <class Visit>
void each_side(const Surface& surface, Visit&& visit) {
  for (const auto& [a, b, c] : surface.facets) {
    if (a == b || b == c || c == a) continue;
    for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}}) visit(std::min(from, to), std::max(from, to));
  }
}

/// Packs an edge into 64 bits.
std::uint64_t number_of_edge(std::int32_t low, std::int32_t high) {
  return static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint64_t>(high);
}

/// Returns whether every edge belongs to an even number of facets. The test is fast: the 64-bit hashes of all edges are
/// combined by exclusive or, so that an even number of equal edges cancels. An odd edge is missed with a probability of
/// 5e-20.
bool has_even_edges(const Surface& surface) {
  std::uint64_t sum = 0;
  each_side(surface, [&](std::int32_t low, std::int32_t high) {
    std::uint64_t x = number_of_edge(low, high) + 0x9e3779b97f4a7c15;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;  // splitmix64
    x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
    sum ^= x ^ (x >> 31);
  });
  return sum == 0;
}

/// Returns the points of edges that belong to an odd number of facets, in ascending order.
std::vector<std::int32_t> points_of_open_edges(const Surface& surface) {
  std::vector<std::uint64_t> sides;
  each_side(surface, [&](std::int32_t low, std::int32_t high) { sides.push_back(number_of_edge(low, high)); });
  std::sort(sides.begin(), sides.end());
  std::vector<bool> open(surface.points.size());
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i;
    while (end < sides.size() && sides[end] == sides[i]) ++end;
    if ((end - i) % 2 == 1) open[sides[i] >> 32] = open[sides[i] & 0xffffffff] = true;
    i = end;
  }
  std::vector<std::int32_t> points;
  for (std::size_t p = 0; p < open.size(); ++p) {
    if (open[p]) points.push_back(static_cast<std::int32_t>(p));
  }
  return points;
}

/// The points to which other points are joined, sorted into cubic cells with edges of 2·width. These points are more
/// than `width` apart, so a cell holds only a few of them.
class SeamPoints {
 public:
  SeamPoints(const std::vector<Vec3d>& points, const Vec3d& low, double width)
      : points_(points), low_(low), width_(width) {}

  /// Returns the lowest number among the points within `width` of point p. If no such point exists, p is added and
  /// returned.
  std::int32_t first_near(std::int32_t p) {
    const std::array<std::int64_t, 3> cell = cell_of(points_[p]);
    std::int32_t first = p;
    for (int k = 0; k < 27; ++k) {
      const auto found = cells_.find(key({cell[0] + k % 3 - 1, cell[1] + k / 3 % 3 - 1, cell[2] + k / 9 - 1}));
      if (found == cells_.end()) continue;
      for (const std::int32_t q : found->second)
        if (q < first && norm(points_[q] - points_[p]) <= width_) first = q;
    }
    if (first == p) cells_[key(cell)].push_back(p);
    return first;
  }

 private:
  std::array<std::int64_t, 3> cell_of(const Vec3d& p) const {
    const auto along = [&](double x) { return static_cast<std::int64_t>(x / (2 * width_)) + 1; };
    return {along(p.x - low_.x), along(p.y - low_.y), along(p.z - low_.z)};
  }
  /// Packs cell coordinates of 21 bits each. A surface is at most about 2^20 cells wide, because seam_width() is a
  /// fixed fraction of its size.
  static std::uint64_t key(const std::array<std::int64_t, 3>& cell) {
    return static_cast<std::uint64_t>(cell[0]) | static_cast<std::uint64_t>(cell[1]) << 21 |
           static_cast<std::uint64_t>(cell[2]) << 42;
  }

  const std::vector<Vec3d>& points_;
  Vec3d low_;
  double width_;
  std::unordered_map<std::uint64_t, std::vector<std::int32_t>> cells_;
};

}  // namespace

double seam_width(const Surface& surface) {
  const auto [low, high] = bounds_of(surface.points);
  const Vec3d size = high - low;
  // Rounding to single precision changes a coordinate by half a unit in the last place. Programs that also move and
  // rotate in single precision cause errors of a few units.
  constexpr double units = 4;
  return units * std::numeric_limits<float>::epsilon() * std::max({size.x, size.y, size.z});
}

SeamJoin join_seams(Surface& surface) {
  const double width = seam_width(surface);
  if (has_even_edges(surface) || width < std::numeric_limits<double>::min()) return {};
  SeamJoin join;
  SeamPoints kept(surface.points, bounds_of(surface.points).low, width);
  std::vector<std::int32_t> to(surface.points.size());
  std::iota(to.begin(), to.end(), 0);
  for (const std::int32_t p : points_of_open_edges(surface)) {
    to[p] = kept.first_near(p);
    join.points += to[p] != p;
  }
  if (join.points == 0) return join;
  join.facets = static_cast<std::int64_t>(std::erase_if(surface.facets, [&](const std::array<std::int32_t, 3>& f) {
    const auto meet = [&](std::int32_t p, std::int32_t q) { return p != q && to[p] == to[q]; };
    return meet(f[0], f[1]) || meet(f[1], f[2]) || meet(f[2], f[0]);
  }));
  replace_points(surface, to);
  return join;
}

}  // namespace macadam
