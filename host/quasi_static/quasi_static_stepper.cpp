// SPDX-License-Identifier: GPL-3.0-or-later
// quasi_static_stepper.cpp  Advances a test increment by increment until it has reached the step that a caller asks
// for.
#include "host/quasi_static/quasi_static_stepper.hpp"

#include <fmt/format.h>

#include "macadam/error.hpp"

namespace macadam {
namespace {

/// Returns the options with the drive of the top wall. \throws InputError if anything else is loaded or moves.
quasi_static::CourseOptions with_drive(const Boundary& boundary, quasi_static::CourseOptions options) {
  bool other = !boundary.fixed.empty() || !boundary.body_force.empty();
  for (std::size_t w = 0; w < wall_count; ++w) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const WallAxis& a = boundary.wall[w].axis[axis];
      if (a.by == DrivenBy::rest) continue;
      if (w != wall_index(wall_z_hi) || axis != 2) {
        other = true;
        continue;
      }
      options.drive = a.drive;
      options.by_force = a.by == DrivenBy::force;
    }
  }
  if (other || !options.drive)
    throw InputError(fmt::format(
        "quasi-static: found a boundary in which {}; expected a displacement or a force of the top wall along "
        "z, and nothing else that moves",
        other ? "another wall or direction moves" : "nothing moves"));
  return options;
}

}  // namespace

QuasiStaticStepper::QuasiStaticStepper(const Specimen& specimen, const ContactNetwork& network, const LawTable& laws,
                                       const Boundary& boundary, quasi_static::CourseOptions options)
    : dt_(0), increments_(specimen, network, laws, with_drive(boundary, std::move(options))) {
  dt_ = boundary.wall[wall_index(wall_z_hi)].axis[2].drive->dt();
}

void QuasiStaticStepper::advance(std::int64_t steps) {
  const std::int64_t asked = asked_ + steps;
  while (increments_.step() < asked) {
    increments_.advance();
    if (after_each_) after_each_(observed(increments_.step()));
  }
  asked_ = asked;
}

Observation QuasiStaticStepper::observed(std::int64_t step) const {
  Observation out;
  out.step = step;
  out.time = static_cast<double>(step) * dt_;
  out.wall_displacement = increments_.network().wall_displacement();
  out.wall_force = increments_.network().wall_force();
  return out;
}

Observation QuasiStaticStepper::observe() const { return observed(asked_); }

void QuasiStaticStepper::set_velocities(const std::vector<Vec3d>&, const std::vector<Vec3d>&) {
  throw RunError("quasi-static: particles have no velocities");
}

std::vector<StateArray> QuasiStaticStepper::state() const {
  std::vector<StateArray> out = increments_.state();
  out.push_back({"step", "1", std::vector<std::int64_t>{asked_}});
  return out;
}

void QuasiStaticStepper::set_state(const std::vector<StateArray>& arrays) {
  for (const StateArray& array : arrays) {
    const auto* step = std::get_if<std::vector<std::int64_t>>(&array.values);
    if (array.name != "step" || !step || step->size() != 1) continue;
    increments_.set_state(arrays);
    asked_ = step->front();
    return;
  }
  throw RunError("state: found no array step for method \"quasi_static\"");
}

}  // namespace macadam
