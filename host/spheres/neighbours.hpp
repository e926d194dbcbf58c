// SPDX-License-Identifier: GPL-3.0-or-later
/// \file neighbours.hpp  Makes full neighbour lists of spheres with any distribution of sizes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/spheres/sphere_bins.hpp"
#include "host/spheres/sphere_grid.hpp"
#include "macadam/specimen.hpp"

namespace macadam {

/// Loops over fewer spheres than this run on one thread.
inline constexpr std::size_t parallel_from = 1000;

/// Neighbour lists. The list of a sphere contains at least all spheres whose surfaces are closer than `skin` to its
/// surface. The order of a list depends on radii and sphere numbers only. The list has three parts, each sorted by
/// number: smaller spheres with a lower number than the sphere itself, larger spheres, and smaller spheres with a
/// higher number. If two spheres are equal, the one with the higher number counts as the larger. Spheres that do not
/// touch add nothing to a sum over the list. Such sums therefore have the same bits for any number of threads and any
/// skin.
class Neighbours {
 public:
  /// Makes the lists of `spheres`, which must outlive this object; `skin` is in metres. Spheres with an index below
  /// `first` do not move and have no list. `number` gives the number of each sphere if numbers differ from indices.
  Neighbours(const Box& box, std::span<const Ball> spheres, double skin, std::size_t first = 0,
             std::vector<std::int32_t> number = {});

  /// Returns whether a sphere has moved by more than half of the skin since it was listed.
  bool strayed(std::size_t sphere) const {
    const Vec3d way = spheres_[sphere].centre - listed_at_[sphere - first_];
    return dot(way, way) > far2_;
  }

  /// Makes all lists for the present centres.
  void rebuild();
  /// Updates the lists after some spheres have moved by more than half of the skin; `strayed` has their indices in
  /// ascending order. If many spheres have strayed, makes all lists again. Other spheres may have moved too, but by
  /// less than half of the skin.
  void relist(std::span<const std::int32_t> strayed);

  /// Returns the indices of the neighbours of a sphere.
  std::span<const std::int32_t> of(std::size_t sphere) const {
    const Row& row = row_[sphere - first_];
    return {list_[row.block].data() + row.begin, row.size};
  }

 private:
  /// Location of the list of neighbours of one sphere: a range of list_[block], the array that holds the lists of a
  /// block of consecutive spheres.
  struct Row {
    std::uint32_t block, begin, size, room;  ///< `room` is the capacity
  };
  /// Temporary memory for finding the neighbours of a sphere.
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
  /// Spheres that do not move. Each cell lists those that may be neighbours of a moving sphere in the cell.
  SphereGrid still_;
  std::vector<SphereBins> moving_;  ///< moving spheres, in groups of similar size, at their listed positions
  /// Number of the sphere at each index, and index of the sphere with each number.
  std::vector<std::int32_t> number_, place_;
  std::vector<std::uint8_t> bins_of_;  ///< for each sphere with a list: its group in moving_
  /// Centre of each sphere when it was listed last.
  std::vector<Vec3d> listed_at_;
  /// Memory of the lists; each entry belongs to a block of consecutive spheres.
  std::vector<std::vector<std::int32_t>> list_;
  std::vector<Row> row_;
};

}  // namespace macadam
