// SPDX-License-Identifier: GPL-3.0-or-later
/// \file box_motion.hpp  Converts the rigid motions of a box (a group of neighbouring particles) to the motion of one
/// of its particles, and the load on a particle to the load on the rigid motions of its box.
#pragma once

#include "kernels/contact/contact_kinematics.hpp"

namespace macadam::kernels {

/// Position of a particle relative to the middle of its box, and the half width of the box [m]. The motions of a box
/// are three displacements y[0…2], and three rotations y[3…5] about the middle times the half width, so that all six
/// are lengths.
struct Lever {
  double x, y, z, width;
};

/// Returns the motion of the particle under the motions of its box: u = d + θ × lever / width, rotation θ / width.
template <class T>
MACADAM_HD Twist<T> moved_with_box(const Lever& l, const T (&y)[6]) {
  const double w = 1 / l.width;
  const Vec3<T> turn{w * y[3], w * y[4], w * y[5]};
  return {{y[0] + (l.z * turn.y - l.y * turn.z), y[1] + (l.x * turn.z - l.z * turn.x),
           y[2] + (l.y * turn.x - l.x * turn.y)},
          turn};
}

/// Adds the load on a particle to the load on the box's motions: the transpose of moved_with_box().
template <class T>
MACADAM_HD void add_to_box(const Lever& l, const Twist<T>& v, T (&y)[6]) {
  const double w = 1 / l.width;
  y[0] += v.linear.x, y[1] += v.linear.y, y[2] += v.linear.z;
  y[3] += w * (v.angular.x + (l.y * v.linear.z - l.z * v.linear.y));
  y[4] += w * (v.angular.y + (l.z * v.linear.x - l.x * v.linear.z));
  y[5] += w * (v.angular.z + (l.x * v.linear.y - l.y * v.linear.x));
}

}  // namespace macadam::kernels
