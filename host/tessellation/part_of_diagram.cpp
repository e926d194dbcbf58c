// SPDX-License-Identifier: GPL-3.0-or-later
// part_of_diagram.cpp  Triangulates a part of the particles and inserts further particles until the tetrahedra at the
// part's particles equal those in the triangulation of all particles.
#include "host/tessellation/part_of_diagram.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/tessellation/dual_point.hpp"

namespace macadam {
namespace {

/// Particles within this many mean spacings around a part are inserted at the start. With a smaller margin more
/// particles are missing at first; with a larger margin more particles are inserted needlessly.
constexpr double first_margin = 2.5;

/// The dual point of a tetrahedron, and an upper bound of its power with respect to the corners. The bound allows for
/// the error of dual_point(), which is 1e-10 of the lengths, and for the rounding of the weights. A bound that is too
/// large only inserts particles that are not needed.
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

/// Returns the mean spacing of the particles' centres. The result is also correct if the particles lie in one layer or
/// one row.
double spacing_of(const SiteTree& tree) {
  const Vec3d edge = tree.bounds().high - tree.bounds().low;
  const auto n = static_cast<double>(tree.numbers().size());
  const double face = std::max({edge.x * edge.y, edge.y * edge.z, edge.z * edge.x});
  return std::max(
      {std::cbrt(edge.x * edge.y * edge.z / n), std::sqrt(face / n), std::max({edge.x, edge.y, edge.z}) / n});
}

/// The triangulation of one part.
class Part {
 public:
  Part(const WeightedSites& sites, const std::vector<SiteTree>& all, const SiteTree& own)
      : sites_(sites), all_(all), own_(sites.particles()), state_(sites.particles()) {
    for (const std::int32_t i : own.numbers()) own_[i] = true;
    const double spacing = spacing_of(own);
    searched_ = own.bounds().wider(first_margin * spacing);
    for (const SiteTree& tree : all) tree.each_reaching(searched_, [&](std::int32_t i) { take(i); });
  }

  std::vector<Tetrahedron> tetrahedra() { return with_own_particles(all_there()); }

 private:
  /// State of a particle: not used yet, marked for insertion, or inserted.
  enum class State : std::uint8_t { away, taken, inserted };

  /// Inserts particles until the triangulation contains every tetrahedron that has a particle of the part as a corner.
  /// Returns all tetrahedra of this triangulation.
  std::vector<Tetrahedron> all_there() {
    Triangulation triangulation(sites_);
    std::vector<Tetrahedron> all;
    while (!taken_.empty()) {
      const std::vector<std::int32_t> fresh = std::exchange(taken_, {});
      triangulation.insert(fresh);
      all = {};  // frees the memory first: for a large specimen the old tetrahedra take the same memory as the new ones
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
  /// Returns whether the tetrahedron is new. An insertion makes tetrahedra only at the inserted particle.
  bool is_new(const Tetrahedron& t) const {
    return std::ranges::any_of(t.site, [&](std::int32_t i) { return i >= 0 && state_[i] == State::taken; });
  }

  /// Marks one particle for insertion.
  void take(std::int32_t i) {
    if (state_[i] != State::away) return;
    state_[i] = State::taken;
    taken_.push_back(i);
  }
  /// Marks for insertion all particles whose power at the dual point is smaller than the power of the tetrahedron's
  /// corners.
  void take_in_conflict(const Tetrahedron& t) {
    const DualSphere sphere(sites_, t.site);
    // A sphere whose power at the dual point is smaller reaches into the ball of radius √power around the dual point.
    // If this ball lies inside the searched bounds, all such spheres have been taken already.
    const double reach = std::sqrt(std::max(sphere.most_power, 0.0));
    if (searched_.wider(-reach).has(sphere.centre)) return;
    for (const SiteTree& tree : all_) {
      if (std::isfinite(sphere.most_power))
        tree.each_of_power(sphere.centre, sphere.most_power, [&](std::int32_t i) { take(i); });
      else  // the centres coincide up to rounding and the dual point is not known, so all particles are taken
        for (const std::int32_t i : tree.numbers()) take(i);
    }
  }

  /// Returns the tetrahedra that have a particle of the part as a corner, with their neighbours renumbered.
  std::vector<Tetrahedron> with_own_particles(const std::vector<Tetrahedron>& all) const {
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
  BoundingBox searched_;             ///< all spheres that reach into these bounds are taken
  std::vector<bool> own_;            ///< for each particle: whether it belongs to the part
  std::vector<State> state_;         ///< for each particle
  std::vector<std::int32_t> taken_;  ///< particles that are taken but not inserted yet
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
