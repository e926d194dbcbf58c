// SPDX-License-Identifier: GPL-3.0-or-later
/// \file boundary.hpp  Defines what is prescribed for walls and particles: displacements, forces, or rest.
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "macadam/drives/drive.hpp"
#include "macadam/error.hpp"
#include "macadam/numeric.hpp"
#include "macadam/tessellation.hpp"

namespace macadam {

/// The quantity that the drive of a wall axis prescribes. A wall under a force moves like a platen with a mass.
enum class DrivenBy : std::uint8_t { rest, displacement, force };

/// One axis of a wall.
struct WallAxis {
  DrivenBy by = DrivenBy::rest;
  /// The function of time; its dt() must equal the stepper's time step; null if the axis is at rest.
  std::shared_ptr<const Drive> drive;
};

/// One wall: its axes x, y, z, and the mass with which it follows forces [kg], without density scaling.
struct WallMotionSpec {
  std::array<WallAxis, 3> axis;
  double mass = 0;  ///< greater than 0 if an axis is driven by a force
};

/// Everything that acts on a specimen from outside. Walls do not rotate.
struct Boundary {
  std::array<WallMotionSpec, wall_count> wall;  ///< by wall_index()
  std::vector<std::int32_t> fixed;              ///< particles that never move
  std::vector<Vec3d> body_force;                ///< force on each particle, specimen order [N]; empty: none

  /// Prescribes the displacement of one axis (0, 1, 2) of a wall.
  Boundary& move(Wall which, int axis, std::shared_ptr<const Drive> drive) {
    wall[wall_index(which)].axis[static_cast<std::size_t>(axis)] = {DrivenBy::displacement, std::move(drive)};
    return *this;
  }
  /// Prescribes the force on one axis of a wall with this mass [kg]. \throws InputError if another axis of the wall has
  /// been given another mass.
  Boundary& load(Wall which, int axis, std::shared_ptr<const Drive> drive, double mass) {
    const std::size_t w = wall_index(which), loaded = static_cast<std::size_t>(axis);
    for (std::size_t other = 0; other < 3; ++other) {
      if (other == loaded || wall[w].axis[other].by != DrivenBy::force || wall[w].mass == mass) continue;
      char text[96];
      std::snprintf(text, sizeof text, "found %g kg, expected %g kg, the mass given with its axis %c", mass,
                    wall[w].mass, "xyz"[other]);
      throw InputError(std::string("boundary: wall ") + wall_names[w] + ": mass: " + text);
    }
    wall[w].axis[loaded] = {DrivenBy::force, std::move(drive)};
    wall[w].mass = mass;
    return *this;
  }
  /// Returns whether any axis of any wall has this kind of drive.
  bool any(DrivenBy by) const {
    for (const WallMotionSpec& w : wall) {
      for (const WallAxis& a : w.axis) {
        if (a.by == by) return true;
      }
    }
    return false;
  }
};

/// Returns the boundary of the uniaxial test: the top wall moves along z, everything else is at rest.
template <class D>
Boundary moving_top(D drive) {
  return Boundary().move(wall_z_hi, 2, std::make_shared<const D>(std::move(drive)));
}

}  // namespace macadam
