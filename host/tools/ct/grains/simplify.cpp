// SPDX-License-Identifier: GPL-3.0-or-later
// simplify.cpp  Reduces the number of facets with CGAL.
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include "host/tools/ct/grains/isosurface.hpp"
#include "host/shapes/surface/facet_tree.hpp"

namespace macadam::ct {
namespace {

namespace sms = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// Converts a surface to CGAL's mesh.
Mesh mesh_of(const Surface& surface) {
  Mesh mesh;
  for (const Vec3d& p : surface.points) mesh.add_vertex({p.x, p.y, p.z});
  for (const auto& [a, b, c] : surface.facets) {
    using Vertex = Mesh::Vertex_index;
    mesh.add_face(Vertex(static_cast<Mesh::size_type>(a)), Vertex(static_cast<Mesh::size_type>(b)),
                  Vertex(static_cast<Mesh::size_type>(c)));
  }
  return mesh;
}

/// Converts a mesh to a surface, leaving out removed vertices.
Surface surface_of(const Mesh& mesh) {
  Surface surface;
  std::vector<std::int32_t> number(mesh.num_vertices() + mesh.number_of_removed_vertices(), -1);
  for (const Mesh::Vertex_index v : mesh.vertices()) {
    number[v] = static_cast<std::int32_t>(surface.points.size());
    surface.points.push_back({mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z()});
  }
  for (const Mesh::Face_index face : mesh.faces()) {
    std::array<std::int32_t, 3> facet;
    auto corner = facet.begin();
    for (const Mesh::Vertex_index v : mesh.vertices_around_face(mesh.halfedge(face))) *corner++ = number[v];
    surface.facets.push_back(facet);
  }
  return surface;
}

/// Collapses edges until the mesh has about `facets` facets.
void reduce(Mesh& mesh, int facets) {
  // The function `stop` counts edges, because CGAL's own stop predicates have different names in versions 5 and 6. A
  // closed mesh has 3/2 edges per facet.
  const std::size_t most = static_cast<std::size_t>(facets) * 3 / 2;
  const auto stop = [most](const auto& /*cost*/, const auto& /*edge*/, std::size_t /*first*/, std::size_t edges) {
    return edges < most;
  };
  // refuses collapses that turn a facet over, because it would intersect its neighbours
  const sms::Bounded_normal_change_placement<sms::LindstromTurk_placement<Mesh>> placement;
  sms::edge_collapse(mesh, stop, CGAL::parameters::get_cost(sms::LindstromTurk_cost<Mesh>()).get_placement(placement));
}

/// Returns the largest distance of the points from a surface, measured at a sample of about two thousand points.
double distance(const std::vector<Vec3d>& points, const Mesh& mesh) {
  FacetTree<Kernel, Mesh> tree(faces(mesh).first, faces(mesh).second, mesh);
  tree.accelerate_distance_queries();
  double largest = 0;
  for (std::size_t p = 0; p < points.size(); p += points.size() / 2000 + 1)
    largest = std::max(largest, tree.squared_distance({points[p].x, points[p].y, points[p].z}));
  return std::sqrt(largest);
}

}  // namespace

Simplified simplified(const Surface& surface, int facets, int most, double error) {
  Mesh mesh = mesh_of(surface);
  if (static_cast<int>(mesh.num_faces()) > most) reduce(mesh, most);
  Mesh fewer = mesh;
  if (static_cast<int>(mesh.num_faces()) > facets) reduce(fewer, facets);
  if (const double found = distance(surface.points, fewer); found <= error) return {surface_of(fewer), found};
  return {surface_of(mesh), distance(surface.points, mesh)};
}

}  // namespace macadam::ct
