// SPDX-License-Identifier: GPL-3.0-or-later
// sensitivity.cpp  Computes the derivatives of E*, and the fraction of E* that each pair type carries, from the parts
// of E* (model, section 16).
#include "macadam/sensitivity.hpp"

#include <numbers>

#include "host/harmonic/law_stiffness.hpp"

namespace macadam {

using Complex = std::complex<double>;

Complex ModulusParts::modulus() const {
  Complex sum = inertia;
  for (std::size_t pair = 0; pair < pair_types; ++pair) sum += normal[pair] + shear[pair];
  return sum;
}

namespace {

/// Returns the sensitivity to a parameter, whose logarithm changes E* by `change`: d|E| = |E|·Re(dE/E), dφ = Im(dE/E).
Sensitivity sensitivity_of(std::string parameter, Complex change, Complex modulus) {
  const Complex relative = change / modulus;
  return {std::move(parameter), std::abs(modulus) * relative.real(), relative.imag() * 180 / std::numbers::pi};
}

}  // namespace

std::vector<Sensitivity> sensitivities(const ModulusParts& parts, const LawTable& laws, Complex s) {
  const Complex modulus = parts.modulus();
  std::vector<Sensitivity> out;
  const auto add = [&](std::string parameter, Complex change) {
    out.push_back(sensitivity_of(std::move(parameter), change, modulus));
  };
  Complex all_rock = 0;
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    const Complex rock = parts.normal_rock[pair] + parts.shear_rock[pair],
                  whole = parts.normal[pair] + parts.shear[pair] - rock;
    all_rock += rock;
    if (!laws[pair] || whole == 0.0) continue;
    const std::string prefix = std::string(to_string(static_cast<PairType>(pair))) + ".";
    with_stiffness<void>(static_cast<PairType>(pair), *laws[pair], [&](const auto& law) {
      law.each_parameter(s, [&](const std::string& name, Complex change) { add(prefix + name, whole * change); });
      if (law.alpha != 0) add(prefix + "alpha", parts.shear[pair] - parts.shear_rock[pair]);
    });
    add(prefix + "delta", whole);
  }
  if (all_rock != 0.0) add("rock.E", all_rock);
  if (parts.inertia != 0.0) add("density_scaling", parts.inertia);
  return out;
}

std::vector<Sensitivity> phase_sensitivities(const ModulusParts& parts, const LawTable& laws, Complex s) {
  const Complex modulus = parts.modulus();
  // A factor on all stiffnesses of the mastic changes E* by `mastic` times the change of the factor's logarithm.
  Complex mastic = 0, rock = 0;
  const Law* law_of_mastic = nullptr;
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    const Complex whole = parts.normal[pair] + parts.shear[pair],
                  in_series = parts.normal_rock[pair] + parts.shear_rock[pair];
    const bool of_mastic = is_of_mastic(static_cast<PairType>(pair));
    if (of_mastic && laws[pair] && !law_of_mastic) law_of_mastic = &*laws[pair];
    (of_mastic ? mastic : rock) += whole - in_series;
    rock += in_series;
  }
  mastic += parts.pressure_of_mastic, rock -= parts.pressure_of_mastic;
  std::vector<Sensitivity> out;
  if (law_of_mastic && mastic != 0.0) {
    with_stiffness<void>(PairType::mm, *law_of_mastic, [&](const auto& law) {
      law.each_parameter(s, [&](const std::string& name, Complex change) {
        out.push_back(sensitivity_of("mastic." + name, mastic * change, modulus));
      });
    });
  }
  if (rock != 0.0) out.push_back(sensitivity_of("aggregate.E", rock, modulus));
  if (parts.mastic_poisson_ratio != 0.0)
    out.push_back(sensitivity_of("mastic.poisson_ratio", parts.mastic_poisson_ratio, modulus));
  if (parts.rock_poisson_ratio != 0.0)
    out.push_back(sensitivity_of("aggregate.poisson_ratio", parts.rock_poisson_ratio, modulus));
  if (parts.inertia != 0.0) out.push_back(sensitivity_of("density_scaling", parts.inertia, modulus));
  return out;
}

std::array<double, pair_types> shares(const ModulusParts& parts) {
  const Complex modulus = parts.modulus();
  std::array<double, pair_types> out{};
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    out[pair] = ((parts.normal[pair] + parts.shear[pair]) / modulus).real();
  }
  return out;
}

}  // namespace macadam
