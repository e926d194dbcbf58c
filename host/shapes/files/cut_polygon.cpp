// SPDX-License-Identifier: GPL-3.0-or-later
// cut_polygon.cpp  Divides quadrilaterals along the better diagonal and other polygons by CGAL's constrained Delaunay
// triangulation.
#include "host/shapes/files/cut_polygon.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/Hilbert_sort_median_2.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace macadam {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel>;  // info: corner number
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<int, Kernel, CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
                                               CGAL::No_constraint_intersection_tag>;

using Triangle = std::array<std::int32_t, 3>;  // corner numbers
/// Maps each pair of corner numbers (lower, higher) to a count: how often the outline runs from the lower to the higher
/// corner, minus how often the outline runs back.
using Outline = std::map<std::pair<std::int32_t, std::int32_t>, int>;

bool same(const Vec3d& a, const Vec3d& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

void add_edge(Outline& outline, std::int32_t from, std::int32_t to, int times) {
  outline[{std::min(from, to), std::max(from, to)}] += from < to ? times : -times;
}

/// One polygon: its corners, mean plane and projection along the coordinate axis nearest to its normal.
class Polygon {
 public:
  explicit Polygon(std::vector<Vec3d> corners) : corner_(std::move(corners)) {
    for (const Vec3d& p : corner_) middle_ = middle_ + (1.0 / static_cast<double>(size())) * p;
    for (std::size_t k = 0; k < size(); ++k)
      normal_ = normal_ + cross(corner_[k] - middle_, corner_[(k + 1) % size()] - middle_);
    const double x = std::abs(normal_.x), y = std::abs(normal_.y), z = std::abs(normal_.z);
    axis_ = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    turned_ = (axis_ == 0 ? normal_.x : axis_ == 1 ? normal_.y : normal_.z) < 0;
  }

  double bend() const {
    double off = 0, radius = 0;
    for (const Vec3d& p : corner_) {
      off = std::max(off, std::abs(dot(normal_, p - middle_)));
      radius = std::max(radius, norm(p - middle_));
    }
    const double length = norm(normal_);
    return length > 0 && radius > 0 ? off / length / radius : 0;
  }

  /// Divides along the diagonal for which the scalar product of the two (unnormalised) triangle normals is larger. A
  /// larger product means that the triangles face the same way and have more equal areas.
  std::vector<Triangle> quadrilateral() const {
    const Vec3d &p = corner_[0], &q = corner_[1], &r = corner_[2], &s = corner_[3];
    const double by_pr = dot(cross(q - p, r - q), cross(s - r, p - s));
    const double by_qs = dot(cross(r - q, s - r), cross(p - s, q - p));
    if (by_pr >= by_qs) return {{0, 1, 2}, {0, 2, 3}};
    return {{0, 1, 3}, {1, 2, 3}};
  }

  /// Returns the triangles within the outline. Returns nothing if the outline crosses or touches itself, in space or in
  /// the projection.
  std::optional<std::vector<Triangle>> within_outline() const {
    Triangulation triangulation;
    const std::vector<std::int32_t> first = insert_corners(triangulation);
    if (first.empty() || triangulation.dimension() != 2) return {};
    mark_inside(triangulation);
    std::vector<Triangle> triangles;
    Outline outline;
    for (const auto face : triangulation.finite_face_handles()) {
      if (face->info() % 2 == 0) continue;
      Triangle t{face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()};
      if (turned_) std::swap(t[1], t[2]);
      for (std::size_t k = 0; k < 3; ++k) add_edge(outline, t[k], t[(k + 1) % 3], 1);
      triangles.push_back(t);
    }
    // The triangles must have exactly the polygon's outline.
    for (std::size_t k = 0; k < size(); ++k) add_edge(outline, first[k], first[(k + 1) % size()], -1);
    const bool kept = std::all_of(outline.begin(), outline.end(), [](const auto& edge) { return edge.second == 0; });
    if (triangles.empty() || !kept) return {};
    return triangles;
  }

  /// Divides into triangles that all share corner 0. This is the fallback for outlines that cross themselves.
  std::vector<Triangle> fan() const {
    std::vector<Triangle> triangles;
    for (std::int32_t k = 1; k + 1 < static_cast<std::int32_t>(size()); ++k) triangles.push_back({0, k, k + 1});
    return triangles;
  }

  std::size_t size() const { return corner_.size(); }

 private:
  /// Projects one point along the coordinate axis nearest to the polygon's normal. Coordinates are only dropped, so
  /// nothing is rounded.
  Triangulation::Point seen(const Vec3d& p) const {
    if (axis_ == 0) return {p.y, p.z};
    return axis_ == 1 ? Triangulation::Point(p.z, p.x) : Triangulation::Point(p.x, p.y);
  }

  /// Returns the corner numbers in the order of a Hilbert curve. Consecutive corners are near each other, which makes
  /// their insertion fast.
  std::vector<std::int32_t> in_space() const {
    std::vector<Triangulation::Point> points;
    for (const Vec3d& p : corner_) points.push_back(seen(p));
    std::vector<std::int32_t> order(size());
    std::iota(order.begin(), order.end(), 0);
    using Traits = CGAL::Spatial_sort_traits_adapter_2<Kernel, CGAL::Pointer_property_map<Triangulation::Point>::type>;
    CGAL::Hilbert_sort_median_2<Traits, CGAL::Sequential_tag> sort(Traits(CGAL::make_property_map(points)));
    sort(order.begin(), order.end());
    return order;
  }

  /// Inserts corners and edges into the triangulation. Returns, for each corner, the number of the first corner at its
  /// position; returns an empty list if the outline crosses or touches itself.
  std::vector<std::int32_t> insert_corners(Triangulation& triangulation) const {
    std::vector<Triangulation::Vertex_handle> vertex(size());
    Triangulation::Face_handle near;
    for (const std::int32_t k : in_space()) {
      const std::size_t before = triangulation.number_of_vertices();
      vertex[k] = triangulation.insert(seen(corner_[k]), near);
      near = vertex[k]->face();
      const bool is_new = triangulation.number_of_vertices() > before;
      vertex[k]->info() = is_new ? k : std::min(vertex[k]->info(), k);
    }
    std::vector<std::int32_t> first;
    for (std::size_t k = 0; k < size(); ++k) {
      first.push_back(vertex[k]->info());
      if (!same(corner_[first[k]], corner_[k])) return {};  // different corners coincide in the projection
    }
    // An edge that the outline passes in both directions connects the outer boundary with a hole. Such an edge bounds
    // no area and is left out.
    Outline edges;
    for (std::size_t k = 0; k < size(); ++k) add_edge(edges, first[k], first[(k + 1) % size()], 1);
    try {
      for (const auto& [ends, times] : edges)
        if (times != 0) triangulation.insert_constraint(vertex[ends.first], vertex[ends.second]);
    } catch (const Triangulation::Intersection_of_constraints_exception&) { return {}; }
    return first;
  }

  /// Sets the info of each face to the number of outline edges between the face and the outside. Faces with odd numbers
  /// are inside.
  static void mark_inside(Triangulation& triangulation) {
    for (const auto face : triangulation.all_face_handles()) face->info() = -1;
    std::vector<Triangulation::Face_handle> level{triangulation.infinite_face()}, next;
    for (int depth = 0; !level.empty(); ++depth, level = std::exchange(next, {})) {
      while (!level.empty()) {
        const Triangulation::Face_handle face = level.back();
        level.pop_back();
        if (face->info() >= 0) continue;
        face->info() = depth;
        for (int k = 0; k < 3; ++k) {
          const bool edge = triangulation.is_constrained({face, k});
          if (face->neighbor(k)->info() < 0) (edge ? next : level).push_back(face->neighbor(k));
        }
      }
    }
  }

  std::vector<Vec3d> corner_;
  Vec3d middle_{}, normal_{};
  int axis_ = 0;         // coordinate axis nearest to the normal
  bool turned_ = false;  // the normal points in the negative direction of that axis
};

std::vector<Triangle> triangles_of(const Polygon& polygon, bool& crossed) {
  if (polygon.size() == 4) return polygon.quadrilateral();
  if (auto triangles = polygon.within_outline()) return *std::move(triangles);
  crossed = true;
  return polygon.fan();
}

}  // namespace

PolygonCut cut_polygon(const std::vector<Vec3d>& points, std::span<const std::int64_t> corners,
                       std::vector<std::array<std::int32_t, 3>>& facets) {
  std::vector<std::int32_t> number;
  std::vector<Vec3d> corner;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3d& p = points[corners[k]];
    if (same(p, points[corners[k == 0 ? corners.size() - 1 : k - 1]])) continue;
    number.push_back(static_cast<std::int32_t>(corners[k]));
    corner.push_back(p);
  }
  if (corner.size() < 3) {  // a facet without area, which check_surface() reports
    const auto n = static_cast<std::int32_t>(corners[0]);
    facets.push_back({n, n, n});
    return {};
  }
  if (corner.size() == 3) {
    facets.push_back({number[0], number[1], number[2]});
    return {};
  }
  const Polygon polygon(std::move(corner));
  PolygonCut cut{polygon.bend(), false};
  for (const Triangle& t : triangles_of(polygon, cut.crossed))
    facets.push_back({number[t[0]], number[t[1]], number[t[2]]});
  return cut;
}

}  // namespace macadam
