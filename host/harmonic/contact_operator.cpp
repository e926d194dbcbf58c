// SPDX-License-Identifier: GPL-3.0-or-later
// contact_operator.cpp  Computes the complex load of a contact: the kinematics have real coefficients and are applied
// to real and imaginary parts separately.
#include "host/harmonic/contact_operator.hpp"

#include <algorithm>
#include <cmath>

#include "host/harmonic/cell_pressure.hpp"
#include "host/harmonic/law_stiffness.hpp"
#include "kernels/harmonic/contact_end.hpp"
#include "kernels/base/parallel.hpp"

namespace macadam::harmonic {

PairStiffness pair_stiffness(const LawTable& laws, Complex s) {
  PairStiffness out;
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (!laws[pair]) continue;
    with_stiffness<void>(static_cast<PairType>(pair), *laws[pair], [&](const auto& law) {
      out.k[pair] = law.stiffness(s);
      out.alpha[pair] = law.alpha;
    });
  }
  return out;
}

namespace {

/// Returns the six relative displacements of a contact. `a` and `b` are the motions of its two ends (six numbers each);
/// `b` is nullptr for a wall, which moves by `wall`.
std::array<Complex, 6> relative_motion(const Contact& c, const Complex* a, const Complex* b, const WallMotion& wall) {
  const WallMotion::Rigid at_wall = b ? WallMotion::Rigid{} : wall.at(c);
  std::array<Complex, 6> out;
  const auto rates = [&](auto part, const WallMotion::Rigid& of_wall, auto&& set) {
    const auto twist = [&](const Complex* x) -> kernels::Twist<double> {
      if (!x) return {of_wall.displacement, of_wall.rotation};
      return {{part(x[0]), part(x[1]), part(x[2])}, {part(x[3]), part(x[4]), part(x[5])}};
    };
    const auto u = kernels::relative_displacements(c, twist(a), twist(b));
    for (std::size_t i = 0; i < 6; ++i) set(out[i], u[i]);
  };
  rates([](Complex z) { return z.real(); }, at_wall, [](Complex& z, double v) { z.real(v); });
  rates([](Complex z) { return z.imag(); }, {}, [](Complex& z, double v) { z.imag(v); });
  return out;
}

}  // namespace

std::array<Complex, 2> contact_stiffness(const Contact& c, const PairStiffness& stiffness) {
  const auto pair = static_cast<std::size_t>(c.pair);
  const Complex k = stiffness.k[pair];
  return {kernels::in_series(k, c.series), kernels::in_series(k, stiffness.alpha[pair] * c.series)};
}

double length(const Vector& x) {
  return std::sqrt(sum_in_parallel<double>(x.size(), [&](std::size_t i) { return std::norm(x[i]); }));
}

double length(const Loads& loads) {
  double squares = 0;
  for (const ParticleLoad& l : loads) {
    for (const Complex& z : l.load) squares += std::norm(z);
  }
  return std::sqrt(squares);
}

std::array<Complex, 6> relative_motion(const Contact& c, const Vector& motion, const WallMotion& wall) {
  const auto of = [&](std::int32_t end) { return end >= 0 ? &motion[6 * static_cast<std::size_t>(end)] : nullptr; };
  return relative_motion(c, of(c.a), of(c.b), wall);
}

kernels::FacetLoad<Complex> facet_load(const Contact& c, const PairStiffness& stiffness,
                                       const std::array<Complex, 6>& u) {
  const auto pair = static_cast<std::size_t>(c.pair);
  Complex density[6], m[6];
  double real[6];
  const auto k = contact_stiffness(c, stiffness);
  kernels::moments_over_length(c, real);
  for (std::size_t i = 0; i < 6; ++i) density[i] = k[i / 3] * u[i], m[i] = real[i];
  return kernels::condensed_load(density, Complex(stiffness.alpha[pair]), m);
}

ContactOperator::Load ContactOperator::contact_load(const Contact& c, const PairStiffness& stiffness,
                                                    const std::array<Complex, 6>& u) {
  const kernels::FacetLoad<Complex> f = facet_load(c, stiffness, u);
  Load load;
  const auto part = [&](auto&& of, auto&& set) {
    const auto at = kernels::to_centres(
        kernels::initial_placement(c),
        kernels::FacetLoad<double>{of(f.n), of(f.s), of(f.t), of(f.moment_n), of(f.moment_s), of(f.moment_t)});
    const double on_a[6] = {at.force_a.x, at.force_a.y, at.force_a.z, at.moment_a.x, at.moment_a.y, at.moment_a.z};
    const double on_b[6] = {-at.force_a.x, -at.force_a.y, -at.force_a.z, at.moment_b.x, at.moment_b.y, at.moment_b.z};
    for (int i = 0; i < 6; ++i) set(load.a[i], on_a[i]), set(load.b[i], on_b[i]);
  };
  part([](Complex z) { return z.real(); }, [](Complex& z, double v) { z.real(v); });
  part([](Complex z) { return z.imag(); }, [](Complex& z, double v) { z.imag(v); });
  return load;
}

