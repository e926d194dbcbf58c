// SPDX-License-Identifier: GPL-3.0-or-later
// poisson_ratio.cpp  Computes the Poisson's ratio of a specimen from the motion of its free sides.
#include <array>

#include "macadam/harmonic.hpp"

namespace macadam {
namespace {

using Complex = std::complex<double>;

/// Returns the outward displacement of the free facet `f` of particle a: the motion of its centroid with the particle,
/// and the opening that makes the stress on it zero, 2μ/h·opening + pressure = 0 (model, section 26).
Complex outward_displacement(const Specimen& specimen, const Facet& f, const HarmonicResult& state) {
  const Complex* m = &state.motion[6 * static_cast<std::size_t>(f.a)];
  const Vec3d r = f.centroid - specimen.centre[static_cast<std::size_t>(f.a)];
  const Complex along_x = m[0] + (m[4] * r.z - m[5] * r.y), along_y = m[1] + (m[5] * r.x - m[3] * r.z);
  Complex out = f.normal.x * along_x + f.normal.y * along_y;
  if (!state.pressures.empty()) out -= dot(f.normal, r) * state.pressures[static_cast<std::size_t>(f.a)];
  return out;
}

/// Returns the ratio for curved sides. The mean lateral strain is half the integral of the outward displacement over
/// the sides, divided by the volume.
std::optional<Complex> ratio_of_curved_sides(const Specimen& specimen, const Tessellation& cells,
                                             const HarmonicResult& state) {
  Complex outwards = 0;  // area times displacement along the outward normal
  bool any = false;
  for (const Facet& f : cells.facets) {
    if (f.a >= static_cast<std::int32_t>(specimen.size()) || f.b != wall_x_lo) continue;
    outwards += f.area * outward_displacement(specimen, f, state);
    any = true;
  }
  if (!any) return {};
  // the top wall moves by 1, so the axial strain is 1 over the gauge length
  return -0.5 * gauge_length(specimen) / specimen.box.volume() * outwards;
}

}  // namespace

std::optional<std::complex<double>> poisson_ratio(const Specimen& specimen, const Tessellation& cells,
                                                  const HarmonicResult& state) {
  if (!specimen.box.is_box()) return ratio_of_curved_sides(specimen, cells, state);
  struct Side {
    double area = 0;
    Complex outwards = 0;  ///< area times displacement along the outward normal
  };
  std::array<Side, 4> sides;  // −x, +x, −y, +y
  for (const Facet& f : cells.facets) {
    const bool of_particle = f.a < static_cast<std::int32_t>(specimen.size());
    if (!of_particle || f.b > wall_x_lo || f.b < wall_y_hi) continue;
    Side& side = sides[static_cast<std::size_t>(-1 - f.b)];
    side.area += f.area;
    side.outwards += f.area * outward_displacement(specimen, f, state);
  }
  for (const Side& side : sides)
    if (!(side.area > 0)) return {};
  const auto mean = [&](std::size_t side) { return sides[side].outwards / sides[side].area; };
  const Vec3d& box = specimen.box.size;
  // the top wall moves by 1, so the axial strain is 1/box.z
  return -0.5 * box.z * ((mean(0) + mean(1)) / box.x + (mean(2) + mean(3)) / box.y);
}

}  // namespace macadam
