// SPDX-License-Identifier: GPL-3.0-or-later
/// \file site_tree.hpp  Finds the particles near a point or a box by a tree of bounding boxes.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "host/tessellation/weighted_sites.hpp"

namespace macadam {

/// An axis-aligned box [m].
struct BoundingBox {
  Vec3d low, high;

  /// Extends the box to contain the point.
  void grow(const Vec3d& p);
  /// Returns the box extended by a length on all sides.
  BoundingBox wider(double by) const { return {low - Vec3d{by, by, by}, high + Vec3d{by, by, by}}; }
  /// Returns whether the box contains the point.
  bool has(const Vec3d& p) const;
  /// Returns whether the two boxes have a common point.
  bool meets(const BoundingBox& other) const;
  /// Returns the squared distance of a point from the box [m²], 0 inside.
  double distance2(const Vec3d& p) const;
};

/// A tree over some particles, which are halved along the longest edge of the bounding box of their centres until few
/// are left.
class SiteTree {
 public:
  /// Makes the tree of the particles `numbers`, which are reordered. `numbers` and `sites` must outlive the tree.
  SiteTree(const WeightedSites& sites, std::span<std::int32_t> numbers);

  std::span<const std::int32_t> numbers() const { return numbers_; }
  const BoundingBox& bounds() const { return nodes_.front().bounds; }

  /// Calls f(number) for each particle whose sphere may reach into the box. These are the particles with centres in the
  /// box widened by the sphere's radius.
  template <class F>
  void each_reaching(const BoundingBox& bounds, F&& f) const {
    visit([&](const Node& node) { return node.bounds.meets(bounds.wider(std::sqrt(node.most_weight))); },
          [&](std::int32_t i) {
            const WeightedSite site = sites_[i];
            if (bounds.wider(std::sqrt(site.weight)).has(site.centre)) f(i);
          });
  }

  /// Calls f(number) for each particle whose power at point p is at most `most`.
  template <class F>
  void each_of_power(const Vec3d& p, double most, F&& f) const {
    visit([&](const Node& node) { return node.bounds.distance2(p) - node.most_weight <= most; },
          [&](std::int32_t i) {
            if (sites_[i].power(p) <= most) f(i);
          });
  }

 private:
  /// A node: the range of its particles, their bounding box, and their largest weight.
  struct Node {
    BoundingBox bounds;
    double most_weight;
    std::size_t begin, end;  ///< range in numbers_
    /// Index of the node of the second half, or 0 for a leaf. The node of the first half follows this node.
    std::size_t second_half;
  };

  /// Makes the node of a range and, recursively, its children.
  void divide(std::size_t begin, std::size_t end);

  /// Calls f for the particles in the leaves that are reached through nodes for which wanted(node) is true.
  template <class Wanted, class F>
  void visit(Wanted&& wanted, F&& f) const {
    std::size_t waiting[64], count = 0;  // nodes to visit; 64 are enough for halving 2^31 sites
    for (waiting[count++] = 0; count > 0;) {
      const std::size_t k = waiting[--count];
      const Node& node = nodes_[k];
      if (!wanted(node)) continue;
      if (node.second_half > 0) {
        waiting[count++] = node.second_half, waiting[count++] = k + 1;
        continue;
      }
      for (std::size_t i = node.begin; i < node.end; ++i) f(numbers_[i]);
    }
  }

  const WeightedSites& sites_;
  std::span<std::int32_t> numbers_;
  std::vector<Node> nodes_;
};

/// Divides particles into `parts` ranges of about equal number, each in its own box, and reorders `numbers`
/// accordingly. Returns the beginning of each range, and the end.
std::vector<std::size_t> divide_into(const WeightedSites& sites, std::span<std::int32_t> numbers, std::size_t parts);

}  // namespace macadam
