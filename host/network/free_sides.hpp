// SPDX-License-Identifier: GPL-3.0-or-later
/// \file free_sides.hpp  Computes how far the free sides of a specimen move, for its Poisson's ratio. Both methods use
/// this definition: the frequency domain with complex motions, time steps and increments with real ones.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "macadam/specimen.hpp"
#include "macadam/tessellation.hpp"

namespace macadam {

/// The free facets at the sides of a specimen. The lateral strain is a linear function of the motion of the particles
/// that have such facets. It is the mean of two lateral strains; a lateral strain is the change of the mean distance of
/// two opposite sides over their distance, and the mean is over the area of the facets. With curved sides it is half
/// the integral of the outward displacement over the sides, divided by the volume. A domain without a uniform section
/// has no lateral strain.
class FreeSides {
 public:
  FreeSides(const Specimen& specimen, const Tessellation& cells);

  /// Returns whether every side has a free facet. Otherwise there is no lateral strain.
  bool known() const { return known_; }

  /// Returns the particles that have a free facet, in ascending order.
  const std::vector<std::int32_t>& particles() const { return particles_; }

  /// Returns the contraction [m]: minus the lateral strain times the gauge length. Divided by the displacement of the
  /// top wall along z it is Poisson's ratio. `motion(i)` returns six values, ux uy uz θx θy θz [m, rad], of
  /// particles()[i]. `opening(i)` returns the opening of the particle's free facets per distance of the facet from the
  /// particle's centre, which the rule "volumetric" has. T is double or a complex number. known() must be true.
  template <class T, class Motion, class Opening>
  T contraction(const Motion& motion, const Opening& opening) const;

  /// Returns the contraction [m] without openings. `motion` has the same order as particles().
  double contraction(const std::vector<std::array<double, 6>>& motion) const {
    return contraction<double>([&](std::size_t i) { return motion[i].data(); }, [](std::size_t) { return 0.0; });
  }

 private:
  struct Patch {
    std::size_t particle = 0, side = 0;  ///< numbers in particles_ and in area_
    double area = 0;                     ///< [m²]
    Vec3d normal, arm;                   ///< outward normal; arm from the particle's centre to the facet's centroid [m]
  };

  Domain box_;
  std::vector<std::int32_t> particles_;
  std::vector<Patch> patches_;
  std::array<double, 4> area_{};  ///< area of the sides −x +x −y +y; a curved side is the first one
  bool known_ = false;
};

template <class T, class Motion, class Opening>
T FreeSides::contraction(const Motion& motion, const Opening& opening) const {
  std::array<T, 4> outwards{};  // area times displacement along the outward normal
  for (const Patch& p : patches_) {
    const auto* m = motion(p.particle);
    const Vec3d& r = p.arm;
    const T along_x = m[0] + (m[4] * r.z - m[5] * r.y), along_y = m[1] + (m[5] * r.x - m[3] * r.z);
    T out = p.normal.x * along_x + p.normal.y * along_y;
    out -= dot(p.normal, r) * opening(p.particle);
    outwards[p.side] += p.area * out;
  }
  if (!box_.is_box()) return -0.5 * gauge_length(box_) / box_.volume() * outwards[0];
  const auto mean = [&](std::size_t side) { return outwards[side] / area_[side]; };
  const Vec3d& size = box_.size;
  return -0.5 * size.z * ((mean(0) + mean(1)) / size.x + (mean(2) + mean(3)) / size.y);
}

}  // namespace macadam
