// SPDX-License-Identifier: GPL-3.0-or-later
/// \file neighbours.hpp  Full neighbour lists of spheres of any mix of sizes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/spheres/sphere_grid.hpp"
#include "macadam/specimen.hpp"

namespace macadam {

/// Loops over fewer spheres than this are not worth waking threads for.
inline constexpr std::size_t parallel_from = 1000;

/// For every sphere, the spheres whose surfaces are closer to its own than `skin`, in an order that depends on the
/// specimen alone: sums over a row are the same for any number of threads.
class Neighbours {
 public:
  /// Lists for `specimen`, which must outlive this; `cell` and `skin` in metres.
  Neighbours(const Specimen& specimen, double cell, double skin);

  /// Lists again for the centres as they are now.
  void rebuild();

  std::span<const std::int32_t> of(std::size_t particle) const {
    return {list_.data() + start_[particle], start_[particle + 1] - start_[particle]};
  }

 private:
  template <class Visit>
  void larger_neighbours(std::size_t particle, const Visit& visit) const;

  const Specimen& specimen_;
  double skin_;
  SphereGrid grid_;
  std::vector<std::size_t> larger_start_, start_, end_;
  std::vector<std::int32_t> larger_, list_;
};

}  // namespace macadam
