// SPDX-License-Identifier: GPL-3.0-or-later
// disc_modulus.cpp  Computes the complex modulus of a disc between two strips.
#include "host/experiments/cyclic/disc_modulus.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "host/experiments/cyclic/mean_motion.hpp"
#include "macadam/error.hpp"

namespace macadam {

using experiments::HarmonicFrequency;
using Complex = std::complex<double>;

namespace {

/// Returns the integral of f from 0 to `end` by Simpson's rule.
template <class F>
double integral(double end, const F& f) {
  constexpr int intervals = 20000;
  double sum = f(0.0) + f(end);
  for (int k = 1; k < intervals; ++k) sum += (k % 2 == 1 ? 4 : 2) * f(end * k / intervals);
  return end * sum / (3 * intervals);
}

[[noreturn]] void require_finer(const char* place, double distance) {
  throw RunError(
      fmt::format("indirect_tension: found no particle {} within {:g} m; expected a finer packing or wider strips",
                  place, distance));
}

/// Returns the motion along x of one end of the horizontal diameter per unit displacement of the top strip: the mean
/// over the facets of the free side that are at most half the strip's width above or below the diameter. `right`: the
/// end with the larger x.
Complex end_of_diameter(const Specimen& specimen, const Tessellation& cells, const HarmonicResult& state,
                        double strip_width, bool right) {
  const double middle = 0.5 * specimen.box.size.z;
  Complex sum = 0;
  double area = 0;
  for (const Facet& f : cells.facets) {
    if (f.b != wall_x_lo || f.a >= static_cast<std::int32_t>(specimen.size())) continue;
    if ((f.normal.x > 0) != right || std::abs(f.centroid.z - middle) > 0.5 * strip_width) continue;
    const auto particle = static_cast<std::size_t>(f.a);
    const Complex* u = &state.motion[6 * particle];
    const Vec3d arm = f.centroid - specimen.centre[particle];
    sum += f.area * (u[0] + u[4] * arm.z - u[5] * arm.y);
    area += f.area;
  }
  if (!(area > 0)) require_finer("at an end of the horizontal diameter", 0.5 * strip_width);
  return sum / area;
}

/// Returns the mean over the particles in a square whose middle is on the loaded diameter at this height [m]. The
/// square has half the strip's width, because the motion decreases on both sides of the diameter.
MeanMotion level_at(const Specimen& specimen, const HarmonicResult& state, double strip_width, double height) {
  const Vec3d& size = specimen.box.size;
  const Vec3d middle{0.5 * size.x, 0.5 * size.y, height}, half{0.25 * strip_width, size.y, 0.25 * strip_width};
  const std::optional<MeanMotion> found = mean_motion(specimen, state, middle, half);
  if (!found) require_finer("on the vertical diameter, a quarter of its length from an end,", 0.25 * strip_width);
  return *found;
}

Stiffness stiffness_of(Complex modulus) { return {std::abs(modulus), std::arg(modulus) * 180 / std::numbers::pi}; }

}  // namespace

HondrosCoefficients hondros_coefficients(double half_angle, double middle_part) {
  const double sine = std::sin(2 * half_angle), cosine = std::cos(2 * half_angle), tangent = std::tan(half_angle);
  const double scale = 2 / (std::numbers::pi * std::sin(half_angle));
  // The stresses on a diameter are ±2p/π·(first ∓ second) at the distance √q·R from the centre; `side` is 1 on the
  // horizontal diameter and −1 on the loaded one
  const auto first = [&](double q, double side) { return (1 - q) * sine / (1 + side * 2 * q * cosine + q * q); };
  const auto second = [&](double q, double side) {
    return side > 0 ? std::atan((1 - q) / (1 + q) * tangent) : std::atan2((1 + q) * tangent, 1 - q);
  };
  const auto both = [&](double side, double sign) {
    return scale * integral(side > 0 ? 1 : middle_part,
                            [&](double x) { return first(x * x, side) + sign * second(x * x, side); });
  };
  return {both(1, -1), both(1, 1), both(-1, 1), both(-1, -1)};
}

void observe_disc(const experiments::IndirectTension& test, const Specimen& specimen, const Tessellation& cells,
                  const HarmonicResult& state, HarmonicFrequency& out) {
  const Domain& disc = specimen.box;
  const double diameter = disc.size.x, thickness = disc.size.y;
  const double width = std::get<domains::Disc>(disc.shape).strip_width;
  // the modulus of a column with the height and the middle section of the disc is force·height/(section·displacement)
  const auto reaction = [&](const Stiffness& s) {
    return std::polar(s.e_star_pa, s.phase_deg * std::numbers::pi / 180) * disc.section_area() / disc.gauge_length();
  };
  const Complex force = reaction(state.top);  // per unit displacement of the top strip
  const Complex wider =
      end_of_diameter(specimen, cells, state, width, false) - end_of_diameter(specimen, cells, state, width, true);
  const MeanMotion upper = level_at(specimen, state, width, 0.75 * diameter),
                   lower = level_at(specimen, state, width, 0.25 * diameter);
  const Complex shorter = upper.along_z - lower.along_z;
  const double length = upper.position.z - lower.position.z;
  out.disc = {wider / force, shorter / force * (0.5 * diameter / length), 1.0 / force};
  const HondrosCoefficients h = hondros_coefficients(std::asin(width / diameter), length / diameter);
  const Complex ratio =
      test.poisson_ratio ? Complex(*test.poisson_ratio) : (wider * h.c - shorter * h.a) / (shorter * h.b - wider * h.d);
  const Complex modulus = (h.a + h.b * ratio) / (thickness * out.disc->horizontal);
  const Complex of_bottom = modulus * reaction(state.bottom) / force;
  out.stiffness = stiffness_of(modulus);
  out.bottom = stiffness_of(of_bottom);
  out.poisson_ratio = ratio;
  out.parts = {};
}

}  // namespace macadam
