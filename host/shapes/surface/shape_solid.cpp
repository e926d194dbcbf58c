// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shape_solid.cpp  Uses CGAL's AABB tree of the facets, with exact predicates.
#include "host/shapes/surface/shape_solid.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "host/shapes/surface/facet_tree.hpp"

namespace macadam {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Facets = FacetTree<Kernel, Mesh>;
using Side = CGAL::Side_of_triangle_mesh<Mesh, Kernel>;

Kernel::Point_3 point_of(const Vec3d& p) { return {p.x, p.y, p.z}; }

Mesh mesh_of(const Surface& surface) {
  Mesh mesh;
  for (const Vec3d& p : surface.points) mesh.add_vertex(point_of(p));
  for (const auto& f : surface.facets)
    mesh.add_face(Mesh::Vertex_index(f[0]), Mesh::Vertex_index(f[1]), Mesh::Vertex_index(f[2]));
  return mesh;
}

}  // namespace

struct ShapeSolid::Tree {
  Mesh mesh;
  Facets facets;
  Side side;

  explicit Tree(const Surface& surface)
      : mesh(mesh_of(surface)), facets(faces(mesh).begin(), faces(mesh).end(), mesh), side(facets) {
    facets.build();
    facets.accelerate_distance_queries();
  }
};

ShapeSolid::ShapeSolid(const Surface& surface) : tree_(std::make_unique<Tree>(surface)) {}
ShapeSolid::~ShapeSolid() = default;
ShapeSolid::ShapeSolid(ShapeSolid&&) noexcept = default;

Vec3d ShapeSolid::nearest(const Vec3d& point) const {
  const Kernel::Point_3 p = tree_->facets.closest_point(point_of(point));
  return {p.x(), p.y(), p.z()};
}

double ShapeSolid::distance(const Vec3d& point) const {
  return std::sqrt(tree_->facets.squared_distance(point_of(point)));
}

bool ShapeSolid::contains(const Vec3d& point) const { return tree_->side(point_of(point)) != CGAL::ON_UNBOUNDED_SIDE; }

bool ShapeSolid::touches(const Vec3d& a, const Vec3d& b, const Vec3d& c) const {
  return tree_->facets.do_intersect(Kernel::Triangle_3(point_of(a), point_of(b), point_of(c)));
}

void ShapeSolid::crossings(const Vec3d& a, const Vec3d& b, std::vector<double>& fractions) const {
  std::vector<Mesh::Face_index> met;
  tree_->facets.all_intersected_primitives(Kernel::Segment_3(point_of(a), point_of(b)), std::back_inserter(met));
  const Mesh& mesh = tree_->mesh;
  for (const Mesh::Face_index facet : met) {
    std::array<Vec3d, 3> corner;
    Mesh::Halfedge_index at = mesh.halfedge(facet);
    for (Vec3d& c : corner) {
      const Kernel::Point_3& p = mesh.point(mesh.target(at));
      c = {p.x(), p.y(), p.z()};
      at = mesh.next(at);
    }
    const Vec3d normal = cross(corner[1] - corner[0], corner[2] - corner[0]);
    const double rise = dot(normal, b - a);
    if (rise != 0) fractions.push_back(std::clamp(dot(normal, corner[0] - a) / rise, 0.0, 1.0));
  }
}

}  // namespace macadam
