// SPDX-License-Identifier: GPL-3.0-or-later
/// \file disjoint_sets.hpp  Groups numbered items into connected sets (union–find).
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace macadam {

/// Disjoint sets of the numbers 0 … n − 1. At first each number is a set of its own; join() merges two sets. The root
/// of a set is its smallest member.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  /// Returns the root of the set that contains i. Shortens the path from i to the root, so that later searches are
  /// faster.
  std::int32_t find(std::int32_t i) {
    while (parent(i) != i) i = parent(i) = parent(parent(i));
    return i;
  }
  /// Merges the sets that contain i and j.
  void join(std::int32_t i, std::int32_t j) {
    std::int32_t low = find(i), high = find(j);
    if (high < low) std::swap(low, high);
    parent(high) = low;
  }

 private:
  std::int32_t& parent(std::int32_t i) { return parent_[static_cast<std::size_t>(i)]; }
  std::vector<std::int32_t> parent_;
};

}  // namespace macadam
