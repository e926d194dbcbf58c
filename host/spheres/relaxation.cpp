// SPDX-License-Identifier: GPL-3.0-or-later
/// \file relaxation.cpp  Minimises a harmonic overlap energy with the FIRE method (Bitzek et al. 2006).
#include "host/spheres/relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "host/spheres/neighbours.hpp"
#include "host/spheres/parallel_blocks.hpp"

namespace macadam {
namespace {

// Lengths are in metres. The stiffness k of a mastic pair and the mass m of a mastic sphere are 1, so the unit of time
// is √(m/k) of one pair. About twelve pairs act on a sphere, so an explicit step is stable up to about 2/√(2·12) = 0.4
// of this unit.
constexpr double first_step = 0.1, longest_step = 0.3;
constexpr double longest_move = 0.1;  // largest movement of a sphere per iteration, in mean mastic radii
// Skin of the neighbour lists in mean mastic radii. With a smaller skin the lists are made too often; with a larger
// skin they are too long.
constexpr double skin_share = 1.15;
// Stiffness of a contact between two aggregates, or between an aggregate and a wall, divided by the stiffness of a
// mastic contact. The contact is stiffer, so that aggregates overlap less than mastic.
constexpr double aggregate_stiffness = 20;
constexpr int most_iterations = 3000, stall_window = 50;
// The energy has stalled if it falls by less than this fraction in stall_window iterations.
constexpr double stalled = 5e-4;

/// The three sums over all spheres that the FIRE method needs, weighted by mass: a·v, v·v and a·a.
struct Dots {
  double power = 0, v2 = 0, a2 = 0;
};

/// Returns the order in which the relaxation keeps the spheres: aggregates before mastic, and moving spheres sorted by
/// position, so that neighbours are near each other in memory. Spheres with a number below `first` do not move and keep
/// their places.
std::vector<std::int32_t> by_place(const Specimen& s, std::size_t first, std::size_t first_mastic) {
  const std::vector<Ball> balls = balls_of(s);
  std::vector<std::int32_t> order(first);
  std::iota(order.begin(), order.end(), 0);
  for (const auto& [from, to] : {std::pair{first, first_mastic}, std::pair{first_mastic, s.size()}}) {
    if (from == to) continue;
    std::vector<std::int32_t> ids(to - from);
    std::iota(ids.begin(), ids.end(), static_cast<std::int32_t>(from));
    const SphereBins bins(s.box, balls, std::move(ids), 0);
    order.insert(order.end(), bins.in_order().begin(), bins.in_order().end());
  }
  return order;
}

/// One relaxation. It works on a copy of the spheres in the order of by_place(). Arrays are in this order unless stated
/// otherwise; "number" is the index in the specimen, "place" the index in this order.
class Relaxation {
 public:
  Relaxation(Specimen& specimen, bool fix_aggregates, const Enclosure& wall)
      : s_(specimen),
        domain_(specimen.box),
        wall_(wall),
        first_mastic_(std::find(s_.phase.begin(), s_.phase.end(), Phase::mastic) - s_.phase.begin()),
        first_(fix_aggregates ? first_mastic_ : 0),
        unit_(mean_radius()),
        number_(by_place(s_, first_, first_mastic_)),
        ball_(sorted(s_, number_)),
        neighbours_(s_.box, ball_, skin_share * unit_, first_, number_),
        velocity_(s_.size()),
        acceleration_(s_.size()),
        energy_(s_.size()),
        dots_(s_.size()),
        by_number_(s_.size() - first_),
        place_(s_.size() - first_) {
    for (std::size_t i = first_; i < s_.size(); ++i) place_[number_[i] - first_] = static_cast<std::int32_t>(i);
  }

  /// Relaxes and writes the new centres into the specimen. Returns the number of iterations.
  int relax(const std::function<void(double)>& progress) {
    const int iterations = run(progress);
    for (std::size_t i = first_; i < ball_.size(); ++i) s_.centre[number_[i]] = ball_[i].centre;
    return iterations;
  }

 private:
  /// Runs the FIRE iterations. The energy is computed every `stall_window` iterations.
  int run(const std::function<void(double)>& progress) {
    double dt = first_step, mixing = 0.1, last_energy = 0;
    int downhill = 0;
    for (int k = 0; k < most_iterations; ++k) {
      const bool look = k % stall_window == 0;
      compute_accelerations(look);
      if (look) {
        const double energy = total_energy();
        if (energy == 0 || (k > 0 && last_energy - energy < stalled * energy)) return k;
        last_energy = energy;
        progress(static_cast<double>(k) / most_iterations);
      }
      const Dots dots = dot_products();
      if (dots.power > 0) {
        if (++downhill > 5) dt = std::min(1.1 * dt, longest_step), mixing *= 0.99;
      } else {
        downhill = 0, dt = std::max(0.5 * dt, 0.1 * first_step), mixing = 0.1;
        std::fill(velocity_.begin(), velocity_.end(), Vec3d{});
      }
      move(dt, mixing, dots.a2 > 0 ? std::sqrt(dots.v2 / dots.a2) : 0);
    }
    return most_iterations;
  }

