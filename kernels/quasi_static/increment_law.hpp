// SPDX-License-Identifier: GPL-3.0-or-later
/// \file increment_law.hpp  Holds the law of a pair type in a quasi-static increment, in a form that CPU and devices
/// (GPUs) read.
#pragma once

#include <algorithm>

#include "macadam/laws/cracked.hpp"

namespace macadam::kernels {

/// The law of a pair type in increments of one length, with the constants of which energies are computed. Elastic laws
/// are chains without dashpots.
struct IncrementLaw {
  using Chain = laws::GeneralisedKelvin;
  using CrackedChain = laws::Cracked<Chain>;
  using Advance = CrackedChain::Advance<double, laws::passes_of_increment>;
  static constexpr int max_units = Chain::max_units;
  /// Number of the first Kelvin unit among the numbers of a component of a point with a crack.
  static constexpr int first_unit = 1 + CrackedChain::crack_numbers;

  Advance advance{};  ///< without a crack, only its chain and its alpha are set
  bool cracks = false;
  int words = 1;                                      ///< numbers per component
  int units = 0;                                      ///< Kelvin units
  double over_strength = 0, over_shear_strength = 0;  ///< 1/f_t and 1/c_0 [1/Pa]
  double dt = 0;                                      ///< [s]
  double spring = 0, dashpot = 0;                     ///< E_m [Pa], C_m [Pa·s]
  double unit_spring[max_units] = {}, unit_dashpot[max_units] = {};
  double drag = 0;  ///< of points with cracks, WallIncrement::drag

  static IncrementLaw of(const Chain& chain, const CrackedChain* cracked, double dt) {
    IncrementLaw out;
    out.units = chain.units();
    out.words = 1 + out.units;
    out.dt = dt;
    out.spring = chain.E_m, out.dashpot = chain.C_m;
    std::copy(chain.E.begin(), chain.E.end(), out.unit_spring);
    std::copy(chain.C.begin(), chain.C.end(), out.unit_dashpot);
    if (cracked) {
      out.cracks = true;
      out.words = 1 + cracked->units();
      out.advance = cracked->increment(dt);
      out.over_strength = 1 / cracked->crack.tensile_strength;
      out.over_shear_strength = 1 / cracked->crack.shear_strength;
    } else {
      out.advance.chain = chain.step<double>(dt);
      out.advance.alpha = chain.alpha;
    }
    return out;
  }
  /// Change of f per displacement [Pa].
  MACADAM_HD double stiffness() const { return advance.chain.inv_c; }
  MACADAM_HD double alpha() const { return advance.alpha; }
};

}  // namespace macadam::kernels
