// SPDX-License-Identifier: GPL-3.0-or-later
// equal_points.cpp  Finds equal points by sorting: after the sort, points of equal coordinates are adjacent.
#include "host/shapes/files/equal_points.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace macadam {

std::vector<std::int32_t> first_of_equal(const std::vector<Vec3d>& points) {
  std::vector<std::int32_t> order(points.size()), first(points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](std::int32_t i) { return std::tie(points[i].x, points[i].y, points[i].z); };
  std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) { return key(a) < key(b); });
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool same = k > 0 && key(order[k]) == key(order[k - 1]);
    first[order[k]] = same ? first[order[k - 1]] : order[k];
  }
  return first;
}

void replace_points(Surface& surface, const std::vector<std::int32_t>& to) {
  std::vector<std::int32_t> number(surface.points.size(), -1);
  for (auto& facet : surface.facets) {
    for (std::int32_t& p : facet) number[p = to[p]] = 0;
  }
  std::int32_t kept = 0;
  for (std::size_t p = 0; p < number.size(); ++p) {
    if (number[p] < 0) continue;
    surface.points[kept] = surface.points[p];
    number[p] = kept++;
  }
  surface.points.resize(kept);
  for (auto& facet : surface.facets) {
    for (std::int32_t& p : facet) p = number[p];
  }
}

void join_equal_points(Surface& surface) { replace_points(surface, first_of_equal(surface.points)); }

}  // namespace macadam
