// SPDX-License-Identifier: GPL-3.0-or-later
// pose.cpp  Applies a unit quaternion to a vector without forming the rotation matrix.
#include "macadam/shape.hpp"

namespace macadam {

Vec3d Pose::operator()(const Vec3d& x) const {
  const Vec3d v{turn[1], turn[2], turn[3]};
  const Vec3d t = 2.0 * cross(v, x);
  return centre + scale * (x + turn[0] * t + cross(v, t));
}

}  // namespace macadam
