// SPDX-License-Identifier: GPL-3.0-or-later
/// \file interval_search.hpp  Finds the intervals that contain given positions. Sweeps over the positions in ascending
/// order, so that not every pair of interval and position is tested.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace macadam {

/// A closed interval of numbers, for example the extent of an edge along an axis.
struct Interval {
  double low, high;
};

/// Calls found(interval number, position number) for every pair with low − tolerance ≤ position ≤ high + tolerance.
/// Positions are visited in ascending order. The order of calls depends on the values only.
template <class Found>
void stab(const std::vector<Interval>& intervals, const std::vector<double>& positions, double tolerance,
          Found&& found) {
  std::vector<std::size_t> begins(intervals.size()), order(positions.size()), open;
  std::iota(begins.begin(), begins.end(), std::size_t{0});
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(begins.begin(), begins.end(),
                   [&](std::size_t a, std::size_t b) { return intervals[a].low < intervals[b].low; });
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return positions[a] < positions[b]; });
  std::size_t next = 0;
  for (const std::size_t p : order) {
    for (; next < begins.size() && intervals[begins[next]].low - tolerance <= positions[p]; ++next) {
      open.push_back(begins[next]);
    }
    std::erase_if(open, [&](std::size_t i) { return intervals[i].high + tolerance < positions[p]; });
    for (const std::size_t i : open) found(i, p);
  }
}

}  // namespace macadam
