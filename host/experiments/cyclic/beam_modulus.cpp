// SPDX-License-Identifier: GPL-3.0-or-later
// beam_modulus.cpp  Computes the complex modulus of a beam between rollers.
#include "host/experiments/cyclic/beam_modulus.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "host/experiments/cyclic/beam_theory.hpp"
#include "host/experiments/cyclic/mean_motion.hpp"
#include "host/harmonic/contact_operator.hpp"
#include "macadam/error.hpp"

namespace macadam {

using experiments::HarmonicFrequency;
using Complex = std::complex<double>;

namespace {

/// Returns the mean motion at half of the height of the beam above or below a roller with this middle [m]. The
/// particles are in a box as long as the roller, as wide as the beam and a quarter of its height high.
MeanMotion on_neutral_axis(const Specimen& specimen, const HarmonicResult& state, double middle, double roller_width) {
  const Vec3d& size = specimen.box.size;
  const Vec3d half_edges{0.5 * roller_width, size.y, 0.125 * size.z};
  const std::optional<MeanMotion> found =
      mean_motion(specimen, state, {middle, 0.5 * size.y, 0.5 * size.z}, half_edges);
  if (!found)
    throw RunError(
        fmt::format("bending: found no particle at half of the height within {:g} m of x = {:g} m, where the "
                    "deflection is measured; expected a finer packing or wider rollers",
                    half_edges.x, middle));
  return *found;
}

/// Returns E·δ for a unit displacement of the upper rollers, equation (B.5) of docs/bending.md: the loads of all
/// contacts with rollers, weighted by the deflection and the slope of the beam under a unit force.
Complex weighted_loads(const Specimen& specimen, const ContactNetwork& network, const LawTable& laws,
                       const HarmonicResult& state, const UnitDeflection& unit) {
  const harmonic::PairStiffness stiffness =
      harmonic::pair_stiffness(laws, Complex(state.growth, 2 * std::numbers::pi * state.frequency_hz));
  const double neutral_axis = 0.5 * specimen.box.size.z;
  Complex sum = 0;
  for (const Contact& c : network.contacts) {
    if (c.b >= 0) continue;
    const auto load = harmonic::facet_load(c, stiffness, harmonic::relative_motion(c, state.motion, state.wall));
    const auto component = [&c](const Complex& n, const Complex& s, const Complex& t, double Vec3d::*axis) {
      return n * (c.n.*axis) + s * (c.s.*axis) + t * (c.t.*axis);
    };
    // force on the particle at x0, and couple about the neutral axis above or below x0
    const Complex along_x = component(load.n, load.s, load.t, &Vec3d::x),
                  along_z = component(load.n, load.s, load.t, &Vec3d::z),
                  about_y = component(load.moment_n, load.moment_s, load.moment_t, &Vec3d::y);
    const Vec3d x0 = specimen.centre[static_cast<std::size_t>(c.a)] + c.arm_a * c.n;
    const Complex couple = about_y + (x0.z - neutral_axis) * along_x;
    sum += along_z * unit.deflection(x0.x) - couple * unit.slope(x0.x);
  }
  return sum;
}

Stiffness magnitude_and_phase(const Complex& z) { return {std::abs(z), std::arg(z) * 180 / std::numbers::pi}; }

}  // namespace

void observe_beam(const experiments::Bending& test, const Specimen& specimen, const ContactNetwork& network,
                  const LawTable& laws, const HarmonicResult& state, HarmonicFrequency& out) {
  const Domain& beam = specimen.box;
  const domains::Rollers& rollers = *beam.rollers();
  const auto measured = [&](double middle) { return on_neutral_axis(specimen, state, middle, rollers.width); };
  const MeanMotion left = measured(rollers.bottom.at(0)), right = measured(rollers.bottom.at(1)),
                   midspan = measured(0.5 * beam.size.x);
  // The deflection is measured from the straight line through the two supports, at the mean positions of the particles
  const double x1 = left.position.x, x2 = right.position.x, x = midspan.position.x;
  const Complex chord = ((x2 - x) * left.along_z + (x - x1) * right.along_z) / (x2 - x1);
  const Complex deflection = midspan.along_z - chord;
  const UnitDeflection unit(x1, x2, x, beam.size.y, beam.size.z, test.poisson_ratio);
  const Complex modulus = weighted_loads(specimen, network, laws, state, unit) / deflection;
  // the modulus of a column with the height and the section of the beam is force·height/(section·displacement)
  const auto reaction = [&](const Stiffness& s) {
    return std::polar(s.e_star_pa, s.phase_deg * std::numbers::pi / 180) * beam.section_area() / beam.gauge_length();
  };
  const Complex force = reaction(state.top);  // per unit displacement of the upper rollers
  out.beam = {deflection / force, 1.0 / force};
  out.stiffness = magnitude_and_phase(modulus);
  out.bottom = magnitude_and_phase(modulus * reaction(state.bottom) / force);
  out.poisson_ratio.reset();  // the sides of a bent beam have no uniform strain
  out.parts = {};
}

}  // namespace macadam
