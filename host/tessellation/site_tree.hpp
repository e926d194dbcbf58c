// SPDX-License-Identifier: GPL-3.0-or-later
/// \file site_tree.hpp  Particles in boxes within boxes, and who of them is near.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "host/tessellation/weighted_sites.hpp"

namespace macadam {

/// An upright box [m].
struct Bounds {
  Vec3d low, high;

  void grow(const Vec3d& p);
  Bounds wider(double by) const { return {low - Vec3d{by, by, by}, high + Vec3d{by, by, by}}; }
  bool has(const Vec3d& p) const;
  bool meets(const Bounds& other) const;
  /// From a point to the nearest one of the box, squared. [m²]
  double distance2(const Vec3d& p) const;
};

/// Some particles, halved along the longest edge of the box of their centres until few are left.
class SiteTree {
 public:
  /// Of `numbers`, which it sorts and, as the sites, must outlive it.
  SiteTree(const WeightedSites& sites, std::span<std::int32_t> numbers);

  std::span<const std::int32_t> numbers() const { return numbers_; }
  const Bounds& bounds() const { return nodes_.front().bounds; }

  /// f(number) for those whose centre is in a box that is wider by their radius than this one.
  template <class F>
  void each_reaching(const Bounds& bounds, F&& f) const {
    visit([&](const Node& node) { return node.bounds.meets(bounds.wider(std::sqrt(node.most_weight))); },
          [&](std::int32_t i) {
            const WeightedSite site = sites_[i];
            if (bounds.wider(std::sqrt(site.weight)).has(site.centre)) f(i);
          });
  }

  /// f(number) for those with at most this power at a point.
  template <class F>
  void each_of_power(const Vec3d& p, double most, F&& f) const {
    visit([&](const Node& node) { return node.bounds.distance2(p) - node.most_weight <= most; },
          [&](std::int32_t i) {
            if (sites_[i].power(p) <= most) f(i);
          });
  }

 private:
  struct Node {
    Bounds bounds;
    double most_weight;
    std::size_t begin, end;   ///< in the numbers
    std::size_t second_half;  ///< node; the first half is the next one; 0: a leaf
  };

  void divide(std::size_t begin, std::size_t end);

  template <class Wanted, class F>
  void visit(Wanted&& wanted, F&& f) const {
    std::size_t waiting[64], count = 0;  // halves of less than 2^31 sites
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

/// Divides particles into so many parts of about equal number, each in a box of its own, one behind the other: where
/// they begin, and the end.
std::vector<std::size_t> divide_into(const WeightedSites& sites, std::span<std::int32_t> numbers, std::size_t parts);

}  // namespace macadam
