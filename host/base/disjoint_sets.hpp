// SPDX-License-Identifier: GPL-3.0-or-later
/// \file disjoint_sets.hpp  Groups numbered things into connected sets (union–find).
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

namespace macadam {

/// Disjoint sets of the numbers 0 … n − 1, which are joined pair by pair. Each set is identified by one of its members,
/// its root.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  /// Returns the root of the set that contains i. Shortens the path from i to the root, so that later searches are
  /// faster.
  std::int32_t find(std::int32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// Merges the sets that contain i and j.
  void join(std::int32_t i, std::int32_t j) { parent_[find(i)] = find(j); }

 private:
  std::vector<std::int32_t> parent_;
};

}  // namespace macadam
