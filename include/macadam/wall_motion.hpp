// SPDX-License-Identifier: GPL-3.0-or-later
/// \file wall_motion.hpp  Defines the motion of the top wall in the frequency domain: a displacement along z, or a turn
/// about the axis of a cylinder.
#pragma once

#include <string>
#include <vector>

#include "macadam/contact_network.hpp"
#include "macadam/error.hpp"
#include "macadam/specimen.hpp"

namespace macadam {

/// A small motion of the top wall as a rigid body. All other walls are at rest. Amplitudes are 1, because the solutions
/// of the frequency domain are linear.
class WallMotion {
 public:
  /// Motion of a point that moves with the wall: its displacement [m] and its rotation [rad].
  struct Rigid {
    Vec3d displacement{}, rotation{};
  };

  /// The wall moves by 1 m along z.
  WallMotion() : WallMotion({0, 0, 1}, {}) {}

  /// Returns the motion of a wall that is at rest.
  static WallMotion at_rest() { return {{}, {}}; }

  /// Returns a turn of the wall by 1 rad about the axis of the specimen, which is parallel to z. Keeps a pointer to the
  /// centres of the particles; `specimen` must outlive the returned object and its copies. \throws InputError if the
  /// domain of the specimen has no torsion constant (Domain::torsion_constant()).
  static WallMotion turn(const Specimen& specimen) {
    if (!specimen.box.torsion_constant())
      throw InputError(std::string("turn of the top wall: found a ") + specimen.box.name() +
                       ", expected a cylinder, whose section stays plane when it turns");
    WallMotion out({}, {0, 0, 1});
    out.axis_ = 0.5 * specimen.box.size;
    out.centres_ = &specimen.centre;
    return out;
  }

  /// Returns whether the wall turns.
  bool turns() const { return centres_ != nullptr; }

  /// Returns the motion of the second end of a contact at the contact's reference point x0, if this end is a wall. It
  /// is zero unless the wall is the top wall.
  Rigid at(const Contact& c) const {
    if (c.b != wall_z_hi) return {};
    if (!centres_) return {displacement_, {}};
    return at_point(centre(c) + c.arm_a * c.n);
  }

  /// Returns the motion that the first particle of a contact would have if it moved with the wall.
  Rigid of_particle(const Contact& c) const {
    if (!centres_) return {displacement_, {}};
    return at_point(centre(c));
  }

 private:
  WallMotion(const Vec3d& displacement, const Vec3d& rotation) : displacement_(displacement), rotation_(rotation) {}

  const Vec3d& centre(const Contact& c) const { return (*centres_)[static_cast<std::size_t>(c.a)]; }
  Rigid at_point(const Vec3d& p) const { return {displacement_ + cross(rotation_, p - axis_), rotation_}; }

  Vec3d displacement_, rotation_;
  Vec3d axis_{};                                 ///< a point of the axis [m]
  const std::vector<Vec3d>* centres_ = nullptr;  ///< of the particles [m]; a null pointer if the wall does not turn
};

}  // namespace macadam
