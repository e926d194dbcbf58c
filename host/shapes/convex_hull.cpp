// SPDX-License-Identifier: GPL-3.0-or-later
/// \file convex_hull.cpp  CGAL's quickhull: exact predicates, plain arrays out.
#include "host/shapes/convex_hull.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/MP_Float.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <map>

namespace macadam {

std::vector<std::array<std::int32_t, 3>> convex_hull(const std::vector<Vec3d>& points) {
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
  using Mesh = CGAL::Surface_mesh<Point>;
  std::vector<Point> sites;
  std::map<Point, std::int32_t> number;
  for (const Vec3d& p : points) {
    sites.emplace_back(p.x, p.y, p.z);
    number.emplace(sites.back(), static_cast<std::int32_t>(sites.size()) - 1);
  }
  Mesh hull;
  CGAL::convex_hull_3(sites.begin(), sites.end(), hull);
  std::vector<std::array<std::int32_t, 3>> facets;
  for (const Mesh::Face_index face : hull.faces()) {
    std::array<std::int32_t, 3> facet;
    auto corner = facet.begin();
    for (const Mesh::Vertex_index v : hull.vertices_around_face(hull.halfedge(face)))
      *corner++ = number.at(hull.point(v));
    std::rotate(facet.begin(), std::min_element(facet.begin(), facet.end()), facet.end());
    facets.push_back(facet);
  }
  std::sort(facets.begin(), facets.end());
  return facets;
}

}  // namespace macadam
