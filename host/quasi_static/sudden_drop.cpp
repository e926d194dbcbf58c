// SPDX-License-Identifier: GPL-3.0-or-later
// sudden_drop.cpp  Follows a specimen that loses its stability, with the wall at rest, to its next equilibrium. A drag
// on cracks keeps each increment short enough for Newton's method.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/quasi_static/engine.hpp"
#include "host/quasi_static/increments.hpp"

namespace macadam::quasi_static {
namespace {

constexpr std::size_t loaded_wall = wall_index(wall_z_hi);
/// Drag of the first increment of a drop, and its bounds, see WallIncrement::drag.
constexpr double first_drag = 0.02, least_drag = 1e-4, largest_drag = 100;
/// The drag becomes this many times larger if an increment of a drop has no solution. It becomes smaller by the same
/// factor after fast convergence, but not in the next increments after it has become larger: `first_patience` of them
/// the first time, then twice the last number, at most `largest_patience`.
constexpr double drag_ratio = 4;
constexpr int fast_passes = 4, first_patience = 4, largest_patience = 32;
/// The program looks for an equilibrium again when QuasiStatic::drag() has fallen to this part of its largest value
/// since the last attempt.
constexpr double calmer = 0.01;
/// Largest number of increments of a drop.
constexpr int most_of_drop = 2000;
/// A drop by less than this part of the largest stress is not reported: another equilibrium was near.
constexpr double reported_drop = 0.01;

}  // namespace

void Increments::drop(std::int64_t steps) {
  const CourseReport::Unstable before{network_.time(), network_.wall_displacement()[loaded_wall].z / options_.height,
                                      past_.back().value};
  if (!follow_drop(steps)) {
    throw NoEquilibrium(
        fmt::format("quasi-static: found no equilibrium after t = {:.6g} s at a strain of {:.6g} ({:.4g} MPa), where "
                    "the specimen moves suddenly, although its cracks moved against a drag; method = \"explicit\" "
                    "in [solver] can follow",
                    before.time_s, before.strain, before.stress_pa / 1e6),
        before);
  }
  if (std::abs(before.stress_pa - past_.back().value) > reported_drop * largest_) {
    ++report_.drops;
    if (!report_.first_drop) report_.first_drop = before;
  }
  past_ = {past_.back()};
  usual_ = length_ = static_cast<double>(steps);
}

bool Increments::follow_drop(std::int64_t steps) {
  const std::vector<StateArray> saved = options_.stop ? state() : std::vector<StateArray>{};
  WallIncrement next = increment_of(steps);
  next.wall[loaded_wall].z = drive_at(step_ + steps) - network_.wall_displacement()[loaded_wall].z;
  next.drag = first_drag;
  int keep = 0, patience = first_patience;  // numbers of increments in which the drag does not become smaller
  double largest = 0;                       // value of drag() since the last attempt to find an equilibrium
  for (int k = 0; k < most_of_drop; ++k) {
    if (options_.stop && options_.stop()) {
      set_state(saved);
      throw Stopped{};
    }
    IncrementReport found = solve(next);
    if (!found.converged) {
      network_.reject();
      ++report_.rejected;
      next.drag *= drag_ratio, keep = patience;
      patience = std::min(2 * patience, largest_patience);
      if (next.drag > largest_drag) return false;
      continue;
    }
    network_.accept();
    count(found);
    if (keep == 0 && found.passes <= fast_passes) next.drag = std::max(least_drag, next.drag / drag_ratio);
    keep = std::max(0, keep - 1);
    next.wall = {}, next.warming = 0, next.dt = instant;
    if (next.reduced_dt) next.reduced_dt->fill(instant);
    const double size = network_.drag();
    largest = std::max(largest, size);
    if (size > calmer * largest) continue;
    largest = size;
    WallIncrement last = next;
    last.drag = 0;
    found = solve(last);
    if (found.converged) {
      accept(steps, found, false);
      return true;
    }
    network_.reject();
    ++report_.rejected;
  }
  return false;
}

}  // namespace macadam::quasi_static
