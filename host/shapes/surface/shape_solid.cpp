// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shape_solid.cpp  Uses CGAL's AABB tree of the facets, with exact predicates.
#include "host/shapes/surface/shape_solid.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>

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

}  // namespace macadam
