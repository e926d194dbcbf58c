// SPDX-License-Identifier: GPL-3.0-or-later
/// \file power_diagram.cpp  Triangulates parts of the specimen in parallel and joins their tetrahedra in an order
/// that does not depend on the division into parts.
#include "host/tessellation/power_diagram.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "host/tessellation/dual_point.hpp"
#include "host/tessellation/part_of_diagram.hpp"
#include "kernels/base/parallel.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

/// Smallest number of particles in a part. In smaller parts most particles would be triangulated by several parts.
constexpr std::size_t least_in_a_part = 2000;

std::size_t parts_for(std::size_t particles) {
  const int threads = omp_in_parallel() ? 1 : omp_get_max_threads();
  return std::clamp<std::size_t>(particles / least_in_a_part, 1, static_cast<std::size_t>(threads));
}

using Parts = std::vector<std::vector<Tetrahedron>>;

/// Joins the tetrahedra of all parts. Each tetrahedron belongs to its first particle, and each particle to one part. A
/// part numbers the tetrahedra that belong to its particles. The part has the tetrahedra on both sides of every face
/// whose first particle is one of the part's particles, and makes these two tetrahedra each other's neighbours.
class Joined {
 public:
  Joined(const WeightedSites& sites, const Parts& parts, const std::vector<std::int32_t>& part_of)
      : sites_(sites), parts_(parts), part_of_(part_of), begin_(part_of.size() + 1) {}

  PowerDiagram join() {
    each_part([&](std::size_t p) {
      for (const Tetrahedron& t : parts_[p])
        if (belongs(t.site[0], p)) ++begin_[t.site[0] + 1];
    });
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    next_ = begin_;
    out_.tetrahedra.resize(begin_.back());
    out_.dual.resize(begin_.back());
    each_part([&](std::size_t p) { put_in_order(p); });
    each_part([&](std::size_t p) { link(p); });
    return std::move(out_);
  }

 private:
  template <class F>
  void each_part(F&& f) {
    for_each_in_parallel(parts_.size(), f);
  }
  bool belongs(std::int32_t site, std::size_t part) const {
    return site >= 0 && part_of_[site] == static_cast<std::int32_t>(part);
  }
  /// Returns the tetrahedra that belong to a particle.
  std::span<Tetrahedron> of(std::int32_t particle) {
    return std::span(out_.tetrahedra).subspan(begin_[particle], begin_[particle + 1] - begin_[particle]);
  }

  /// Copies the tetrahedra that belong to a part, sorts those of each particle, and computes their dual points.
  void put_in_order(std::size_t part) {
    for (const Tetrahedron& t : parts_[part])
      if (belongs(t.site[0], part)) out_.tetrahedra[next_[t.site[0]]++] = {t.site, {-1, -1, -1, -1}};
    for (std::int32_t i = 0; i < std::ssize(part_of_); ++i) {
      if (!belongs(i, part)) continue;
      std::ranges::sort(of(i), come_before, &Tetrahedron::site);
      for (std::int64_t t = begin_[i]; t < begin_[i + 1]; ++t)
        out_.dual[t] = dual_point(sites_, out_.tetrahedra[t].site);
    }
  }

  /// Returns the index of a tetrahedron in the result. \throws RunError if the result does not contain the tetrahedron.
  /// Then two parts have different tetrahedra in the same place.
  std::int32_t number_of(const Tetrahedron& t) {
    const std::span<Tetrahedron> all = of(t.site[0]);
    const auto found = std::ranges::lower_bound(all, t.site, come_before, &Tetrahedron::site);
    if (found == all.end() || found->site != t.site) {
      throw RunError(
          fmt::format("tessellation: two parts of the box disagree on the tetrahedron of particles {}, {}, {}, {}",
                      t.site[0], t.site[1], t.site[2], t.site[3]));
    }
    return static_cast<std::int32_t>(begin_[t.site[0]] + (found - all.begin()));
  }

  /// Sets the neighbours across the faces whose first particle belongs to the part.
  void link(std::size_t part) {
    const std::vector<Tetrahedron>& all = parts_[part];
    std::vector<std::int32_t> number;
    number.reserve(all.size());
    for (const Tetrahedron& t : all) number.push_back(t.site[0] >= 0 ? number_of(t) : -1);
    for (std::size_t t = 0; t < all.size(); ++t) {
      for (int k = 0; k < 4; ++k) {
        if (!belongs(all[t].site[k == 0 ? 1 : 0], part) || all[t].neighbour[k] < 0) continue;
        out_.tetrahedra[number[t]].neighbour[k] = number[all[t].neighbour[k]];
      }
    }
  }

  const WeightedSites& sites_;
  const Parts& parts_;
  const std::vector<std::int32_t>& part_of_;  ///< part of each particle
  /// For each particle: beginning of the range of tetrahedra that belong to the particle, and next free index in the
  /// range.
  std::vector<std::int64_t> begin_, next_;
  PowerDiagram out_;
};

}  // namespace

PowerDiagram power_diagram(const Specimen& specimen, const std::vector<std::uint8_t>& active, std::size_t parts) {
  const WeightedSites sites(specimen);
  std::vector<std::int32_t> numbers;
  numbers.reserve(specimen.size());
  for (std::size_t i = 0; i < specimen.size(); ++i)
    if (active[i]) numbers.push_back(static_cast<std::int32_t>(i));
  if (parts == 0) parts = parts_for(numbers.size());
  parts = std::min(parts, std::max<std::size_t>(1, numbers.size()));
  std::vector<std::int32_t> part_of(specimen.size(), 0);
  Parts found(parts);
  if (parts == 1) {
    found[0] = all_tetrahedra(sites, numbers);
  } else {
    const std::vector<std::size_t> begin = divide_into(sites, numbers, parts);
    std::vector<std::optional<SiteTree>> made(parts);
    for_each_in_parallel(parts, [&](std::size_t p) {
      const auto own = std::span(numbers).subspan(begin[p], begin[p + 1] - begin[p]);
      made[p].emplace(sites, own);
      for (const std::int32_t i : own) part_of[i] = static_cast<std::int32_t>(p);
    });
    std::vector<SiteTree> trees;
    for (auto& tree : made) trees.push_back(std::move(*tree));
    for_each_in_parallel(parts, [&](std::size_t p) { found[p] = tetrahedra_at(sites, trees, trees[p]); });
  }
  return Joined(sites, found, part_of).join();
}

}  // namespace macadam
