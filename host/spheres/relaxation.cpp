// SPDX-License-Identifier: GPL-3.0-or-later
/// \file relaxation.cpp  FIRE minimisation (Bitzek et al. 2006) of a harmonic overlap energy.
#include "host/spheres/relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "host/spheres/neighbours.hpp"
#include "host/spheres/parallel_blocks.hpp"

namespace macadam {
namespace {

// Lengths are in metres; stiffness of a mastic pair and mass of a mastic sphere are 1, so time is in units of one
// pair's √(m/k). About twelve pairs act on a sphere: the explicit limit is near 2/√(2·12) = 0.4 of that unit.
constexpr double first_step = 0.1, longest_step = 0.3;
constexpr double longest_move = 0.1;        // of the mean mastic radius, in one iteration
constexpr double skin_share = 0.5;          // of the mean mastic radius
constexpr double aggregate_stiffness = 20;  // free aggregates: they must not give way to each other as mastic does
constexpr double wall_stiffness = 10;       // of a wall other than the box: what it holds may press hard against it
constexpr int most_iterations = 3000, stall_window = 50;
constexpr double stalled = 5e-4;  // relative fall of the energy in one window

struct Dots {
  double power = 0, v2 = 0, a2 = 0;
};

class Relaxation {
 public:
  Relaxation(Specimen& specimen, bool fix_aggregates, const Wall& wall)
      : s_(specimen),
        wall_(wall),
        first_mastic_(std::find(s_.phase.begin(), s_.phase.end(), Phase::mastic) - s_.phase.begin()),
        first_(fix_aggregates ? first_mastic_ : 0),
        unit_(mean_radius()),
        neighbours_(s_, 2 * unit_, skin_share * unit_),
        listed_at_(s_.centre),
        velocity_(s_.size()),
        acceleration_(s_.size()),
        energy_(s_.size()) {}

