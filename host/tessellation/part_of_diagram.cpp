// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/tessellation/part_of_diagram.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/tessellation/dual_point.hpp"

namespace macadam {
namespace {

/// Of spacings: how far around a part particles are taken at first. Less, and more is missing; more costs more.
constexpr double first_margin = 2.5;

/// A dual point, and a bound of its power to the corners. dual_point() is good to 1e-10 of the lengths, and powers to
/// rounding of the weights; who is taken without need does no harm.
struct DualSphere {
  Vec3d centre;
  double most_power;

  DualSphere(const WeightedSites& sites, const SiteNumbers& number) : centre(dual_point(sites, number)) {
    const WeightedSite first = sites[number[0]];
    const auto length2 = [&](const Vec3d& p) { return dot(p - first.centre, p - first.centre); };
    double longest = length2(centre), heaviest = first.weight;
    for (int k = 1; k < 4; ++k) {
      const WeightedSite site = sites[number[k]];
      longest = std::max(longest, length2(site.centre)), heaviest = std::max(heaviest, site.weight);
    }
    most_power = first.power(centre) + 1e-8 * longest + 1e-14 * heaviest;
  }
};

/// Of the particles' centres: in a layer or a row of them as in a heap.
double spacing_of(const SiteTree& tree) {
  const Vec3d edge = tree.bounds().high - tree.bounds().low;
  const auto n = static_cast<double>(tree.numbers().size());
  const double face = std::max({edge.x * edge.y, edge.y * edge.z, edge.z * edge.x});
  return std::max(
      {std::cbrt(edge.x * edge.y * edge.z / n), std::sqrt(face / n), std::max({edge.x, edge.y, edge.z}) / n});
}

class Part {
 public:
  Part(const WeightedSites& sites, const std::vector<SiteTree>& all, const SiteTree& own)
      : sites_(sites), all_(all), own_(sites.particles()), state_(sites.particles()) {
    for (const std::int32_t i : own.numbers()) own_[i] = true;
    const double spacing = spacing_of(own);
    searched_ = own.bounds().wider(first_margin * spacing);
    for (const SiteTree& tree : all) tree.each_reaching(searched_, [&](std::int32_t i) { take(i); });
  }

  std::vector<Tetrahedron> tetrahedra() { return own_of(all_there()); }

 private:
  enum class State : std::uint8_t { away, taken, inserted };

  /// Of a triangulation that has all tetrahedra at own particles.
  std::vector<Tetrahedron> all_there() {
    Triangulation triangulation(sites_);
    std::vector<Tetrahedron> all;
    while (!taken_.empty()) {
      const std::vector<std::int32_t> fresh = std::exchange(taken_, {});
      triangulation.insert(fresh);
      all = {};  // of a large specimen as much memory as the new ones
      all = triangulation.tetrahedra();
      for (const Tetrahedron& t : all)
        if (is_own(t) && is_new(t)) take_in_conflict(t);
      for (const std::int32_t i : fresh) state_[i] = State::inserted;
    }
    return all;
  }

  bool is_own(const Tetrahedron& t) const {
    return std::ranges::any_of(t.site, [&](std::int32_t i) { return i >= 0 && own_[i]; });
  }
  /// An insertion makes tetrahedra at the particle that is inserted, no others.
  bool is_new(const Tetrahedron& t) const {
    return std::ranges::any_of(t.site, [&](std::int32_t i) { return i >= 0 && state_[i] == State::taken; });
  }

  void take(std::int32_t i) {
    if (state_[i] != State::away) return;
    state_[i] = State::taken;
    taken_.push_back(i);
  }
  void take_in_conflict(const Tetrahedron& t) {
    const DualSphere sphere(sites_, t.site);
    // Spheres with a smaller power reach to within √power of the dual point: if that is far enough inside, they are
    // there
    const double reach = std::sqrt(std::max(sphere.most_power, 0.0));
    if (searched_.wider(-reach).has(sphere.centre)) return;
    for (const SiteTree& tree : all_) {
      if (std::isfinite(sphere.most_power))
        tree.each_of_power(sphere.centre, sphere.most_power, [&](std::int32_t i) { take(i); });
      else  // of centres that coincide but for rounding: which it is can only be told by all
        for (const std::int32_t i : tree.numbers()) take(i);
    }
  }

  std::vector<Tetrahedron> own_of(const std::vector<Tetrahedron>& all) const {
    std::vector<std::int32_t> number(all.size(), -1);
    std::int32_t count = 0;
    for (std::size_t t = 0; t < all.size(); ++t)
      if (is_own(all[t])) number[t] = count++;
    std::vector<Tetrahedron> out;
    out.reserve(static_cast<std::size_t>(count));
    for (std::size_t t = 0; t < all.size(); ++t) {
      if (number[t] < 0) continue;
      Tetrahedron& own = out.emplace_back(all[t]);
      for (std::int32_t& neighbour : own.neighbour)
        if (neighbour >= 0) neighbour = number[neighbour];
    }
    return out;
  }

  const WeightedSites& sites_;
  const std::vector<SiteTree>& all_;
  Bounds searched_;                  ///< all spheres that reach into it are taken
  std::vector<bool> own_;            ///< by particle
  std::vector<State> state_;         ///< by particle
  std::vector<std::int32_t> taken_;  ///< and not inserted yet
};

}  // namespace

std::vector<Tetrahedron> tetrahedra_at(const WeightedSites& sites, const std::vector<SiteTree>& all,
                                       const SiteTree& own) {
  return Part(sites, all, own).tetrahedra();
}

std::vector<Tetrahedron> all_tetrahedra(const WeightedSites& sites, const std::vector<std::int32_t>& particles) {
  Triangulation triangulation(sites);
  triangulation.insert(particles);
  return triangulation.tetrahedra();
}

}  // namespace macadam
