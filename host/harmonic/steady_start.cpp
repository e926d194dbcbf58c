// SPDX-License-Identifier: GPL-3.0-or-later
// steady_start.cpp  Computes the state in which a stepped run begins, from a complex motion (model (18.1)):
// displacements and contact states one step before t = 0, and velocities half a step before t = 0.
#include <numbers>

#include "host/harmonic/contact_operator.hpp"
#include "host/harmonic/law_stiffness.hpp"

namespace macadam {

using namespace harmonic;

StartState steady_start(const ContactNetwork& network, const LawTable& laws,
                        const std::vector<std::complex<double>>& motion, const drives::Cyclic& loading) {
  const double omega = 2 * std::numbers::pi * loading.frequency, dt = loading.dt();
  // The wall moves by −A·sin ωt = Im(−A·e^{iωt}). A particle moves by Im(−A·z·e^{iωt}), where z is its part of
  // `motion`.
  const Complex before = -loading.amplitude * std::polar(1.0, -omega * dt);
  const Complex rate =
      -loading.amplitude * Complex(2 * std::pow(std::sin(omega * dt / 2), 2), std::sin(omega * dt)) / dt;
  const Complex s(0, omega);
  StartState out;
  const std::size_t particles = motion.size() / 6;
  for (std::size_t i = 0; i < particles; ++i) {
    const Complex* m = &motion[6 * i];
    const auto vector = [](Complex factor, const Complex* three) {
      return Vec3d{(factor * three[0]).imag(), (factor * three[1]).imag(), (factor * three[2]).imag()};
    };
    out.displacement.push_back(vector(before, m));
    out.rotation.push_back(vector(before, m + 3));
    out.velocity.push_back(vector(rate, m));
    out.spin.push_back(vector(rate, m + 3));
  }
  PairStiffness of_pairs;  // computed here, because pair_stiffness() rounds quotients of complex numbers differently
  std::array<std::vector<Complex>, pair_types> unit_compliance;
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (!laws[pair]) continue;
    with_stiffness<void>(static_cast<PairType>(pair), *laws[pair], [&](const auto& law) {
      of_pairs.k[pair] = law.stiffness(s), of_pairs.alpha[pair] = law.alpha;
      for (int l = 0; l < law.units(); ++l) unit_compliance[pair].push_back(law.unit_compliance(l, s));
    });
  }
  std::size_t numbers = 0;
  for (const Contact& c : network.contacts) {
    out.chain_begin.push_back(numbers);
    numbers += 6 * (1 + unit_compliance[static_cast<std::size_t>(c.pair)].size());
  }
  out.chain.resize(numbers);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < network.contacts.size(); ++i) {
    const Contact& c = network.contacts[i];
    double* chain = &out.chain[out.chain_begin[i]];
    const auto stiffness = contact_stiffness(c, of_pairs);
    const std::array<Complex, 2> force{before * stiffness[0], before * stiffness[1]};  // per relative displacement
    const auto motions = relative_motion(c, motion, WallMotion{});
    for (std::size_t component = 0; component < motions.size(); ++component) {
      const Complex f = force[component / 3] * motions[component];
      *chain++ = f.imag();
      for (const Complex& unit : unit_compliance[static_cast<std::size_t>(c.pair)]) *chain++ = (f * unit).imag();
    }
  }
  return out;
}

}  // namespace macadam
