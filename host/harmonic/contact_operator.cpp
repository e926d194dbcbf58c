// SPDX-License-Identifier: GPL-3.0-or-later
// contact_operator.cpp  A contact's complex load: its real kinematics on real and imaginary parts, times k*(ω).
#include "host/harmonic/contact_operator.hpp"

#include <algorithm>

#include "kernels/contact_kinematics.hpp"

namespace macadam::harmonic {

using kernels::Placement;
using kernels::Twist;

PairStiffness pair_stiffness(const std::array<std::optional<Law>, pair_types>& laws, double omega) {
  PairStiffness out;
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (!laws[pair]) continue;
    out.k[pair] = std::visit([&](const auto& law) { return law.stiffness(omega); }, *laws[pair]);
    out.alpha[pair] = std::visit([](const auto& law) { return law.alpha; }, *laws[pair]);
  }
  return out;
}

namespace {

Placement<double> placement_of(const Contact& c) { return {c.n, c.s, c.t, c.arm_a, c.arm_b}; }

std::array<double, 6> moments_over_distance(const Contact& c) {
  return {c.moments.a / c.distance,  c.moments.s / c.distance,  c.moments.t / c.distance,
          c.moments.ss / c.distance, c.moments.st / c.distance, c.moments.tt / c.distance};
}

}  // namespace

std::array<Complex, 6> relative_motion(const Contact& c, const Vector& motion, Complex wall) {
  const auto twist = [&](std::int32_t end, auto part) -> Twist<double> {
    if (end >= 0) {
      const Complex* x = &motion[6 * static_cast<std::size_t>(end)];
      return {{part(x[0]), part(x[1]), part(x[2])}, {part(x[3]), part(x[4]), part(x[5])}};
    }
    return {{0, 0, end == wall_z_hi ? part(wall) : 0.0}, {}};
  };
  const auto rates = [&](double(&u)[6], auto part) {
    kernels::relative_rates(placement_of(c), twist(c.a, part), twist(c.b, part), u);
  };
  double real[6], imag[6];
  rates(real, [](Complex z) { return z.real(); });
  rates(imag, [](Complex z) { return z.imag(); });
  std::array<Complex, 6> out;
  for (std::size_t i = 0; i < 6; ++i) out[i] = {real[i], imag[i]};
  return out;
}

ContactOperator::Load ContactOperator::contact_load(const Contact& c, const PairStiffness& stiffness,
                                                    const Vector& motion, Complex wall) const {
  const std::array<Complex, 6> u = relative_motion(c, motion, wall);
  const Placement<double> placement = placement_of(c);
  const std::array<double, 6> moments = moments_over_distance(c);
  double m[6];
  std::copy(moments.begin(), moments.end(), m);
  const auto pair = static_cast<std::size_t>(c.pair);
  const Complex k = stiffness.k[pair];
  Load load{};
  for (int part = 0; part < 2; ++part) {
    double f[6];
    for (std::size_t i = 0; i < 6; ++i) {
      const Complex density = k * u[i];
      f[i] = part == 0 ? density.real() : density.imag();
    }
    const auto at = kernels::to_centres(placement, kernels::condensed_load(f, stiffness.alpha[pair], m));
    const double on_a[6] = {at.force_a.x, at.force_a.y, at.force_a.z, at.moment_a.x, at.moment_a.y, at.moment_a.z};
    const double on_b[6] = {-at.force_a.x, -at.force_a.y, -at.force_a.z, at.moment_b.x, at.moment_b.y, at.moment_b.z};
    const Complex unit = part == 0 ? Complex(1, 0) : Complex(0, 1);
    for (int i = 0; i < 6; ++i) {
      load.a[i] += unit * on_a[i];
      load.b[i] += unit * on_b[i];
    }
  }
  return load;
}

void ContactOperator::forces(const PairStiffness& stiffness, const Vector& motion, Complex wall, Vector& out) const {
  const auto contacts = static_cast<std::int64_t>(network_.contacts.size());
  loads_.resize(network_.contacts.size());
#pragma omp parallel for schedule(static)
  for (std::int64_t i = 0; i < contacts; ++i) {
    const auto c = static_cast<std::size_t>(i);
    loads_[c] = contact_load(network_.contacts[c], stiffness, motion, wall);
  }
  out.assign(6 * particles_, 0);
#pragma omp parallel for schedule(static)
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(particles_); ++i) {
    for (const std::uint32_t c : network_.row(static_cast<std::size_t>(i))) {
      const Complex* load = network_.contacts[c].a == i ? loads_[c].a : loads_[c].b;
      for (int k = 0; k < 6; ++k) out[6 * static_cast<std::size_t>(i) + static_cast<std::size_t>(k)] += load[k];
    }
  }
}

void ContactOperator::resistance(const PairStiffness& stiffness, Complex factor, const Inertia& inertia,
                                 const Vector& motion, Vector& out) const {
  forces(stiffness, motion, 0.0, out);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = -out[i] - factor * inertia_at(inertia, i) * motion[i];
}

ModulusParts ContactOperator::energy_parts(const PairStiffness& stiffness, const Vector& motion, Complex wall) const {
  const auto& contacts = network_.contacts;
  std::vector<std::array<Complex, 2>> share(contacts.size());  // normal and shear
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact& c = contacts[i];
    const auto pair = static_cast<std::size_t>(c.pair);
    const std::array<Complex, 6> u = relative_motion(c, motion, wall);
    Complex density[6];
    for (std::size_t k = 0; k < 6; ++k) density[k] = stiffness.k[pair] * u[k];
    const std::array<double, 6> real = moments_over_distance(c);
    const Complex alpha = stiffness.alpha[pair], m[6] = {real[0], real[1], real[2], real[3], real[4], real[5]};
    const kernels::FacetLoad<Complex> load = kernels::condensed_load(density, alpha, m);
    share[i] = {load.n * u[0] - load.moment_t * u[1] + load.moment_s * u[2],
                load.s * u[3] + load.t * u[4] + load.moment_n * u[5]};
  }
  ModulusParts out;
  for (std::size_t i = 0; i < contacts.size(); ++i) {  // in order: the same bits for any number of threads
    const auto pair = static_cast<std::size_t>(contacts[i].pair);
    out.normal[pair] += share[i][0];
    out.shear[pair] += share[i][1];
  }
  return out;
}

Complex ContactOperator::bottom_force(const PairStiffness& stiffness, const Vector& motion) const {
  Complex out = 0;
  for (const Contact& c : network_.contacts) {
    if (c.b == wall_z_lo) out += contact_load(c, stiffness, motion, 0.0).a[2];
  }
  return out;
}

}  // namespace macadam::harmonic
