// SPDX-License-Identifier: GPL-3.0-or-later
// harmonic_arrays.cpp  Converts a steady state to arrays: real and imaginary parts, amplitudes and phases.
#include <algorithm>
#include <numbers>

#include "host/fields/field_lists.hpp"
#include "host/harmonic/cell_pressure.hpp"
#include "host/harmonic/contact_operator.hpp"
#include "host/harmonic/law_stiffness.hpp"
#include "macadam/fields.hpp"

namespace macadam {
namespace {

using harmonic::Complex;

double degrees(const Complex& z) { return std::arg(z) * 180 / std::numbers::pi; }

/// Adds two arrays to a list: the real and the imaginary parts of the complex numbers of(entry, component).
template <class F>
void add_parts(const std::string& name, const char* unit, std::size_t entries, int components, F&& of,
               std::vector<FieldArray>& out) {
  out.push_back(
      tuples(name + "_real", unit, entries, components, [&](std::size_t i, int k) { return of(i, k).real(); }));
  out.push_back(
      tuples(name + "_imag", unit, entries, components, [&](std::size_t i, int k) { return of(i, k).imag(); }));
}

/// Returns component k (0 to 2: x, y, z) of the vector that has the components n, s and t in the frame of the contact.
Complex component(const Contact& c, const Complex& n, const Complex& s, const Complex& t, int k) {
  double Vec3d::*const axis = k == 0 ? &Vec3d::x : k == 1 ? &Vec3d::y : &Vec3d::z;
  return n * (c.n.*axis) + s * (c.s.*axis) + t * (c.t.*axis);
}

/// Returns, for each pair type, the stretch x_l of each Kelvin unit l per unit of the force density f: x_l = f/(k_l +
/// iω·η_l).
std::array<std::vector<Complex>, pair_types> stretches(const std::array<std::optional<Law>, pair_types>& laws,
                                                       Complex s) {
  std::array<std::vector<Complex>, pair_types> out;
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (!laws[pair]) continue;
    with_stiffness<void>(static_cast<PairType>(pair), *laws[pair], [&](const auto& law) {
      for (int l = 0; l < law.units(); ++l) out[pair].push_back(law.unit_compliance(l, s));
    });
  }
  return out;
}

}  // namespace

std::vector<FieldArray> particle_arrays(const std::vector<Complex>& motion, double amplitude) {
  const std::size_t particles = motion.size() / 6;
  const auto at = [&](std::size_t i, int k) { return amplitude * motion[6 * i + static_cast<std::size_t>(k)]; };
  std::vector<FieldArray> out;
  add_parts("displacement", "m", particles, 3, at, out);
  out.push_back(
      tuples("displacement_amplitude", "m", particles, 3, [&](std::size_t i, int k) { return std::abs(at(i, k)); }));
  out.push_back(
      tuples("displacement_phase", "deg", particles, 3, [&](std::size_t i, int k) { return degrees(at(i, k)); }));
  add_parts(
      "rotation", "rad", particles, 3, [&](std::size_t i, int k) { return at(i, 3 + k); }, out);
  return out;
}

std::vector<FieldArray> contact_arrays(const ContactNetwork& network,
                                       const std::array<std::optional<Law>, pair_types>& laws, double frequency_hz,
                                       const std::vector<Complex>& motion, double amplitude, const WallMotion& wall) {
  const Complex s(0, 2 * std::numbers::pi * frequency_hz);
  const harmonic::PairStiffness stiffness = harmonic::pair_stiffness(laws, s);
  const std::size_t contacts = network.contacts.size();
  // `acting` is `relative` with the additional displacement that pressures of cells cause (rule "volumetric")
  std::vector<std::array<Complex, 6>> relative(contacts), acting(contacts);
  std::vector<kernels::FacetLoad<Complex>> load(contacts);
  const harmonic::Vector pressures = harmonic::cell_pressures(network, stiffness, motion, wall);
#pragma omp parallel for schedule(static)
  for (std::size_t c = 0; c < contacts; ++c) {
    relative[c] = harmonic::relative_motion(network.contacts[c], motion, wall);
    acting[c] = relative[c];
    harmonic::add_pressure_shift(network.contacts[c], pressures, acting[c]);
    for (Complex& x : relative[c]) x *= amplitude;
    for (Complex& x : acting[c]) x *= amplitude;
    load[c] = harmonic::facet_load(network.contacts[c], stiffness, acting[c]);
  }
  std::vector<FieldArray> out;
  const auto scalar = [&](const char* name, const char* unit, auto&& of) {
    out.push_back(tuples(name, unit, contacts, 1, [&](std::size_t c, int) { return of(load[c]); }));
  };
  scalar("normal_force_amplitude", "N", [](const auto& f) { return std::abs(f.n); });
  scalar("normal_force_phase", "deg", [](const auto& f) { return degrees(f.n); });
  scalar("shear_force_amplitude", "N", [](const auto& f) { return std::hypot(std::abs(f.s), std::abs(f.t)); });
  const auto vector = [&](const char* name, const char* unit, auto&& of) {
    add_parts(
        name, unit, contacts, 3, [&](std::size_t c, int k) { return of(network.contacts[c], load[c], k); }, out);
  };
  vector("force", "N", [](const Contact& c, const auto& f, int k) { return component(c, f.n, f.s, f.t, k); });
  vector("moment", "N m",
         [](const Contact& c, const auto& f, int k) { return component(c, f.moment_n, f.moment_s, f.moment_t, k); });
  const auto six = [&](std::size_t c, int k) { return relative[c][static_cast<std::size_t>(k)]; };
  add_parts("relative_displacement", relative_unit, contacts, 6, six, out);
  const auto units = stretches(laws, s);
  const auto of_pair = [&](std::size_t c) -> const auto& {
    return units[static_cast<std::size_t>(network.contacts[c].pair)];
  };
  std::size_t most = 0;
  for (std::size_t c = 0; c < contacts; ++c) most = std::max(most, of_pair(c).size());
  for (std::size_t l = 0; l < most; ++l) {
    const auto stretch = [&](std::size_t c, int k) -> Complex {
      if (l >= of_pair(c).size()) return 0;
      return contact_stiffness(network.contacts[c], stiffness)[k / 3] * of_pair(c)[l] *
             acting[c][static_cast<std::size_t>(k)];
    };
    add_parts("stretch_" + std::to_string(l + 1), relative_unit, contacts, 6, stretch, out);
  }
  return out;
}

}  // namespace macadam
