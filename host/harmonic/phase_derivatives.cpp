// SPDX-License-Identifier: GPL-3.0-or-later
// phase_derivatives.cpp  Computes derivatives of E* at constant motion, by which E* is stationary.
//
// uᵀ·K·u = Σ F·u + Σ P²/q over contacts and cells: F is the force of a contact's springs, P the pressure of a cell, q
// its weight over the modulus of its phase, and P/q the sum of F·(x_f − x) over the contacts of the cell. If the
// stiffness of a contact changes by the fraction g, F changes by g·F, and uᵀ·K·u by g·(F·u + 2·F·v), where v is the
// additional displacement that the pressures cause. If q changes by the fraction g, uᵀ·K·u changes by g·P²/q.
//
// ModulusParts contains the sums of (F + F(v))·u = F·u + F·v of each pair type, so that only F·v is added here. A
// contact has the compliance length/k + length·series. The first term follows the mastic, the second one the rock.
#include "host/harmonic/phase_derivatives.hpp"

#include <algorithm>

#include "host/harmonic/cell_pressure.hpp"
#include "kernels/base/parallel.hpp"

namespace macadam::harmonic {
namespace {

/// Sums over the contacts of a pair type: products in normal and in shear direction, and their parts that follow the
/// rock in series.
struct PairParts {
  Complex normal = 0, shear = 0, normal_rock = 0, shear_rock = 0;

  Complex rock() const { return normal_rock + shear_rock; }
  Complex law() const { return normal + shear - rock(); }
  void operator+=(const PairParts& o) {
    normal += o.normal, shear += o.shear, normal_rock += o.normal_rock, shear_rock += o.shear_rock;
  }
};

struct ProductsOfPairs : std::array<PairParts, pair_types> {
  void operator+=(const ProductsOfPairs& o) {
    for (std::size_t pair = 0; pair < pair_types; ++pair) (*this)[pair] += o[pair];
  }
};

/// Returns F·v of each pair type.
ProductsOfPairs products_with_pressures(const ContactNetwork& network, const PairStiffness& stiffness,
                                        const Vector& motion, const WallMotion& wall, const Vector& pressures) {
  constexpr std::size_t range = 1 << 12;  // number of contacts that one thread sums at a time
  const std::size_t contacts = network.contacts.size(), ranges = (contacts + range - 1) / range;
  std::vector<ProductsOfPairs> sums(ranges);
  for_each_in_parallel(ranges, [&](std::size_t k) {
    for (std::size_t i = k * range; i < std::min(contacts, (k + 1) * range); ++i) {
      const Contact& c = network.contacts[i];
      const auto pair = static_cast<std::size_t>(c.pair);
      const auto load = facet_load(c, stiffness, relative_motion(c, motion, wall));
      const auto v = pressure_shift(c, pressures);
      const auto of_contact = contact_stiffness(c, stiffness);
      const Complex normal = load.n * v[0], shear = load.s * v[1] + load.t * v[2];
      sums[k][pair] +=
          {normal, shear, c.series * of_contact[0] * normal, stiffness.alpha[pair] * c.series * of_contact[1] * shear};
    }
  });
  ProductsOfPairs out;
  for (const ProductsOfPairs& s : sums) out += s;
  return out;
}

/// Sums over the cells of the two phases.
struct CellSums {
  Complex mastic = 0, rock = 0;                        ///< Σ P²/q
  Complex mastic_by_poisson = 0, rock_by_poisson = 0;  ///< Σ P²/q·∂ln(weight)/∂ln ν
};

CellSums sums_over_cells(const ContactNetwork& network, const PairStiffness& stiffness, const Vector& pressures) {
  CellSums out;
  for (std::size_t i = 0; i < pressures.size(); ++i) {
    const CellStiffness& cell = network.cells[i];
    if (cell.weight == 0) continue;
    const bool mastic = cell.law == PairType::mm;
    const double nu = mastic ? network.mastic_poisson_ratio : network.rock_poisson_ratio;
    const Complex square = pressures[i] * pressures[i] * stiffness.k[static_cast<std::size_t>(cell.law)] / cell.weight;
    // weight = r·(1 + ν)/(V + r·Σ A·h) with r = ν/(1 − 2ν), so ∂ln r/∂ln ν = 1/(1 − 2ν)
    const double by_poisson = nu / (1 + nu) + cell.reduction / (1 - 2 * nu);
    (mastic ? out.mastic : out.rock) += square;
    (mastic ? out.mastic_by_poisson : out.rock_by_poisson) += by_poisson * square;
  }
  return out;
}

}  // namespace

void add_phase_derivatives(const ContactNetwork& network, const PairStiffness& stiffness, const Vector& motion,
                           const WallMotion& wall, const Vector& pressures, ModulusParts& parts) {
  if (!has_laws_of_phases(network.rule)) return;
  ProductsOfPairs products;
  parts.pressure_of_mastic = 0;
  if (!pressures.empty()) {
    products = products_with_pressures(network, stiffness, motion, wall, pressures);
    for (std::size_t pair = 0; pair < pair_types; ++pair)
      if (is_of_mastic(static_cast<PairType>(pair))) parts.pressure_of_mastic += products[pair].law();
  }
  for (std::size_t pair = 0; pair < pair_types; ++pair)
    products[pair] += {parts.normal[pair], parts.shear[pair], parts.normal_rock[pair], parts.shear_rock[pair]};
  const CellSums cells = sums_over_cells(network, stiffness, pressures);
  parts.pressure_of_mastic -= cells.mastic;

  // A length is proportional to 2μ/E = 1/(1 + ν) with the rule "volumetric", and does not depend on ν with the rule
  // "series". The thickness of a film in opening is always proportional to E/(λ + 2μ), and in slip to E/2μ.
  const bool volumetric = network.rule == ContactRule::volumetric;
  const double nu = network.mastic_poisson_ratio, by_shear = 1 / (1 + nu),
               by_opening = 1 / (1 + nu) - 2 / (1 - 2 * nu) + 1 / (1 - nu);
  Complex mastic = 0, rock = 0;  // minus the derivatives with respect to ν
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    const PairParts& p = products[pair];
    if (static_cast<PairType>(pair) == PairType::aa)
      mastic += by_opening * (p.normal - p.normal_rock) + by_shear * (p.shear - p.shear_rock);
    else if (volumetric && is_of_mastic(static_cast<PairType>(pair)))
      mastic += by_shear * p.law();
    if (volumetric)
      rock += (is_of_mastic(static_cast<PairType>(pair)) ? p.rock() : p.law()) / (1 + network.rock_poisson_ratio);
  }
  parts.mastic_poisson_ratio = cells.mastic_by_poisson - nu * mastic;
  parts.rock_poisson_ratio = cells.rock_by_poisson - network.rock_poisson_ratio * rock;
}

}  // namespace macadam::harmonic
