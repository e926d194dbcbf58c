// SPDX-License-Identifier: GPL-3.0-or-later
/// \file disjoint_sets.hpp  Which of many things hang together.
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

namespace macadam {

/// Sets that are joined pair by pair; each is known by one of its members.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  std::int32_t find(std::int32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::int32_t i, std::int32_t j) { parent_[find(i)] = find(j); }

 private:
  std::vector<std::int32_t> parent_;
};

}  // namespace macadam