  static std::vector<Ball> sorted(const Specimen& s, const std::vector<std::int32_t>& number) {
    std::vector<Ball> balls;
    balls.reserve(number.size());
    for (const std::int32_t i : number) balls.push_back({s.centre[i], s.radius[i]});
    return balls;
  }

  /// Returns the mean radius of the mastic spheres or, in a specimen without mastic, of the aggregate spheres.
  double mean_radius() const {
    const std::size_t from = first_mastic_ < s_.size() ? first_mastic_ : 0;
    double sum = 0;
    for (std::size_t i = from; i < s_.size(); ++i) sum += s_.radius[i];
    return sum / static_cast<double>(s_.size() - from);
  }

  bool is_aggregate(std::size_t i) const { return i < first_mastic_; }
  std::size_t moving() const { return s_.size() - first_; }
  bool on_threads() const { return s_.size() >= parallel_from; }

  /// Returns the mass of a sphere. Aggregates are heavier in proportion to their volume and to their stiffness, so that
  /// the time step of the mastic is stable for them too.
  double mass(std::size_t i) const {
    const double ratio = ball_[i].radius / unit_;
    return is_aggregate(i) ? aggregate_stiffness * std::max(1.0, ratio * ratio * ratio) : 1;
  }

  void compute_accelerations(bool with_energy) {
    const auto one = [&](std::size_t k) { accelerate(first_ + k, with_energy); };
    if (first_ < first_mastic_) {  // aggregates have many more neighbours: equal ranges would take unequal time
      for_each_in_blocks(moving(), on_threads(), one);
    } else {
      for_each_range(moving(), on_threads(), [&](std::size_t, std::size_t from, std::size_t to) {
        for (std::size_t k = from; k < to; ++k) one(k);
      });
    }
  }

  /// Computes the acceleration of a sphere, its terms of the sums in `Dots` and, on request, its energy.
  void accelerate(std::size_t i, bool with_energy) {  // may throw: it calls the wall's depth function
    const auto [c, r] = ball_[i];
    const double k_wall = is_aggregate(i) ? aggregate_stiffness : 1;
    Vec3d force{};
    double energy = 0;
    const std::span<const std::int32_t> near = neighbours_.of(i);
    for (std::size_t from = 0; from < near.size(); from += most_at_once)
      push(i, near.subspan(from, std::min(most_at_once, near.size() - from)), force, with_energy ? &energy : nullptr);
    const domains::Overlap beyond = domain_.overlap(c, r);
    force += k_wall * beyond.push;
    for (const double square : {beyond.squares.x, beyond.squares.y, beyond.squares.z}) energy += 0.5 * k_wall * square;
    if (wall_.depth) {
      const auto [depth, inward] = wall_.depth(c, r);
      if (const double overlap = r - depth; overlap > 0) {
        force += (wall_.stiffness * overlap) * inward;
        energy += 0.5 * wall_.stiffness * overlap * overlap;
      }
    }
    const double m = mass(i);
    const Vec3d a = (1 / m) * force, v = velocity_[i];
    acceleration_[i] = a;
    if (with_energy) energy_[i] = energy;
    dots_[i] = {m * dot(a, v), m * dot(v, v), m * dot(a, a)};
  }

  /// Adds the forces that up to `most_at_once` neighbours exert on sphere i, in the order of the list. Separate loops
  /// allow the square roots and divisions of several pairs to overlap in the processor.
  void push(std::size_t i, std::span<const std::int32_t> near, Vec3d& force, double* energy) const {
    double x[most_at_once], y[most_at_once], z[most_at_once];
    double distance[most_at_once], reach[most_at_once], stiffness[most_at_once], push[most_at_once];
    std::int32_t number[most_at_once];
    const auto [c, r] = ball_[i];
    // Pairs with spheres below this index have the stiffness of aggregates.
    const auto stiff = static_cast<std::int32_t>(is_aggregate(i) ? first_mastic_ : 0);
    std::size_t n = 0;
    // The loop has no branch, because the processor could not predict it.
    for (const std::int32_t j : near) {
      const Vec3d d = c - ball_[j].centre;
      const double d2 = dot(d, d), touch = r + ball_[j].radius;
      number[n] = j;
      n += static_cast<std::size_t>(d2 < touch * touch) & static_cast<std::size_t>(d2 > 0);
    }
    for (std::size_t k = 0; k < n; ++k) {
      const std::int32_t j = number[k];
      const Vec3d d = c - ball_[j].centre;
      x[k] = d.x, y[k] = d.y, z[k] = d.z, distance[k] = dot(d, d), reach[k] = r + ball_[j].radius;
      stiffness[k] = j < stiff ? aggregate_stiffness : 1;
    }
    for (std::size_t k = 0; k < n; ++k) distance[k] = std::sqrt(distance[k]);
    for (std::size_t k = 0; k < n; ++k) push[k] = stiffness[k] * (reach[k] - distance[k]) / distance[k];
    for (std::size_t k = 0; k < n; ++k) force += push[k] * Vec3d{x[k], y[k], z[k]};
    if (!energy) return;
    for (std::size_t k = 0; k < n; ++k) {
      const double overlap = reach[k] - distance[k];
      // A pair of two moving spheres is visited from both sides, so each side adds half of its energy.
      *energy += (static_cast<std::size_t>(number[k]) >= first_ ? 0.25 : 0.5) * stiffness[k] * overlap * overlap;
    }
  }

