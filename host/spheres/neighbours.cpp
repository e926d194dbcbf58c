// SPDX-License-Identifier: GPL-3.0-or-later
/// \file neighbours.cpp  Sorts spheres by size into groups of bins, searches all groups for the neighbours of each
/// sphere, and sorts each list.
#include "host/spheres/neighbours.hpp"

#include <algorithm>
#include <cassert>
#include <map>
#include <numeric>

#include "kernels/base/parallel.hpp"

namespace macadam {
namespace {

// A sort key is the sphere number plus 2^28 times the number (0, 1 or 2) of the part of the neighbour list; class
// Neighbours describes the three parts. Sphere numbers are below most_particles and fit in 28 bits.
constexpr std::int32_t part = 1 << 28;
// Largest number of size groups. The radii in a group differ by at most a factor of two.
constexpr int most_levels = 40;
// Number of consecutive spheres whose lists are in one array and are made by one thread.
constexpr std::size_t block = 64;
// Lists up to this length are sorted by counting the smaller keys for each key, which is faster.
constexpr std::size_t ranked_up_to = 64;
// All lists are made again when more than the fraction 1/few of the spheres have moved by more than half of the skin.
constexpr std::size_t few = 24;
// Smallest number of strayed spheres (spheres that have moved by more than half of the skin) with which several threads
// are faster than one.
constexpr std::size_t worth_waking = 16;
constexpr std::uint32_t spare = 2;  // free entries per list, for spheres that come near later

double largest(std::span<const Ball> spheres) {
  double r = 0;
  for (const Ball& b : spheres) r = std::max(r, b.radius);
  return r;
}

/// Divides the spheres from index `first` on into groups of similar size and sorts each group into bins. The radii in a
/// group differ by at most a factor of two.
std::vector<SphereBins> by_size(const Box& box, std::span<const Ball> spheres, std::size_t first, double skin) {
  double smallest = largest(spheres);
  for (const Ball& b : spheres.subspan(first)) smallest = std::min(smallest, b.radius);
  std::map<int, std::vector<std::int32_t>> level;
  for (std::size_t i = first; i < spheres.size(); ++i) {
    int k = 0;
    for (double r = spheres[i].radius; k < most_levels && r >= 2 * smallest; r /= 2) ++k;
    level[k].push_back(static_cast<std::int32_t>(i));
  }
  std::vector<SphereBins> bins;
  for (auto& [k, ids] : level) bins.emplace_back(box, spheres, std::move(ids), skin);
  return bins;
}

}  // namespace

Neighbours::Neighbours(const Box& box, std::span<const Ball> spheres, double skin, std::size_t first,
                       std::vector<std::int32_t> number)
    : spheres_(spheres),
      skin_(skin),
      far2_(skin * skin / 4),
      first_(first),
      still_(box, first > 0 && first < spheres.size() ? 2 * largest(spheres.subspan(first)) : norm(box.size)),
      moving_(by_size(box, spheres, first, skin)),
      number_(std::move(number)),
      place_(spheres.size()),
      bins_of_(spheres.size() - first),
      listed_at_(spheres.size() - first),
      list_((spheres.size() - first + block - 1) / block),
      row_(spheres.size() - first) {
  if (number_.empty()) {
    number_.resize(spheres.size());
    std::iota(number_.begin(), number_.end(), 0);
  }
  for (std::size_t i = 0; i < spheres.size(); ++i) place_[number_[i]] = static_cast<std::int32_t>(i);
  const double reach = largest(spheres.subspan(first)) + skin;
  for (std::size_t i = 0; i < first; ++i)
    still_.insert(static_cast<std::int32_t>(i), spheres[i].centre, spheres[i].radius + reach);
  for (std::size_t b = 0; b < moving_.size(); ++b)
    for (std::int32_t i : moving_[b].ids()) bins_of_[i - first_] = static_cast<std::uint8_t>(b);
  rebuild();
}

/// Returns the sort key of a neighbour: its part of the list, then its number.
std::int32_t Neighbours::key(std::int32_t sphere, std::int32_t neighbour) const {
  const double own = spheres_[sphere].radius, radius = spheres_[neighbour].radius;
  const std::int32_t i = number_[sphere], j = number_[neighbour];
  const bool larger = radius > own || (radius == own && j > i);
  return (larger ? part : j < i ? 0 : 2 * part) + j;
}

/// Writes the indices of the spheres with these (distinct) keys, in the order of the keys.
void Neighbours::write_sorted(std::vector<std::int32_t>& key, std::int32_t* out) const {
  const std::size_t n = key.size();
  if (n > ranked_up_to) {
    std::sort(key.begin(), key.end());
    for (std::size_t k = 0; k < n; ++k) out[k] = place_[key[k] & (part - 1)];
    return;
  }
  for (std::size_t k = 0; k < n; ++k) {
    std::int32_t rank = 0;
    for (std::size_t l = 0; l < n; ++l) rank += key[l] < key[k];
    out[rank] = place_[key[k] & (part - 1)];
  }
}

/// Adds the keys of the neighbours among the spheres that do not move.
void Neighbours::find_still(std::int32_t i, Buffer& buffer) const {
  const auto [centre, radius] = spheres_[i];
  for (const std::int32_t j : still_.near(still_.cell_of(centre))) {
    const Vec3d d = spheres_[j].centre - centre;
    const double range = radius + spheres_[j].radius + skin_;
    if (dot(d, d) < range * range) buffer.key.push_back(key(i, j));
  }
}

/// Adds the keys of the neighbours among the spheres of `bins`.
void Neighbours::find(std::int32_t i, const SphereBins& bins, Buffer& buffer) const {
  const auto [centre, radius] = spheres_[i];
  std::size_t found = 0;
  bins.near(centre, (radius + bins.largest() + skin_) * (1 + 1e-9),
            [&, centre = centre, radius = radius](std::uint32_t first, std::uint32_t last) {
              if (buffer.slot.size() < found + (last - first)) buffer.slot.resize(2 * (found + (last - first)));
              std::uint32_t* next = buffer.slot.data() + found;
              // The loop has no branch, because the processor could not predict it.
              for (std::uint32_t k = first; k < last; ++k) {
                const Ball& other = bins.ball(k);
                const Vec3d d = other.centre - centre;
                const double range = radius + other.radius + skin_;
                *next = k;
                next += dot(d, d) < range * range;
              }
              found = static_cast<std::size_t>(next - buffer.slot.data());
            });
  for (std::size_t k = 0; k < found; ++k) {
    const std::int32_t j = bins.id(buffer.slot[k]);
    if (j != i) buffer.key.push_back(key(i, j));
  }
}

/// Collects the keys of all neighbours of a sphere.
void Neighbours::find_all(std::int32_t i, Buffer& buffer) const {
  buffer.key.clear();
  if (first_ > 0) find_still(i, buffer);
  for (const SphereBins& bins : moving_) find(i, bins, buffer);
}

void Neighbours::rebuild() {
  for (SphereBins& bins : moving_) bins.sort(spheres_);
  for (std::size_t k = 0; k < listed_at_.size(); ++k) listed_at_[k] = spheres_[first_ + k].centre;
  for_each_in_parallel(
      list_.size(), [&](std::size_t b) { list_block(b); }, row_.size() >= parallel_from);
}

/// Makes the lists of one block of spheres.
void Neighbours::list_block(std::size_t number) {
  Buffer buffer;
  list_[number].clear();
  for (std::size_t k = number * block; k < std::min(row_.size(), (number + 1) * block); ++k) {
    const auto i = static_cast<std::int32_t>(first_ + k);
    row_[k] = {static_cast<std::uint32_t>(number), 0, 0, 0};
    find_all(i, buffer);
    make_room(row_[k], buffer.key.size() + spare);
    set(i, buffer);
  }
}

/// Ensures that a list has this capacity; if needed, moves it to the end of its block's memory.
void Neighbours::make_room(Row& row, std::size_t size) {
  if (row.room >= size) return;
  std::vector<std::int32_t>& list = list_[row.block];
  const std::size_t begin = list.size();
  list.resize(begin + size);
  std::copy_n(list.begin() + row.begin, row.size, list.begin() + static_cast<std::ptrdiff_t>(begin));
  row.begin = static_cast<std::uint32_t>(begin), row.room = static_cast<std::uint32_t>(size);
}

/// Replaces the list of a sphere by the neighbours in `buffer`.
void Neighbours::set(std::int32_t i, Buffer& buffer) {
  Row& row = row_[i - first_];
  row.size = 0;
  make_room(row, buffer.key.size());
  row.size = static_cast<std::uint32_t>(buffer.key.size());
  write_sorted(buffer.key, list_[row.block].data() + row.begin);
}

/// Inserts a neighbour into the list of a sphere at its sorted position, unless the list contains it already.
void Neighbours::add(std::int32_t i, std::int32_t neighbour) {
  const std::int32_t wanted = key(i, neighbour);
  Row& row = row_[i - first_];
  const std::span<const std::int32_t> now = of(static_cast<std::size_t>(i));
  const auto place = std::find_if(now.begin(), now.end(), [&](std::int32_t j) { return key(i, j) >= wanted; });
  if (place != now.end() && *place == neighbour) return;
  const auto at = place - now.begin();
  if (row.size == row.room) make_room(row, 2 * row.size + spare);
  std::int32_t* begin = list_[row.block].data() + row.begin;
  std::copy_backward(begin + at, begin + row.size, begin + row.size + 1);
  begin[at] = neighbour;
  ++row.size;
}

/// Two spheres are in each other's lists if they were near at the positions where they were last listed. A pair that
/// has since moved apart may remain in one of the two lists until all lists are made again; this does not change sums
/// over touching neighbours.
void Neighbours::relist(std::span<const std::int32_t> strayed) {
  assert(std::is_sorted(strayed.begin(), strayed.end()));
  std::size_t moved = strayed.size();
  for (const SphereBins& bins : moving_) moved += bins.moved();
  if (moved * few > row_.size()) return rebuild();
  for (std::int32_t i : strayed) {
    listed_at_[i - first_] = spheres_[i].centre;
    moving_[bins_of_[i - first_]].move(i, spheres_[i].centre);
  }
  const auto block_of = [&](std::int32_t i) { return (static_cast<std::size_t>(i) - first_) / block; };
  // `begin` holds the index, in `strayed`, of the first strayed sphere of each block, and at its end the number of
  // strayed spheres. The lists of a block are in one array, so one thread updates all of them.
  std::vector<std::size_t> begin;
  for (std::size_t k = 0; k < strayed.size(); ++k)
    if (k == 0 || block_of(strayed[k]) != block_of(strayed[k - 1])) begin.push_back(k);
  begin.push_back(strayed.size());
  for_each_in_parallel(
      begin.size() - 1,
      [&](std::size_t b) {
        Buffer buffer;
        for (std::size_t k = begin[b]; k < begin[b + 1]; ++k) {
          find_all(strayed[k], buffer);
          set(strayed[k], buffer);
        }
      },
      strayed.size() >= worth_waking);
  for (const std::int32_t i : strayed) {
    const Row& row = row_[i - first_];
    for (std::uint32_t k = 0; k < row.size; ++k) {
      // The index is read from list_ each time, because add() may reallocate the array of the block.
      const std::int32_t j = list_[row.block][row.begin + k];
      if (static_cast<std::size_t>(j) >= first_) add(j, i);
    }
  }
}

}  // namespace macadam
