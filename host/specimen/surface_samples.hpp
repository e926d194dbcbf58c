// SPDX-License-Identifier: GPL-3.0-or-later
/// \file surface_samples.hpp  Points of a surface at which it is tested against other bodies, in a tree of balls.
#pragma once

#include <cstdint>
#include <vector>

#include "macadam/shape.hpp"

namespace macadam {

/// Points and sharp edges are what a surface meets others with first: its corners, and points along its edges, the
/// closer the sharper an edge is.
class SurfaceSamples {
 public:
  /// Between two samples of an edge no more than about `tolerance` [m] of it can dip into a plane unnoticed.
  SurfaceSamples(const Surface& surface, double tolerance);

  /// Calls `visit(point)` for all samples whose balls `reaches(centre, radius)` lets pass.
  template <class Reaches, class Visit>
  void visit(const Reaches& reaches, const Visit& visit) const {
    for (std::size_t k = 0; k < node_.size();) {
      const Node& n = node_[k];
      if (!reaches(n.centre, n.radius)) {
        k = n.next;
        continue;
      }
      for (std::uint32_t i = n.begin; i < n.end; ++i) visit(point_[i]);
      ++k;
    }
  }

  std::size_t size() const { return point_.size(); }

 private:
  struct Node {
    Vec3d centre;
    double radius;
    std::uint32_t begin, end;  ///< samples of a leaf; none elsewhere
    std::uint32_t next;        ///< the node that follows this one's descendants
  };
  void build(std::uint32_t begin, std::uint32_t end);

  std::vector<Vec3d> point_;
  std::vector<Node> node_;  ///< a parent before its children
};

}  // namespace macadam
