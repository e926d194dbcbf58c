// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reference_bilinear.hpp  The complex stiffness of a network at one frequency, assembled from the matrices of
/// the reference implementation. Tests check the motions of the harmonic solver with it.
#pragma once

#include <complex>
#include <numbers>

#include "host/reference/reference_stiffness.hpp"
#include "tests/support/test_scenes.hpp"

namespace macadam::test {

using Complex = std::complex<double>;

/// Returns the complex stiffness k*(ω) of a law. A chain has springs and dashpots in series, so their compliances add.
inline Complex chain_stiffness(const Law& law, double omega) {
  if (const auto* elastic = std::get_if<laws::Elastic>(&law)) return elastic->E;
  const auto& chain = std::get<laws::GeneralisedKelvin>(law);
  Complex compliance = 1 / chain.E_m + 1.0 / (Complex(0, omega) * chain.C_m);
  for (std::size_t l = 0; l < chain.E.size(); ++l) compliance += 1.0 / (chain.E[l] + Complex(0, omega) * chain.C[l]);
  return 1.0 / compliance;
}

/// The bilinear form a(u, v) = uᵀ·K·v − p·(u + v) + k, for motions under a unit displacement of the top wall. The
/// reaction of that wall is k − p·u. If u is in equilibrium (K·u = p), a(u, v) is that reaction for every v; therefore
/// a small error of u has only a second-order effect on a(u, u).
struct BilinearForm {
  Eigen::SparseMatrix<Complex> K;  ///< stiffness of the particles; entries in N/m, N and N·m
  Eigen::VectorXcd p;
  Complex k = 0;

  Complex operator()(const Eigen::VectorXcd& u, const Eigen::VectorXcd& v) const {
    const Eigen::VectorXcd Kv = K * v;
    return (u.transpose() * Kv)(0) - (p.transpose() * (u + v))(0) + k;
  }
};

inline BilinearForm bilinear_form(const ContactNetwork& network, const Laws& laws, std::size_t particles,
                                  double frequency) {
  const auto size = static_cast<Eigen::Index>(6 * particles);
  BilinearForm out{Eigen::SparseMatrix<Complex>(size, size), Eigen::VectorXcd::Zero(size)};
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (!laws[pair]) continue;
    ContactNetwork part = network;
    std::erase_if(part.contacts, [&](const Contact& c) { return c.pair != static_cast<PairType>(pair); });
    if (part.contacts.empty()) continue;
    Laws unit;
    unit[pair] = laws::Elastic{1, std::visit([](const auto& law) { return law.alpha; }, *laws[pair])};
    const reference::Stiffness s = reference::assemble_stiffness(part, unit, particles);
    const Complex stiffness = chain_stiffness(*laws[pair], 2 * std::numbers::pi * frequency);
    out.K += s.K.cast<Complex>() * stiffness;
    out.p += s.top_wall * stiffness;
    out.k += s.top_stiffness * stiffness;
  }
  return out;
}

/// Returns HarmonicResult::motion as a vector.
inline Eigen::VectorXcd motion_of(const HarmonicResult& result) {
  return Eigen::Map<const Eigen::VectorXcd>(result.motion.data(), static_cast<Eigen::Index>(result.motion.size()));
}

/// Returns E* [Pa] of a reaction per unit displacement [N/m].
inline Complex modulus_of(const Complex& reaction, const Box& box) {
  return reaction * box.size.z / (box.size.x * box.size.y);
}
inline Complex complex_of(const Stiffness& stiffness) {
  return std::polar(stiffness.e_star_pa, stiffness.phase_deg * std::numbers::pi / 180);
}

}  // namespace macadam::test
