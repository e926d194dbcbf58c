// SPDX-License-Identifier: GPL-3.0-or-later
// poisson_ratio.cpp  Computes the Poisson's ratio of a specimen from the motion of its free sides.
#include <array>

#include "macadam/harmonic.hpp"

namespace macadam {

std::optional<std::complex<double>> poisson_ratio(const Specimen& specimen, const Tessellation& cells,
                                                  const HarmonicResult& state) {
  using Complex = std::complex<double>;
  struct Side {
    double area = 0;
    Complex outwards = 0;  ///< area times displacement along the outward normal
  };
  std::array<Side, 4> sides;  // −x, +x, −y, +y
  for (const Facet& f : cells.facets) {
    const bool of_particle = f.a < static_cast<std::int32_t>(specimen.size());
    if (!of_particle || f.b > wall_x_lo || f.b < wall_y_hi) continue;
    const Complex* m = &state.motion[6 * static_cast<std::size_t>(f.a)];
    const Vec3d r = f.centroid - specimen.centre[static_cast<std::size_t>(f.a)];
    const bool along_x = f.b >= wall_x_hi;
    const Complex u = along_x ? m[0] + (m[4] * r.z - m[5] * r.y) : m[1] + (m[5] * r.x - m[3] * r.z);
    Side& side = sides[static_cast<std::size_t>(-1 - f.b)];
    side.area += f.area;
    side.outwards += (along_x ? f.normal.x : f.normal.y) * f.area * u;
    // The stress on a free facet is zero: 2μ/h·opening + pressure = 0 (model, section 26)
    if (!state.pressures.empty())
      side.outwards -= f.area * dot(f.normal, r) * state.pressures[static_cast<std::size_t>(f.a)];
  }
  for (const Side& side : sides)
    if (!(side.area > 0)) return {};
  const auto mean = [&](std::size_t side) { return sides[side].outwards / sides[side].area; };
  const Vec3d& box = specimen.box.size;
  // the top wall moves by 1, so the axial strain is 1/box.z
  return -0.5 * box.z * ((mean(0) + mean(1)) / box.x + (mean(2) + mean(3)) / box.y);
}

}  // namespace macadam
