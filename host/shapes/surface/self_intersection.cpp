// SPDX-License-Identifier: GPL-3.0-or-later
// self_intersection.cpp  Tests pairs of facets with overlapping boxes. CGAL's own function needs a manifold mesh, and
// faulty surfaces may not be manifold. So this file itself tells apart facets with 0, 1, 2 or 3 common corners.
#include "host/shapes/surface/self_intersection.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include "host/shapes/files/equal_points.hpp"

namespace macadam {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Corners = std::array<std::int32_t, 3>;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::int32_t>;

/// Tests pairs of facets of one surface for intersection.
class FacetPairs {
 public:
  explicit FacetPairs(const Surface& surface) {
    const std::vector<std::int32_t> first = first_of_equal(surface.points);
    for (const Vec3d& p : surface.points) points_.emplace_back(p.x, p.y, p.z);
    for (const Corners& f : surface.facets) corners_.push_back({first[f[0]], first[f[1]], first[f[2]]});
  }

  CGAL::Bbox_3 bounds(std::int32_t facet) const { return triangle(corners_[facet]).bbox(); }

  /// Returns whether two facets intersect elsewhere than in their common corners and edges.
  bool cut(std::int32_t one, std::int32_t two) const {
    Corners a = corners_[one], b = corners_[two];
    switch (shared_first(a, b)) {
      case 0:
        return CGAL::do_intersect(triangle(a), triangle(b));
      case 1:  // one common corner: the far edge of one facet must intersect the other facet
        return CGAL::do_intersect(triangle(a), far_edge(b)) || CGAL::do_intersect(triangle(b), far_edge(a));
      case 2:  // a common edge: two facets intersect if one is folded flat onto the other
        return CGAL::coplanar(at(a[0]), at(a[1]), at(a[2]), at(b[2])) &&
               CGAL::coplanar_orientation(at(a[0]), at(a[1]), at(a[2]), at(b[2])) == CGAL::POSITIVE;
      default:
        return true;  // the same facet twice
    }
  }

 private:
  const Point& at(std::int32_t p) const { return points_[p]; }
  Kernel::Triangle_3 triangle(const Corners& c) const { return {at(c[0]), at(c[1]), at(c[2])}; }
  Kernel::Segment_3 far_edge(const Corners& c) const { return {at(c[1]), at(c[2])}; }

  /// Moves the common corners of two facets to the front of both lists, in the same order, and returns their number.
  static int shared_first(Corners& a, Corners& b) {
    int n = 0;
    for (int i = n; i < 3; ++i) {
      for (int j = n; j < 3; ++j) {
        if (a[i] != b[j]) continue;
        std::swap(a[i], a[n]);
        std::swap(b[j], b[n]);
        ++n;
        break;
      }
    }
    return n;
  }

  std::vector<Point> points_;
  std::vector<Corners> corners_;
};

}  // namespace

std::vector<std::int32_t> self_intersecting_facets(const Surface& surface, const std::vector<bool>& skip) {
  const FacetPairs pairs(surface);
  std::vector<Box> boxes;
  for (std::size_t f = 0; f < surface.facets.size(); ++f) {
    if (!skip[f]) boxes.emplace_back(pairs.bounds(static_cast<std::int32_t>(f)), static_cast<std::int32_t>(f));
  }
  std::vector<std::uint8_t> cut(surface.facets.size(), 0);
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    if (!(cut[a.info()] && cut[b.info()]) && pairs.cut(a.info(), b.info())) cut[a.info()] = cut[b.info()] = 1;
  });
  std::vector<std::int32_t> facets;
  for (std::size_t f = 0; f < cut.size(); ++f) {
    if (cut[f]) facets.push_back(static_cast<std::int32_t>(f));
  }
  return facets;
}

}  // namespace macadam
