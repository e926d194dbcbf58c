// SPDX-License-Identifier: GPL-3.0-or-later
/// \file surface_distance.hpp  How deep a point lies below a surface: exact, and fast for many points.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "host/spheres/relaxation.hpp"
#include "macadam/shape.hpp"

namespace macadam {

/// Signed distance from a closed surface, exact for the polyhedron. An octree over the surface's box lists in each of
/// its leaves the facets that can be the nearest of a point there; the sign follows from the angle-weighted normals of
/// facets, edges and points (Bærentzen & Aanæs 2005), which are right wherever the nearest point lies.
class SurfaceDistance {
 public:
  /// `surface` must be good(); it is copied as far as needed.
  explicit SurfaceDistance(const Surface& surface);

  /// Depth of a point [m], negative outside, and the unit vector along which it grows fastest. Where the depth exceeds
  /// `reach` [m] a lower bound may come in its place, which exceeds `reach` as well, and no direction.
  WallDepth below(const Vec3d& point, double reach) const;

  /// Whether a point is in the box around the surface: at once, where a depth outside it takes all facets.
  bool may_contain(const Vec3d& p) const {
    return p.x >= low_.x && p.x <= high_.x && p.y >= low_.y && p.y <= high_.y && p.z >= low_.z && p.z <= high_.z;
  }

  /// Depth [m], negative outside.
  double depth(const Vec3d& point) const;

  /// Corners of the box around the surface [m].
  const Vec3d& low() const { return low_; }
  const Vec3d& high() const { return high_; }

 private:
  /// Normals sum facets around the feature; none is of unit length but that of the face.
  struct Facet {
    std::array<Vec3d, 3> corner;
    std::array<Vec3d, 7> normal;  ///< of corners 0, 1, 2, of edges 01, 12, 20, of the face
  };
  struct Nearest {
    double squared;
    Vec3d point, normal;
  };
  struct Candidate {
    double distance;  ///< from a point near the one asked for, its cell's centre [m]
    std::int32_t facet;
  };
  struct Node {
    double depth;              ///< of its centre [m]
    std::int32_t child;        ///< the first of eight, −1 in a leaf
    std::int32_t first, last;  ///< in candidates_
  };

  static Nearest nearest(const Facet& facet, const Vec3d& point);
  Nearest nearest_of(std::span<const Candidate> nearest_first, double way, const Vec3d& point) const;
  void grow(std::int32_t node, const Vec3d& centre, const Vec3d& half, int level, std::span<const Candidate> candidates,
            double way);

  std::vector<Facet> facet_;
  std::vector<Node> node_;
  std::vector<Candidate> all_;         ///< every facet, at an unknown distance: 0
  std::vector<Candidate> candidates_;  ///< of each leaf, nearest to its centre first
  Vec3d low_, high_;
};

}  // namespace macadam