ContactOperator::ContactOperator(const ContactNetwork& network, std::size_t particles)
    : network_(network), particles_(particles) {
  constexpr std::size_t piece = 1 << 16;
  const std::size_t contacts = network.contacts.size();
  std::vector<std::array<std::vector<std::uint32_t>, 2>> found((contacts + piece - 1) / piece);
  for_each_in_parallel(found.size(), [&](std::size_t k) {
    for (std::size_t c = k * piece; c < std::min(contacts, (k + 1) * piece); ++c) {
      const std::int32_t b = network.contacts[c].b;
      if (b == wall_z_lo || b == wall_z_hi) found[k][b == wall_z_hi].push_back(static_cast<std::uint32_t>(c));
    }
  });
  for (const auto& [bottom, top] : found) {
    on_bottom_.insert(on_bottom_.end(), bottom.begin(), bottom.end());
    on_top_.insert(on_top_.end(), top.begin(), top.end());
  }
  // wall_loads() needs the contacts of one particle side by side; a network that the caller made may have another order
  std::stable_sort(on_top_.begin(), on_top_.end(),
                   [&](std::uint32_t x, std::uint32_t y) { return network.contacts[x].a < network.contacts[y].a; });
}

Loads ContactOperator::wall_loads(const PairStiffness& stiffness, const WallMotion& wall) const {
  const Complex rest[6] = {};
  if (!network_.cells.empty()) return wall_loads_of_cells(stiffness, wall);
  Loads out;
  for (const std::uint32_t number : on_top_) {
    const Contact& c = network_.contacts[number];
    const Load load = contact_load(c, stiffness, relative_motion(c, rest, nullptr, wall));
    if (out.empty() || out.back().particle != c.a) out.push_back({c.a, {}});
    for (std::size_t k = 0; k < 6; ++k) out.back().load[k] += load.a[k];
  }
  return out;
}

Loads ContactOperator::wall_loads_of_cells(const PairStiffness& stiffness, const WallMotion& wall) const {
  const Vector at_rest(6 * particles_);
  const Vector pressures = cell_pressures(network_, stiffness, at_rest, wall);
  Loads out;
  for (std::size_t i = 0; i < particles_; ++i) {
    const auto load = load_on(i, stiffness, at_rest, wall, pressures);
    if (std::any_of(load.begin(), load.end(), [](const Complex& z) { return z != 0.0; }))
      out.push_back({static_cast<std::int32_t>(i), load});
  }
  return out;
}

std::array<Complex, 6> ContactOperator::load_on(std::size_t particle, const PairStiffness& stiffness,
                                                const Vector& motion, const WallMotion& wall,
                                                const Vector& pressures) const {
  std::array<Complex, 6> out{};
  for (const std::uint32_t number : network_.row(particle)) {
    const Contact& c = network_.contacts[number];
    std::array<Complex, 6> u = relative_motion(c, motion, wall);
    add_pressure_shift(c, pressures, u);
    const Load load = contact_load(c, stiffness, u);
    const bool is_a = static_cast<std::size_t>(c.a) == particle;
    for (std::size_t k = 0; k < 6; ++k) out[k] += is_a ? load.a[k] : load.b[k];
  }
  return out;
}

void ContactOperator::resistance(const PairStiffness& stiffness, Complex factor, const Inertia& inertia,
                                 const Vector& motion, Vector& out) const {
  out.resize(6 * particles_);
  const WallMotion at_rest = WallMotion::at_rest();
  const Vector pressures = cell_pressures(network_, stiffness, motion, at_rest);
// dynamic, because large particles have hundreds of contacts each and have consecutive numbers
#pragma omp parallel for schedule(dynamic, 64)
  for (std::size_t i = 0; i < particles_; ++i) {
    const auto load = load_on(i, stiffness, motion, at_rest, pressures);
    for (std::size_t k = 0; k < 6; ++k) {
      out[6 * i + k] = -load[k] - factor * inertia_at(inertia, 6 * i + k) * motion[6 * i + k];
    }
  }
}

Complex ContactOperator::bottom_load(const PairStiffness& stiffness, const Vector& motion,
                                     const WallMotion& wall) const {
  Complex out = 0;
  const Vector pressures = cell_pressures(network_, stiffness, motion, wall);
  for (const std::uint32_t c : on_bottom_) {
    const Contact& contact = network_.contacts[c];
    std::array<Complex, 6> u = relative_motion(contact, motion, wall);
    add_pressure_shift(contact, pressures, u);
    // the work of the load in a rigid motion of the particle with the top wall, per unit of this motion
    const Load load = contact_load(contact, stiffness, u);
    const WallMotion::Rigid moved = wall.of_particle(contact);
    out += load.a[0] * moved.displacement.x + load.a[1] * moved.displacement.y + load.a[2] * moved.displacement.z +
           load.a[3] * moved.rotation.x + load.a[4] * moved.rotation.y + load.a[5] * moved.rotation.z;
  }
  return out;
}

}  // namespace macadam::harmonic