  // One thread adds the terms in the order of the spheres' numbers, so that the sums have the same bits for any number
  // of threads. accelerate() stores the terms by place, because several threads would write to the same cache line if
  // the terms were stored by number.
  double total_energy() const {
    double sum = 0;
    for (const std::int32_t i : place_) sum += energy_[i];
    return sum;
  }

  // All threads first copy the terms into the order of numbers. A single thread would otherwise fetch nearly every
  // cache line from another core.
  Dots dot_products() {
    for_each_range(moving(), on_threads(), [&](std::size_t, std::size_t from, std::size_t to) {
      for (std::size_t k = from; k < to; ++k) by_number_[k] = dots_[place_[k]];
    });
    Dots sum;
    for (const Dots& d : by_number_) sum.power += d.power, sum.v2 += d.v2, sum.a2 += d.a2;
    return sum;
  }

  /// Moves all spheres by one step and updates the neighbour lists of spheres that moved too far.
  void move(double dt, double mixing, double v_per_a) {
    strayed_.resize(number_of_ranges(on_threads()));
    for_each_range(moving(), on_threads(), [&](std::size_t number, std::size_t from, std::size_t to) {
      std::vector<std::int32_t>& strayed = strayed_[number];
      strayed.clear();
      for (std::size_t i = first_ + from; i < first_ + to; ++i) {
        move_sphere(i, dt, mixing, v_per_a);
        if (neighbours_.strayed(i)) strayed.push_back(static_cast<std::int32_t>(i));
      }
    });
    std::vector<std::int32_t> all;
    for (const auto& some : strayed_) all.insert(all.end(), some.begin(), some.end());
    if (!all.empty()) neighbours_.relist(all);
  }

  void move_sphere(std::size_t i, double dt, double mixing, double v_per_a) {
    const double most = longest_move * unit_ / dt;
    Vec3d v = (1 - mixing) * velocity_[i] + (dt + mixing * v_per_a) * acceleration_[i];
    const double speed = norm(v);
    if (speed > most) v = (most / speed) * v;
    velocity_[i] = v;
    const Vec3d p = ball_[i].centre + dt * v;
    // No centre may reach a wall, because a sphere outside the domain has no cell.
    ball_[i].centre = domain_.pulled_inside(p);
  }

  static constexpr std::size_t most_at_once = 64;  // pairs that push() handles in one call

  Specimen& s_;
  Domain domain_;
  const Enclosure& wall_;
  std::size_t first_mastic_, first_;  ///< index of the first mastic sphere, and of the first sphere that moves
  double unit_;                       ///< mean radius of the mastic [m]
  std::vector<std::int32_t> number_;  ///< number of the sphere at each place
  std::vector<Ball> ball_;
  Neighbours neighbours_;
  std::vector<Vec3d> velocity_, acceleration_;
  std::vector<double> energy_;
  std::vector<Dots> dots_;           ///< each sphere's terms of the sums, with its velocity before the move
  std::vector<Dots> by_number_;      ///< dots_ of the moving spheres, in the order of numbers
  std::vector<std::int32_t> place_;  ///< places of the moving spheres, in the order of numbers
  std::vector<std::vector<std::int32_t>> strayed_;  ///< indices of spheres that moved too far, per range, ascending
};

}  // namespace

int relax(Specimen& specimen, bool fix_aggregates, const std::function<void(double share)>& progress,
          const Enclosure& wall) {
  const int iterations = Relaxation(specimen, fix_aggregates, wall).relax(progress);
  progress(1);
  return iterations;
}

double largest_aggregate_overlap(const Specimen& specimen) {
  Specimen aggregates{specimen.box, {}, {}, {}, {}};
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    if (specimen.phase[i] != Phase::aggregate) continue;
    aggregates.centre.push_back(specimen.centre[i]);
    aggregates.radius.push_back(specimen.radius[i]);
  }
  const std::vector<Ball> balls = balls_of(aggregates);
  const Neighbours neighbours(aggregates.box, balls, 0);
  double largest = 0;
  for (std::size_t i = 0; i < aggregates.size(); ++i)
    for (std::int32_t j : neighbours.of(i))
      largest = std::max(
          largest, aggregates.radius[i] + aggregates.radius[j] - norm(aggregates.centre[i] - aggregates.centre[j]));
  return largest;
}

}  // namespace macadam
