// SPDX-License-Identifier: GPL-3.0-or-later
/// \file neighbours.hpp  Full neighbour lists of spheres of any mix of sizes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/spheres/sphere_bins.hpp"
#include "host/spheres/sphere_grid.hpp"
#include "macadam/specimen.hpp"

namespace macadam {

/// Loops over fewer spheres than this are not worth waking threads for.
inline constexpr std::size_t parallel_from = 1000;

/// For every sphere, at least the spheres whose surfaces are closer to its own than `skin`, in an order that depends on
/// radii and numbers alone: first the smaller spheres of lower number than its own, then the larger ones, then the
/// smaller ones of higher number, each part by number; of equal spheres the one of higher number counts as the larger.
/// So sums over a row to which spheres that do not touch add nothing have the same bits for any number of threads and
/// any skin.
class Neighbours {
 public:
  /// Lists for `spheres`, which must outlive this; `skin` in metres. Spheres before place `first` stand still and have
  /// no list of their own. `number` are the spheres' numbers where these are not their places.
  Neighbours(const Box& box, std::span<const Ball> spheres, double skin, std::size_t first = 0,
             std::vector<std::int32_t> number = {});

  /// Whether a sphere has left where it was listed: by more than half of the skin.
  bool strayed(std::size_t sphere) const {
    const Vec3d way = spheres_[sphere].centre - listed_at_[sphere - first_];
    return dot(way, way) > far2_;
  }

  /// Lists again for the centres as they are now: all of them,
  void rebuild();
  /// or, where those that have strayed are few, as most times, these; ascending. The others' centres may have moved
  /// too.
  void relist(std::span<const std::int32_t> strayed);

  std::span<const std::int32_t> of(std::size_t sphere) const {
    const Row& row = row_[sphere - first_];
    return {list_[row.block].data() + row.begin, row.size};
  }

 private:
  struct Row {
    std::uint32_t block, begin, size, room;  ///< of its list in a block's memory
  };
  struct Buffer {
    std::vector<std::uint32_t> slot;
    std::vector<std::int32_t> key;
  };
  std::int32_t key(std::int32_t sphere, std::int32_t neighbour) const;
  void find_all(std::int32_t sphere, Buffer& buffer) const;
  void find_still(std::int32_t sphere, Buffer& buffer) const;
  void find(std::int32_t sphere, const SphereBins& bins, Buffer& buffer) const;
  void list_block(std::size_t number);
  void set(std::int32_t sphere, Buffer& buffer);
  void write_sorted(std::vector<std::int32_t>& key, std::int32_t* out) const;
  void add(std::int32_t sphere, std::int32_t neighbour);
  void make_room(Row& row, std::size_t size);

  std::span<const Ball> spheres_;
  double skin_, far2_;  ///< [m], [m²]
  std::size_t first_;
  SphereGrid still_;                ///< tells whom of those that stand still a moving sphere in a cell can be near
  std::vector<SphereBins> moving_;  ///< each of spheres of about one size, where they were listed
  std::vector<std::int32_t> number_, place_;  ///< by place, by number
  std::vector<std::uint8_t> bins_of_;         ///< number in moving_ of each sphere with a list
  std::vector<Vec3d> listed_at_;
  std::vector<std::vector<std::int32_t>> list_;  ///< rows of consecutive spheres
  std::vector<Row> row_;
};

}  // namespace macadam
