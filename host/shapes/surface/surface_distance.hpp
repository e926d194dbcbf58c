// SPDX-License-Identifier: GPL-3.0-or-later
/// \file surface_distance.hpp  Computes the signed distance of points from a closed surface, exactly and fast for many
/// points.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "host/spheres/relaxation.hpp"
#include "macadam/shape.hpp"

namespace macadam {

/// Computes the signed distance from a closed surface, exactly for the polyhedron. An octree over the surface's
/// bounding box lists, in each leaf, the facets that can be nearest to a point of that leaf. The sign follows from the
/// angle-weighted normal of the facet, edge or point on which the nearest point lies (Bærentzen & Aanæs 2005); this
/// sign is correct in all three cases.
class SurfaceDistance {
 public:
  /// Copies the data that it needs from `surface`, for which check_surface() must find no fault.
  explicit SurfaceDistance(const Surface& surface);

  /// Returns the depth of a point [m], negative outside, and the unit vector along which the depth grows fastest. If
  /// the depth exceeds `reach` [m], a lower bound of it that also exceeds `reach` may be returned instead, without a
  /// direction.
  WallDepth below(const Vec3d& point, double reach) const;

  /// Returns whether a point lies in the bounding box of the surface. The test is fast, whereas computing the depth of
  /// a point outside the box is slow, because all facets are searched.
  bool may_contain(const Vec3d& p) const {
    return p.x >= low_.x && p.x <= high_.x && p.y >= low_.y && p.y <= high_.y && p.z >= low_.z && p.z <= high_.z;
  }

  /// Returns the depth [m], negative outside.
  double depth(const Vec3d& point) const;

  /// Corners of the bounding box [m].
  const Vec3d& low() const { return low_; }
  const Vec3d& high() const { return high_; }

 private:
  /// A facet and the normals of its face, edges and corners. Normals of corners and edges are sums over the facets
  /// around them and are not normalised; the normal of the face is a unit vector.
  struct Facet {
    std::array<Vec3d, 3> corner;
    std::array<Vec3d, 7> normal;  ///< normals of corners 0, 1, 2, of edges 01, 12, 20, and of the face
  };
  /// The nearest point of the surface, its squared distance, and the normal there.
  struct Nearest {
    double squared;
    Vec3d point, normal;
  };
  struct Candidate {
    double distance;  ///< distance from the centre of the cell that lists the candidate [m]
    std::int32_t facet;
  };
  /// A cell of the octree.
  struct Node {
    double depth;              ///< depth of the cell's centre [m]
    std::int32_t child;        ///< index of the first of eight children; −1 for a leaf
    std::int32_t first, last;  ///< range of the leaf's candidates in candidates_
  };

  /// Returns the nearest point of one facet.
  static Nearest nearest(const Facet& facet, const Vec3d& point);
  /// Returns the nearest point of the candidates. The candidates are sorted by their distance from another point, which
  /// is `way` [m] from `point`.
  Nearest nearest_of(std::span<const Candidate> nearest_first, double way, const Vec3d& point) const;
  /// Makes a node and, recursively, its children.
  void grow(std::int32_t node, const Vec3d& centre, const Vec3d& half, int level, std::span<const Candidate> candidates,
            double way);

  std::vector<Facet> facet_;
  std::vector<Node> node_;
  std::vector<Candidate> all_;         ///< every facet, with distance 0 because the distance is not known
  std::vector<Candidate> candidates_;  ///< candidates of each leaf, sorted by distance from the leaf's centre
  Vec3d low_, high_;
};

}  // namespace macadam