  int run(const std::function<void(double)>& progress) {
    double dt = first_step, mixing = 0.1, last_energy = 0;
    int downhill = 0;
    for (int k = 0; k < most_iterations; ++k) {
      compute_accelerations();
      if (k % stall_window == 0) {
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

 private:
  double mean_radius() const {
    const std::size_t from = first_mastic_ < s_.size() ? first_mastic_ : 0;
    double sum = 0;
    for (std::size_t i = from; i < s_.size(); ++i) sum += s_.radius[i];
    return sum / static_cast<double>(s_.size() - from);
  }

  bool is_aggregate(std::size_t i) const { return i < first_mastic_; }

  /// Aggregates are heavier by volume, and by stiffness too, so that they allow the mastic's time step.
  double mass(std::size_t i) const {
    const double ratio = s_.radius[i] / unit_;
    return is_aggregate(i) ? aggregate_stiffness * std::max(1.0, ratio * ratio * ratio) : 1;
  }

  void compute_accelerations() {
    for_each_in_blocks(s_.size() - first_, s_.size() >= parallel_from, [&](std::size_t k) {  // a wall may throw
      const std::size_t i = first_ + k;
      const Vec3d c = s_.centre[i];
      const double r = s_.radius[i], k_wall = is_aggregate(i) ? aggregate_stiffness : 1;
      Vec3d force{};
      double energy = 0;
      for (std::int32_t j : neighbours_.of(i)) {
        const Vec3d d = c - s_.centre[j];
        const double touch = r + s_.radius[j], d2 = dot(d, d);
        if (d2 >= touch * touch || d2 == 0) continue;
        const double distance = std::sqrt(d2), overlap = touch - distance;
        const double stiffness = is_aggregate(i) && is_aggregate(j) ? aggregate_stiffness : 1;
        force += (stiffness * overlap / distance) * d;
        // A pair of two moving spheres is met from both sides.
        energy += (static_cast<std::size_t>(j) >= first_ ? 0.25 : 0.5) * stiffness * overlap * overlap;
      }
      const auto side = [&](double& component, double position, double length) {
        const double low = std::max(0.0, r - position), high = std::max(0.0, r - (length - position));
        component += k_wall * (low - high);
        energy += 0.5 * k_wall * (low * low + high * high);
      };
      side(force.x, c.x, s_.box.size.x), side(force.y, c.y, s_.box.size.y), side(force.z, c.z, s_.box.size.z);
      if (wall_) {
        const auto [depth, inward] = wall_(c, r);
        if (const double overlap = r - depth; overlap > 0) {
          force += (wall_stiffness * overlap) * inward;
          energy += 0.5 * wall_stiffness * overlap * overlap;
        }
      }
      acceleration_[i] = (1 / mass(i)) * force;
      energy_[i] = energy;
    });
  }

  // The sums run over the particles in order, on one thread: the same bits for any number of threads.
  double total_energy() const {
    double sum = 0;
    for (std::size_t i = first_; i < s_.size(); ++i) sum += energy_[i];
    return sum;
  }

  Dots dot_products() const {
    Dots sum;
    for (std::size_t i = first_; i < s_.size(); ++i) {
      const double m = mass(i);
      sum.power += m * dot(acceleration_[i], velocity_[i]);
      sum.v2 += m * dot(velocity_[i], velocity_[i]);
      sum.a2 += m * dot(acceleration_[i], acceleration_[i]);
    }
    return sum;
  }

  void move(double dt, double mixing, double v_per_a) {
    const double most = longest_move * unit_ / dt;
    const double far = 0.5 * skin_share * unit_;
    bool stale = false;
#pragma omp parallel for schedule(static) if (s_.size() >= parallel_from) reduction(|| : stale)
    for (std::size_t i = first_; i < s_.size(); ++i) {
      Vec3d v = (1 - mixing) * velocity_[i] + (dt + mixing * v_per_a) * acceleration_[i];
      const double speed = norm(v);
      if (speed > most) v = (most / speed) * v;
      velocity_[i] = v;
      const Vec3d p = s_.centre[i] + dt * v, l = s_.box.size;
      // No centre may reach a wall: beyond it there is no cell.
      const auto inside = [&](double x, double length) { return std::clamp(x, 1e-3 * length, 0.999 * length); };
      s_.centre[i] = {inside(p.x, l.x), inside(p.y, l.y), inside(p.z, l.z)};
      const Vec3d moved = s_.centre[i] - listed_at_[i];
      stale = stale || dot(moved, moved) > far * far;
    }
    if (!stale) return;
    neighbours_.rebuild();
    listed_at_ = s_.centre;
  }

  Specimen& s_;
  const Wall& wall_;
  std::size_t first_mastic_, first_;  ///< first mastic sphere, first sphere that moves
  double unit_;                       ///< mean radius of the mastic [m]
  Neighbours neighbours_;
  std::vector<Vec3d> listed_at_;  ///< centres at the last listing of the neighbours
  std::vector<Vec3d> velocity_, acceleration_;
  std::vector<double> energy_;
};

}  // namespace

int relax(Specimen& specimen, bool fix_aggregates, const std::function<void(double share)>& progress,
          const Wall& wall) {
  const int iterations = Relaxation(specimen, fix_aggregates, wall).run(progress);
  progress(1);
  return iterations;
}

double largest_aggregate_overlap(const Specimen& specimen) {
  Specimen aggregates{specimen.box, {}, {}, {}, {}};
  double smallest = specimen.box.size.x;
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    if (specimen.phase[i] != Phase::aggregate) continue;
    aggregates.centre.push_back(specimen.centre[i]);
    aggregates.radius.push_back(specimen.radius[i]);
    smallest = std::min(smallest, specimen.radius[i]);
  }
  const Neighbours neighbours(aggregates, smallest, 0);
  double largest = 0;
  for (std::size_t i = 0; i < aggregates.size(); ++i)
    for (std::int32_t j : neighbours.of(i))
      largest = std::max(
          largest, aggregates.radius[i] + aggregates.radius[j] - norm(aggregates.centre[i] - aggregates.centre[j]));
  return largest;
}

}  // namespace macadam
