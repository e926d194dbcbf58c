// SPDX-License-Identifier: GPL-3.0-or-later
/// \file surface_samples.hpp  Samples points of a surface for tests against other bodies, and stores them in a tree of
/// balls.
#pragma once

#include <cstdint>
#include <vector>

#include "macadam/shape.hpp"

namespace macadam {

/// Sample points where a surface can first touch other bodies: its corners, and points along its edges. The sharper an
/// edge, the closer its points.
class SurfaceSamples {
 public:
  /// The samples of an edge are so close that between two of them the edge can penetrate a plane by at most about
  /// `tolerance` [m] without being detected.
  SurfaceSamples(const Surface& surface, double tolerance);

  /// Calls `visit(point)` for all samples in those balls for which `reaches(centre, radius)` is true.
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
  /// A ball that contains a range of samples.
  struct Node {
    Vec3d centre;
    double radius;
    std::uint32_t begin, end;  ///< samples of a leaf; empty for other nodes
    std::uint32_t next;        ///< index of the node after this node and all its descendants
  };
  /// Makes the node of a range of samples and, recursively, its children.
  void build(std::uint32_t begin, std::uint32_t end);

  std::vector<Vec3d> point_;
  std::vector<Node> node_;  ///< depth-first: a parent precedes its children
};

}  // namespace macadam
