// SPDX-License-Identifier: GPL-3.0-or-later
/// \file relaxation.cpp  FIRE minimisation (Bitzek et al. 2006) of a harmonic overlap energy.
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

// Lengths are in metres; stiffness of a mastic pair and mass of a mastic sphere are 1, so time is in units of one
// pair's √(m/k). About twelve pairs act on a sphere: the explicit limit is near 2/√(2·12) = 0.4 of that unit.
constexpr double first_step = 0.1, longest_step = 0.3;
constexpr double longest_move = 0.1;        // of the mean mastic radius, in one iteration
constexpr double skin_share = 1.15;         // of the mean mastic radius; less: lists are made too often, more: too long
constexpr double aggregate_stiffness = 20;  // free aggregates: they must not give way to each other as mastic does
constexpr int most_iterations = 3000, stall_window = 50;
constexpr double stalled = 5e-4;  // relative fall of the energy in one window

/// Terms of the sums over all spheres.
struct Dots {
  double power = 0, v2 = 0, a2 = 0;
};

/// The moving spheres so that near ones stand near each other, aggregates before mastic: then loops find their data in
/// the cache. Those before number `first` keep their places.
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

/// Works on a copy of the spheres in another order, which arrays have where nothing else is said of them.
class Relaxation {
 public:
  Relaxation(Specimen& specimen, bool fix_aggregates, const Enclosure& wall)
      : s_(specimen),
        box_(specimen.box.size),
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

  /// Moves the specimen's spheres.
  int relax(const std::function<void(double)>& progress) {
    const int iterations = run(progress);
    for (std::size_t i = first_; i < ball_.size(); ++i) s_.centre[number_[i]] = ball_[i].centre;
    return iterations;
  }

 private:
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

  double mean_radius() const {
    const std::size_t from = first_mastic_ < s_.size() ? first_mastic_ : 0;
    double sum = 0;
    for (std::size_t i = from; i < s_.size(); ++i) sum += s_.radius[i];
    return sum / static_cast<double>(s_.size() - from);
  }

  bool is_aggregate(std::size_t i) const { return i < first_mastic_; }
  std::size_t moving() const { return s_.size() - first_; }
  bool on_threads() const { return s_.size() >= parallel_from; }

  /// Aggregates are heavier by volume, and by stiffness too, so that they allow the mastic's time step.
  double mass(std::size_t i) const {
    const double ratio = ball_[i].radius / unit_;
    return is_aggregate(i) ? aggregate_stiffness * std::max(1.0, ratio * ratio * ratio) : 1;
  }

  void compute_accelerations(bool with_energy) {
    const auto one = [&](std::size_t k) { accelerate(first_ + k, with_energy); };
    if (first_ < first_mastic_) {  // aggregates come first, and have many more neighbours than mastic has
      for_each_in_blocks(moving(), on_threads(), one);
    } else {
      for_each_range(moving(), on_threads(), [&](std::size_t, std::size_t from, std::size_t to) {
        for (std::size_t k = from; k < to; ++k) one(k);
      });
    }
  }

  void accelerate(std::size_t i, bool with_energy) {  // a wall may throw
    const auto [c, r] = ball_[i];
    const double k_wall = is_aggregate(i) ? aggregate_stiffness : 1;
    Vec3d force{};
    double energy = 0;
    const std::span<const std::int32_t> near = neighbours_.of(i);
    for (std::size_t from = 0; from < near.size(); from += most_at_once)
      push(i, near.subspan(from, std::min(most_at_once, near.size() - from)), force, with_energy ? &energy : nullptr);
    const auto side = [&energy, r = r, k_wall](double& component, double position, double length) {
      const double low = std::max(0.0, r - position), high = std::max(0.0, r - (length - position));
      component += k_wall * (low - high);
      energy += 0.5 * k_wall * (low * low + high * high);
    };
    side(force.x, c.x, box_.x), side(force.y, c.y, box_.y), side(force.z, c.z, box_.z);
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

  /// Adds what the spheres of a part of a row do to sphere i, in the order of the row. Loops are kept apart so that
  /// roots and quotients of several pairs are on their way at a time.
  void push(std::size_t i, std::span<const std::int32_t> near, Vec3d& force, double* energy) const {
    double x[most_at_once], y[most_at_once], z[most_at_once];
    double distance[most_at_once], reach[most_at_once], stiffness[most_at_once], push[most_at_once];
    std::int32_t number[most_at_once];
    const auto [c, r] = ball_[i];
    const auto stiff = static_cast<std::int32_t>(is_aggregate(i) ? first_mastic_ : 0);  // with those before
    std::size_t n = 0;
    for (const std::int32_t j : near) {  // without a branch: nobody could foresee it
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
      // A pair of two moving spheres is met from both sides.
      *energy += (static_cast<std::size_t>(number[k]) >= first_ ? 0.25 : 0.5) * stiffness[k] * overlap * overlap;
    }
  }

  // The sums run over the particles in the order of their numbers, on one thread: the same bits for any number of
  // threads. Each thread has written its terms by place: of neighbouring numbers, several threads would write to one
  // line of the cache.
  double total_energy() const {
    double sum = 0;
    for (const std::int32_t i : place_) sum += energy_[i];
    return sum;
  }

  // All threads first copy the terms into the order of numbers: one alone would fetch nearly every line from the cache
  // of another core.
  Dots dot_products() {
    for_each_range(moving(), on_threads(), [&](std::size_t, std::size_t from, std::size_t to) {
      for (std::size_t k = from; k < to; ++k) by_number_[k] = dots_[place_[k]];
    });
    Dots sum;
    for (const Dots& d : by_number_) sum.power += d.power, sum.v2 += d.v2, sum.a2 += d.a2;
    return sum;
  }

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
    // No centre may reach a wall: beyond it there is no cell.
    const auto inside = [&](double x, double length) { return std::clamp(x, 1e-3 * length, 0.999 * length); };
    ball_[i].centre = {inside(p.x, box_.x), inside(p.y, box_.y), inside(p.z, box_.z)};
  }

  static constexpr std::size_t most_at_once = 64;  // pairs

  Specimen& s_;
  Vec3d box_;  ///< edges [m]
  const Enclosure& wall_;
  std::size_t first_mastic_, first_;  ///< first mastic sphere, first sphere that moves
  double unit_;                       ///< mean radius of the mastic [m]
  std::vector<std::int32_t> number_;  ///< in the specimen
  std::vector<Ball> ball_;
  Neighbours neighbours_;
  std::vector<Vec3d> velocity_, acceleration_;
  std::vector<double> energy_;
  std::vector<Dots> dots_;                          ///< with the velocity before the move
  std::vector<Dots> by_number_;                     ///< the same of the moving spheres, by number
  std::vector<std::int32_t> place_;                 ///< of the moving spheres, by number
  std::vector<std::vector<std::int32_t>> strayed_;  ///< [range], ascending: by place
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
