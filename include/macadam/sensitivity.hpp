// SPDX-License-Identifier: GPL-3.0-or-later
/// \file sensitivity.hpp  Derivatives of E* by its parameters, from one solution of the frequency domain:
/// docs/model.md, section 16.
///
/// E* = H/A · uᵀ·(K*(s) − inertia·M)·u at unit displacement of the top wall is stationary in u, so that
/// dE*/dθ = H/A · uᵀ·(∂K*/∂θ)·u: one sum over the contacts of the solution at hand.
#pragma once

#include <array>
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "macadam/contact_network.hpp"
#include "macadam/laws/all.hpp"

namespace macadam {

/// The parts of which E* is the sum [Pa], without conjugates.
struct ModulusParts {
  std::array<std::complex<double>, pair_types> normal{};  ///< by PairType: opening and bending
  std::array<std::complex<double>, pair_types> shear{};   ///< slip and twist, α included
  std::complex<double> inertia = 0;                       ///< (s² + s·β)·density scaling · uᵀ·M·u

  std::complex<double> modulus() const;
};

/// Change of |E*| and φ per unit of a parameter's natural logarithm: a hundredth of it for one per cent.
struct Sensitivity {
  std::string parameter;  ///< "M-A.E_m", "M-A.delta", "M-A.alpha", "density_scaling"
  double d_e_star_pa = 0, d_phase_deg = 0;
};

/// By every parameter of every pair that is there, δ and α (where it is not 0), and the density scaling where there is
/// inertia, for motions as e^(s·t). δ multiplies all moduli and viscosities of a pair.
std::vector<Sensitivity> sensitivities(const ModulusParts& parts, const LawTable& laws, std::complex<double> s);
std::vector<Sensitivity> sensitivities(const ModulusParts&, const LawTable&,
                                       double) = delete;  // s = iω, not ω

/// The share of E* that each pair carries, by PairType: its part along E*, over |E*|. Without inertia they add up to 1.
std::array<double, pair_types> shares(const ModulusParts& parts);

}  // namespace macadam
