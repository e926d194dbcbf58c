// SPDX-License-Identifier: GPL-3.0-or-later
/// \file convex_hull.cpp  Computes convex hulls with CGAL's quickhull and exact predicates. Arguments and results are
/// plain arrays.
#include "host/shapes/surface/convex_hull.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/MP_Float.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <map>

namespace macadam {
namespace {

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

/// Returns a plane number for each facet. All facets in one plane have the number of the first facet in this plane.
std::vector<std::size_t> planes_of(const Mesh& hull) {
  std::vector<std::size_t> plane(hull.number_of_faces(), hull.number_of_faces());
  std::vector<Mesh::Face_index> next;
  for (const Mesh::Face_index first : hull.faces()) {
    if (plane[first] < plane.size()) continue;
    plane[first] = first;
    for (next = {first}; !next.empty();) {
      const Mesh::Face_index here = next.back();
      next.pop_back();
      for (const Mesh::Halfedge_index edge : hull.halfedges_around_face(hull.halfedge(here))) {
        const Mesh::Halfedge_index back = hull.opposite(edge);
        const Mesh::Face_index there = hull.face(back);
        if (plane[there] < plane.size() ||
            !CGAL::coplanar(hull.point(hull.source(edge)), hull.point(hull.target(edge)),
                            hull.point(hull.target(hull.next(edge))), hull.point(hull.target(hull.next(back)))))
          continue;
        plane[there] = first;
        next.push_back(there);
      }
    }
  }
  return plane;
}

}  // namespace

std::vector<std::array<std::int32_t, 3>> convex_hull(const std::vector<Vec3d>& points) {
  std::vector<Point> sites;
  std::map<Point, std::int32_t> number;
  for (const Vec3d& p : points) {
    sites.emplace_back(p.x, p.y, p.z);
    number.emplace(sites.back(), static_cast<std::int32_t>(sites.size()) - 1);
  }
  Mesh hull;
  CGAL::convex_hull_3(sites.begin(), sites.end(), hull);
  // CGAL's triangulation of a polygonal face depends on memory addresses and differs from run to run. Each face is
  // therefore triangulated again, from its corners only, starting at the smallest corner number.
  const std::vector<std::size_t> plane = planes_of(hull);
  std::vector<std::map<Mesh::Vertex_index, Mesh::Vertex_index>> border(plane.size());
  for (const Mesh::Halfedge_index edge : hull.halfedges())
    if (plane[hull.face(edge)] != plane[hull.face(hull.opposite(edge))])
      border[plane[hull.face(edge)]].emplace(hull.source(edge), hull.target(edge));
  std::vector<std::array<std::int32_t, 3>> facets;
  for (const auto& next : border) {
    std::vector<std::int32_t> corners;
    if (next.empty()) continue;
    Mesh::Vertex_index before = next.begin()->first;
    for (std::size_t n = 0; n < next.size(); ++n) {
      const Mesh::Vertex_index here = next.at(before), after = next.at(here);
      if (!CGAL::collinear(hull.point(before), hull.point(here), hull.point(after)))
        corners.push_back(number.at(hull.point(here)));
      before = here;
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    for (std::size_t n = 2; n < corners.size(); ++n) facets.push_back({corners[0], corners[n - 1], corners[n]});
  }
  std::sort(facets.begin(), facets.end());
  return facets;
}

}  // namespace macadam
