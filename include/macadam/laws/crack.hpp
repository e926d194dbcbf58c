// SPDX-License-Identifier: GPL-3.0-or-later
/// \file crack.hpp  Defines a cohesive crack in series with a contact law: its parameters, its softening curve, and the
/// condition under which a step has exactly one solution (docs/cracks.md).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "macadam/laws/law.hpp"

namespace macadam::laws {

/// Shape of the softening curve t(y): the cohesive stress [Pa] over the largest effective opening y so far [m].
enum class Softening : std::uint8_t { linear, bilinear, exponential, brittle };
inline constexpr const char* to_string(Softening kind) {
  constexpr const char* names[] = {"linear", "bilinear", "exponential", "brittle"};
  return names[static_cast<int>(kind)];
}

/// Parameters of a cohesive crack. Energies are per area of the facet.
struct Crack {
  double tensile_strength = 0;       ///< f_t [Pa]
  double fracture_energy = 0;        ///< G_f, mode I [J/m²]; 0 if the softening is brittle
  double shear_strength = 0;         ///< c_0, without pressure [Pa]
  double shear_fracture_energy = 0;  ///< G_f2, mode II [J/m²]; 0 if the softening is brittle
  double friction = 0;               ///< μ_0, coefficient of friction of an intact point
  double residual_friction = 0;      ///< μ_r, coefficient of friction of a separated point
  Softening softening = Softening::linear;
  double kink_opening = 0.8;     ///< ρ: the bilinear curve has its kink at y = ρ·G_f/f_t
  double kink_stress = 1.0 / 3;  ///< r: the bilinear curve has the stress r·f_t at its kink

  /// The stress of the exponential curve, divided by f_t, below which a point counts as separated.
  static constexpr double separated_stress = 1e-3;

  /// Returns β_c = c_0/f_t, the ratio of the strengths.
  double strength_ratio() const { return shear_strength / tensile_strength; }
  /// Returns β_w, the weight of the slip in the effective opening w̄ = √(w_n² + β_w²·|w_s|²).
  double slip_weight() const {
    return softening == Softening::brittle ? strength_ratio()
                                           : strength_ratio() * (fracture_energy / shear_fracture_energy);
  }
  /// Returns the effective opening at which a point is separated [m].
  double separation() const {
    const double unit = fracture_energy / tensile_strength;
    switch (softening) {
      case Softening::linear:
        return 2 * unit;
      case Softening::bilinear:
        return (2 - kink_opening) / kink_stress * unit;
      case Softening::exponential:
        return -std::log(separated_stress) * unit;
      case Softening::brittle:
        break;
    }
    return 0;
  }
  /// Returns the largest |dt/dy|, times G_f/f_t² [1].
  double steepest() const {
    if (softening == Softening::linear) return 0.5;
    if (softening == Softening::exponential) return 1;
    return std::max((1 - kink_stress) / kink_opening, kink_stress / ((2 - kink_opening) / kink_stress - kink_opening));
  }
  /// Returns the fracture energy G_f [J/m²] that must be exceeded so that each step has exactly one solution, if the
  /// ratio of the two fracture energies stays the same. `modulus`: 1/c, the stiffness of the contact's law within a
  /// step [Pa]; `alpha`: its ratio of shear to normal stiffness; `d`: length of the contact [m].
  double least_fracture_energy(double modulus, double alpha, double d) const {
    if (softening == Softening::brittle) return 0;
    return steepest() * tensile_strength * tensile_strength * d / modulus * std::max(1.0, shear_term(alpha));
  }
  /// Returns β_c·β_w/α, by which shear multiplies the least fracture energy if it is above 1; 0 without shear.
  double shear_term(double alpha) const { return alpha > 0 ? strength_ratio() * slip_weight() / alpha : 0; }
};

/// State of the crack of a contact point, for results.
struct PointCrack {
  double opening = 0;   ///< w_n [m]
  double slip = 0;      ///< |w_s| [m]
  double damage = 0;    ///< 0: intact, 1: separated
  double energy = 0;    ///< energy per area that damage has dissipated or that the crack stores [J/m²]
  double friction = 0;  ///< work of friction per area [J/m²]
};

/// The softening curve in precision R.
template <class R>
struct SofteningCurve {
  Softening kind;
  R strength;          ///< f_t [Pa]
  R kink, end;         ///< openings at the kink and at separation [m]
  R slope, slope_end;  ///< −dt/dy before and after the kink [Pa/m]; exponential: slope/strength is 1/the unit of y

  static SofteningCurve of(const Crack& crack) {
    const double f = crack.tensile_strength, end = crack.separation(), unit = crack.fracture_energy / f;
    SofteningCurve out{crack.softening, R(f), R(end), R(end), R(0), R(0)};
    if (crack.softening == Softening::linear) out.slope = R(f / end);
    if (crack.softening == Softening::exponential) out.slope = R(f / unit);
    if (crack.softening == Softening::bilinear) {
      const double kink = crack.kink_opening * unit;
      out.kink = R(kink);
      out.slope = R((1 - crack.kink_stress) * f / kink);
      out.slope_end = R(crack.kink_stress * f / (end - kink));
    }
    return out;
  }
  /// Returns the stress t [Pa] at y and stores dt/dy [Pa/m] in `rate`.
  template <class S>
  MACADAM_HD S stress(const S& y, S& rate) const {
    if (kind == Softening::exponential) {
      using std::exp;
      const S t = S(strength) * exp(S(-slope / strength) * y);
      rate = S(-slope / strength) * t;
      return t;
    }
    if (kind == Softening::brittle) {
      rate = S(0);
      return select(y > S(0), S(0), S(strength));
    }
    const auto first = y < S(kink), ended = y >= S(end);
    rate = select(ended, S(0), select(first, S(-slope), S(-slope_end)));
    return select(ended, S(0), select(first, S(strength) - S(slope) * y, S(slope_end) * (S(end) - y)));
  }
  /// Returns Φ(y) = ∫₀^y t dy − ½·t(y)·y, the energy per area that a crack opened in a fixed direction has dissipated
  /// [J/m²].
  template <class S>
  MACADAM_HD S dissipated(const S& y) const {
    if (kind == Softening::exponential) {
      using std::exp;
      using std::expm1;
      const S z = S(slope / strength) * y;
      return S(strength * strength / slope) * (-expm1(-z) - S(R(0.5)) * z * exp(-z));
    }
    if (kind == Softening::brittle) return S(0);
    const S half(R(0.5)), before = select(y < S(kink), y, S(kink));  // parts of y before and behind the kink
    const S t_before = S(strength) - S(slope) * before;
    const S behind = select(y < S(kink), S(0), select(y < S(end), y, S(end)) - before);
    const S t = t_before - S(slope_end) * behind;
    const S work = half * (S(strength) + t_before) * before + half * (t_before + t) * behind;
    return work - half * select(y < S(end), t, S(0)) * y;
  }
};

}  // namespace macadam::laws
