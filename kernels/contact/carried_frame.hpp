// SPDX-License-Identifier: GPL-3.0-or-later
/// \file carried_frame.hpp  Updates the frame of a facet as its two bodies move: docs/model.md, section 9.
///
/// S is a scalar or a SIMD pack. The frame rotates by a small angle in one step or one block of steps. So roots, sines
/// and divisions are replaced by series, whose error is below rounding for such angles.
#pragma once

#include <cstdint>
#include <type_traits>

#include "kernels/contact/contact_kinematics.hpp"

namespace macadam::kernels {

/// Number of words in which the unit tangent ŝ of a contact is stored. In single precision the fourth word is the
/// rotation angle about the normal n that has not been applied to ŝ yet. Increments of 1e-10 would be lost if they were
/// applied to ŝ at once.
template <class State>
inline constexpr std::int32_t tangent_words = sizeof(State) == 8 ? 3 : 4;

/// Distance of two particles, and its inverse.
template <class T>
struct Distance {
  T length{}, inverse{};
};

/// Sets normal and lever arms of a frame from the displaced centres, whose distance vector is `branch`. On entry the
/// frame has the arms of the undeformed contact. Each arm takes half the change of the distance d0; a facet on a wall
/// stays on the wall. Returns the distance of the centres, or zero for a facet on a wall.
template <class T>
MACADAM_HD Distance<T> follow_branch(Placement<T>& frame, const Vec3<T>& n0, const T& d0, const Vec3<T>& branch,
                                     bool wall) {
  frame.n = n0;
  if (wall) {
    frame.arm_a = dot(branch, n0);
    return {};
  }
  const T d = norm(branch), inverse = T(1) / d;
  frame.n = inverse * branch;
  const T half = T(0.5f) * (d - d0);
  frame.arm_a += half;
  frame.arm_b += half;
  return {d, inverse};
}

/// Returns 1/√x by its series about 1. The error is below rounding for |1 − x| < 1e-3 in double precision. A finite x
/// never gives NaN.
template <class S>
MACADAM_HD S inverse_root_near_one(const S& x) {
  const S e = S(1) - x;
  return S(1) + e * (S(0.5f) + e * (S(0.375f) + e * (S(0.3125f) + e * S(0.2734375f))));
}

/// Returns ŝ turned by the smallest rotation that takes the normal `from` to the normal `to`, followed by one Newton
/// step towards unit length. The exact divisor of (from + to) is 1 + from·to = 2 − e; 1/(2 − e) is computed by its
/// series in e, which is small.
template <class S>
MACADAM_HD Vec3<S> swung(Vec3<S> s, const Vec3<S>& from, const Vec3<S>& to) {
  const S e = S(1) - dot(from, to);
  const S inverse = S(0.5f) + e * (S(0.25f) + e * (S(0.125f) + e * S(0.0625f)));
  s -= (dot(s, to) * inverse) * (from + to);
  return (S(1.5f) - S(0.5f) * dot(s, s)) * s;
}

/// Returns ŝ turned about n by a small angle. Below 1e-3 the error of the series is smaller than rounding.
template <class S>
MACADAM_HD Vec3<S> spun(const Vec3<S>& s, const Vec3<S>& n, const S& angle) {
  const S square = angle * angle;
  return (S(1) - S(0.5f) * square) * s + (angle * (S(1) - square * (S(1) / S(6)))) * cross(n, s);
}

/// Unit tangent ŝ of a contact before and after its frame is rotated.
template <class S>
struct TangentTurn {
  Vec3<S> before, now;
};

/// Rotates the stored tangent ŝ with the normal, from `n_before` to `n`, and then about `n` by the angle `spin`. Work:
/// scalar type of the arithmetic. In single precision, ŝ is rewritten only after it has rotated by 1e-3, because
/// rounding would spoil smaller changes. Until then the angle about the normal is accumulated in the fourth word.
template <class Work, class Item, class State, class S>
MACADAM_HD TangentTurn<S> turn_tangent(const Item& item, State* stored, const Vec3<S>& n_before, const Vec3<S>& n,
                                       const S& spin) {
  const auto read = [&](int w) {
    return item.template convert<Work>(item.load(stored + static_cast<std::size_t>(w) * item.lanes()));
  };
  const auto write = [&](int w, const S& x) {
    item.store(stored + static_cast<std::size_t>(w) * item.lanes(), item.template convert<State>(x));
  };
  const Vec3<S> old{read(0), read(1), read(2)};
  if constexpr (tangent_words<State> == 3) {
    const Vec3<S> now = spun(swung(old, n_before, n), n, spin);
    write(0, now.x), write(1, now.y), write(2, now.z);
    return {old, now};
  } else {
    const S pending = read(3);
    const Vec3<S> before = spun(swung(old, n_before, n_before), n_before, pending);
    const Vec3<S> now = spun(swung(before, n_before, n), n, spin);
    const S tilt = dot(old, n), angle = pending + spin;
    const auto rewrite = tilt * tilt + angle * angle > S(1e-6f);
    write(0, item.select(rewrite, now.x, old.x));
    write(1, item.select(rewrite, now.y, old.y));
    write(2, item.select(rewrite, now.z, old.z));
    write(3, item.select(rewrite, S(0), angle));
    return {before, now};
  }
}

}  // namespace macadam::kernels
