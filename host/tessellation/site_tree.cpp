// SPDX-License-Identifier: GPL-3.0-or-later
// site_tree.cpp  Builds the tree by halving ranges of particle numbers at the median coordinate.
#include "host/tessellation/site_tree.hpp"

#include <algorithm>
#include <limits>

namespace macadam {
namespace {

constexpr std::size_t most_in_a_leaf = 8;
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr BoundingBox empty{{infinite, infinite, infinite}, {-infinite, -infinite, -infinite}};

BoundingBox bounds_of(const WeightedSites& sites, std::span<const std::int32_t> numbers) {
  BoundingBox out = empty;
  for (const std::int32_t i : numbers) out.grow(sites[i].centre);
  return out;
}

/// Reorders the particle numbers such that the particles with lower coordinates along the longest edge of the box come
/// before index `middle`.
void halve(const WeightedSites& sites, std::span<std::int32_t> numbers, std::size_t middle, const BoundingBox& bounds) {
  const Vec3d edge = bounds.high - bounds.low;
  const double Vec3d::*along = edge.x >= edge.y && edge.x >= edge.z ? &Vec3d::x
                               : edge.y >= edge.z                   ? &Vec3d::y
                                                                    : &Vec3d::z;
  std::nth_element(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(middle), numbers.end(),
                   [&](std::int32_t a, std::int32_t b) { return sites[a].centre.*along < sites[b].centre.*along; });
}

/// Divides a range of particle numbers into parts and appends the beginning of each part to `begin`. `first` is the
/// index of the range's first number in the whole array.
void divide(const WeightedSites& sites, std::span<std::int32_t> numbers, std::size_t parts, std::size_t first,
            std::vector<std::size_t>& begin) {
  if (parts == 1) {
    begin.push_back(first);
    return;
  }
  const std::size_t lower = parts / 2, middle = numbers.size() * lower / parts;
  halve(sites, numbers, middle, bounds_of(sites, numbers));
  divide(sites, numbers.first(middle), lower, first, begin);
  divide(sites, numbers.subspan(middle), parts - lower, first + middle, begin);
}

}  // namespace

void BoundingBox::grow(const Vec3d& p) {
  low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
  high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
}

bool BoundingBox::has(const Vec3d& p) const {
  return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y && p.z >= low.z && p.z <= high.z;
}

bool BoundingBox::meets(const BoundingBox& other) const {
  return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y && other.low.y <= high.y &&
         low.z <= other.high.z && other.low.z <= high.z;
}

double BoundingBox::distance2(const Vec3d& p) const {
  const auto beyond = [](double x, double from, double to) { return std::max({from - x, 0.0, x - to}); };
  const Vec3d way{beyond(p.x, low.x, high.x), beyond(p.y, low.y, high.y), beyond(p.z, low.z, high.z)};
  return dot(way, way);
}

SiteTree::SiteTree(const WeightedSites& sites, std::span<std::int32_t> numbers) : sites_(sites), numbers_(numbers) {
  nodes_.reserve(4 * numbers.size() / most_in_a_leaf + 1);
  divide(0, numbers.size());
}

void SiteTree::divide(std::size_t begin, std::size_t end) {
  const std::size_t own = nodes_.size();
  const std::span<std::int32_t> numbers = numbers_.subspan(begin, end - begin);
  double most_weight = -infinite;
  for (const std::int32_t i : numbers) most_weight = std::max(most_weight, sites_[i].weight);
  const BoundingBox bounds = bounds_of(sites_, numbers);
  nodes_.push_back({bounds, most_weight, begin, end, 0});
  if (numbers.size() <= most_in_a_leaf) return;
  const std::size_t half = numbers.size() / 2;
  halve(sites_, numbers, half, bounds);
  divide(begin, begin + half);
  nodes_[own].second_half = nodes_.size();
  divide(begin + half, end);
}

std::vector<std::size_t> divide_into(const WeightedSites& sites, std::span<std::int32_t> numbers, std::size_t parts) {
  std::vector<std::size_t> begin;
  divide(sites, numbers, parts, 0, begin);
  begin.push_back(numbers.size());
  return begin;
}

}  // namespace macadam
