// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reference_contact.cpp  Moves the frame of a contact with its particles.
#include "host/reference/reference_contact.hpp"

#include <cmath>

#include <Eigen/Geometry>

namespace macadam::reference {

ReferenceContact make_reference_contact(const ContactNetwork& network, const Contact& contact, std::size_t units) {
  ReferenceContact out;
  out.a = contact.a;
  out.b = contact.b;
  out.pair = contact.pair;
  out.length = contact.length;
  out.series = contact.series;
  out.initial_distance = contact.distance;
  out.initial_arm_a = contact.arm_a;
  out.frame = {to_eigen(contact.n), to_eigen(contact.s), to_eigen(contact.t), contact.arm_a, contact.arm_b};
  out.middle = out.frame;
  for (std::uint32_t j = contact.point_begin; j < contact.point_end; ++j) {
    ContactPoint point{network.point_s[j], network.point_t[j], network.point_area[j], {}};
    for (ChainState& chain : point.chain) chain.stretch.assign(units, 0.0);
    out.points.push_back(point);
  }
  return out;
}

ContactFrame middle_of(const ContactFrame& before, const ContactFrame& after) {
  ContactFrame out;
  out.n = (before.n + after.n).normalized();
  out.s = before.s + after.s;
  out.s = (out.s - out.s.dot(out.n) * out.n).normalized();
  out.t = out.n.cross(out.s);
  out.arm_a = (before.arm_a + after.arm_a) / 2;
  out.arm_b = (before.arm_b + after.arm_b) / 2;
  return out;
}

// The distance of x0 from A is R_A − Un/2 − dv, with Un = R_A + R_B − d and a constant dv (Eq. 5, 6). So if d changes,
// the lever arm of A takes one half of the change, and the lever arm of B the other half.
void ReferenceContact::follow_pair(const Vector3d& centres, const Vector3d& mean_turn) {
  const ContactFrame before = frame;
  const double d = centres.norm();
  frame.n = centres / d;
  // the smallest rotation from the old normal to the new normal turns about the cross product of the two
  frame.s = Eigen::Quaterniond::FromTwoVectors(before.n, frame.n) * frame.s;
  spin_frame(mean_turn);
  frame.arm_a = initial_arm_a + (d - initial_distance) / 2;
  frame.arm_b = d - frame.arm_a;
  middle = middle_of(before, frame);
}

void ReferenceContact::follow_wall(double distance, const Vector3d& mean_turn) {
  const ContactFrame before = frame;
  spin_frame(mean_turn);
  frame.arm_a = distance;
  middle = middle_of(before, frame);
}

// Turns ŝ about n by the pair's mean turn about n, then makes the frame orthonormal again; otherwise rounding errors
// would add up over millions of steps.
void ReferenceContact::spin_frame(const Vector3d& mean_turn) {
  frame.s = Eigen::AngleAxisd(mean_turn.dot(frame.n), frame.n) * frame.s;
  frame.s = (frame.s - frame.s.dot(frame.n) * frame.n).normalized();
  frame.t = frame.n.cross(frame.s);
}

}  // namespace macadam::reference
