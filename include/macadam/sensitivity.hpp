// SPDX-License-Identifier: GPL-3.0-or-later
/// \file sensitivity.hpp  Computes the derivatives of E* with respect to the parameters of a scene, from one solution
/// of the frequency domain: docs/model.md, section 16.
///
/// E* = H/A · uᵀ·(K*(s) − inertia·M)·u at unit displacement of the top wall is stationary in u. Therefore dE*/dθ = H/A
/// · uᵀ·(∂K*/∂θ)·u, which is one sum over the contacts.
#pragma once

#include <array>
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "macadam/contact_network.hpp"
#include "macadam/laws/all.hpp"

namespace macadam {

/// The parts whose sum is E* [Pa]. They are products of complex vectors, uᵀ·K·u, without complex conjugation.
struct ModulusParts {
  std::array<std::complex<double>, pair_types> normal{};  ///< by PairType: opening and bending
  std::array<std::complex<double>, pair_types> shear{};   ///< slip and twist, α included
  /// The part of `normal` and of `shear` by which E* follows the rock in series with the laws (Contact::series): a
  /// change of the rock's modulus by one per cent changes E* by a hundredth of it. Zero without such rock.
  std::array<std::complex<double>, pair_types> normal_rock{}, shear_rock{};
  /// With the rule "volumetric": contribution of the pressures of cells to the derivative of E* with respect to the
  /// logarithm of the mastic's stiffness. The derivative for the rock has the opposite contribution. It is not a part
  /// of the sum E*.
  std::complex<double> pressure_of_mastic = 0;
  /// With laws of phases: derivatives of E* with respect to the logarithms of the two Poisson's ratios. They are not
  /// parts of the sum E*. With the rule "series" only films between two aggregates depend on the mastic's ratio, and
  /// nothing depends on the rock's.
  std::complex<double> mastic_poisson_ratio = 0, rock_poisson_ratio = 0;
  std::complex<double> inertia = 0;  ///< (s² + s·β)·density scaling · uᵀ·M·u

  std::complex<double> modulus() const;
};

/// Change of |E*| and φ per unit of a parameter's natural logarithm. A change of the parameter by one per cent changes
/// |E*| and φ by a hundredth of these values.
struct Sensitivity {
  /// "M-A.E_m", "M-A.delta", "M-A.alpha", "rock.E", "density_scaling"; of phases "mastic.E_m", "aggregate.E",
  /// "mastic.poisson_ratio", "aggregate.poisson_ratio"
  std::string parameter;
  double d_e_star_pa = 0, d_phase_deg = 0;
};

/// Returns the derivatives of |E*| and φ for motions e^(s·t). They are taken with respect to every parameter of every
/// pair that is present, to δ and α of these pairs (α only if it is not 0), to the modulus of rock in series with the
/// laws if there is such rock, and to the density scaling if there is inertia. δ multiplies all moduli and viscosities
/// of a pair.
std::vector<Sensitivity> sensitivities(const ModulusParts& parts, const LawTable& laws, std::complex<double> s);
std::vector<Sensitivity> sensitivities(const ModulusParts&, const LawTable&,
                                       double) = delete;  // deleted, so that ω cannot be passed instead of s = iω

/// Returns the derivatives of |E*| and φ for motions e^(s·t) in a network with one law for each phase (rules "series"
/// and "volumetric"). They are taken with respect to every parameter of the mastic's law ("mastic.E_m"), which all
/// pairs with mastic share, to the modulus of the rock ("aggregate.E"), to the Poisson's ratios of both phases if E*
/// depends on them, and to the density scaling if there is inertia. Derivatives with respect to moduli and viscosities
/// are at constant Poisson's ratios.
std::vector<Sensitivity> phase_sensitivities(const ModulusParts& parts, const LawTable& laws, std::complex<double> s);
std::vector<Sensitivity> phase_sensitivities(const ModulusParts&, const LawTable&,
                                             double) = delete;  // deleted, so that ω cannot be passed instead of s = iω

/// Returns whether a pair has the law of the mastic in a network with one law for each phase. The other pairs have the
/// law of the rock.
constexpr bool is_of_mastic(PairType pair) { return pair != PairType::inner && pair != PairType::aw; }

/// Returns the fraction of E* that each pair carries, by PairType: the component of the pair's part along E* (in the
/// complex plane), divided by |E*|. Without inertia the fractions add up to 1.
std::array<double, pair_types> shares(const ModulusParts& parts);

}  // namespace macadam
