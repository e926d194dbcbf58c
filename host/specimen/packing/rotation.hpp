// SPDX-License-Identifier: GPL-3.0-or-later
/// \file rotation.hpp  Represents rotations of rigid bodies: unit quaternions (w, x, y, z) and their matrices.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "macadam/numeric.hpp"

namespace macadam {

using Quaternion = std::array<double, 4>;

/// The matrix of a unit quaternion (or a product of such matrices), stored by rows.
struct Rotation {
  Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

  Rotation() = default;
  explicit Rotation(const Quaternion& q)
      : x{1 - 2 * (q[2] * q[2] + q[3] * q[3]), 2 * (q[1] * q[2] - q[0] * q[3]), 2 * (q[1] * q[3] + q[0] * q[2])},
        y{2 * (q[1] * q[2] + q[0] * q[3]), 1 - 2 * (q[1] * q[1] + q[3] * q[3]), 2 * (q[2] * q[3] - q[0] * q[1])},
        z{2 * (q[1] * q[3] - q[0] * q[2]), 2 * (q[2] * q[3] + q[0] * q[1]), 1 - 2 * (q[1] * q[1] + q[2] * q[2])} {}

  Vec3d operator()(const Vec3d& v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }

  /// Applies the inverse rotation.
  Vec3d back(const Vec3d& v) const { return v.x * x + v.y * y + v.z * z; }
};

/// Returns a random rotation, uniformly distributed over all rotations (Shoemake 1992).
template <class Random>
Quaternion random_turn(Random& random) {
  const double u = random.uniform(), a = 2 * std::numbers::pi * random.uniform(),
               b = 2 * std::numbers::pi * random.uniform();
  const double low = std::sqrt(1 - u), high = std::sqrt(u);
  return {high * std::cos(b), low * std::sin(a), low * std::cos(a), high * std::sin(b)};
}

/// Returns `q` followed by a rotation about the vector `angle`, whose length is the angle [rad], in the space-fixed
/// frame.
inline Quaternion turned(const Quaternion& q, const Vec3d& angle) {
  const double size = norm(angle), share = size > 0 ? std::sin(size / 2) / size : 0.5;
  const double w = std::cos(size / 2);
  const Vec3d v = share * angle, p{q[1], q[2], q[3]};
  const Vec3d n = w * p + q[0] * v + cross(v, p);
  Quaternion r{w * q[0] - dot(v, p), n.x, n.y, n.z};
  const double length = std::sqrt(r[0] * r[0] + dot(n, n));
  for (double& c : r) c /= length;
  return r;
}

}  // namespace macadam
