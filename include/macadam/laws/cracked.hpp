// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cracked.hpp  Defines contact laws with a cohesive crack in series at each contact point (docs/cracks.md).
#pragma once

#include <cmath>

#include "macadam/laws/crack.hpp"
#include "macadam/laws/crack_solve.hpp"
#include "macadam/laws/elastic.hpp"
#include "macadam/laws/generalised_kelvin.hpp"

namespace macadam::laws {

/// The law `Inner` in series with a crack: x = X[f] + w. Each component keeps f, two numbers of the crack, and the
/// units of `Inner`. The first number of the crack is the opening or slip w of the component. The second number is y in
/// the normal component; in the two shear components it is the work of friction per area and the energy per area that
/// damage has dissipated.
template <class Inner>
struct Cracked : Inner {
  using Chain = Inner;
  static constexpr const char* name = Inner::cracked_name;
  static constexpr bool linear = false;
  /// A step may change w by 1e-8 of its value or less; states in single precision would lose such changes.
  static constexpr bool needs_double = true;
  static constexpr int crack_numbers = 2;
  static constexpr int only_units = units_of<Inner>() < 0 ? -1 : units_of<Inner>() + crack_numbers;
  static constexpr int known_units = 3 + crack_numbers;  ///< number of units for which steps are compiled separately
  Crack crack;

  int units() const { return Inner::units() + crack_numbers; }
  void block(double, int) const = delete;  // a block of steps is only exact for linear laws

  /// Returns how a contact point separated, from its numbers (Step::advance_point): in tension if its opening is at
  /// least β_w times its slip.
  Break break_of(const double* state) const {
    const Place at{state, 1 + units()};
    if (!(at(0, 2) > 0 && at(0, 2) >= crack.separation())) return Break::none;
    return crack.slip_weight() * std::hypot(at(1, 1), at(2, 1)) > at(0, 1) ? Break::shear : Break::tension;
  }
  /// Returns the state of the crack of a contact point, from its numbers.
  PointCrack crack_of(const double* state) const {
    const Place at{state, 1 + units()};
    PointCrack out{at(0, 1), std::hypot(at(1, 1), at(2, 1)), 0, at(2, 2), at(1, 2)};
    if (!(at(0, 2) > 0)) return out;
    double rate;
    const double t = SofteningCurve<double>::of(crack).stress(at(0, 2), rate);
    const double shear = crack.strength_ratio() * crack.slip_weight();
    out.damage = 1 - t / crack.tensile_strength;
    out.energy += 0.5 * t / at(0, 2) * (out.opening * out.opening + shear * out.slip * out.slip);
    return out;
  }

  /// Coefficients of one time step or, with more passes of Newton's method, of one quasi-static increment.
  template <class R, int passes>
  struct Advance {
    static constexpr bool memoryless = false, coupled = true;
    static constexpr int most_units = Inner::max_units + crack_numbers;
    typename Inner::template Step<R> chain;
    CrackSolve<R, passes> crack;
    R alpha, inverse_alpha;

    template <int L, class S, class State, class Factors = NoFactors>
    MACADAM_HD void advance_point(const S (&dx)[3], S d, State&& state, const Factors& factors = {}) const {
      constexpr int units = L >= 0 ? L - crack_numbers : -1;
      const S over_d = S(1) / d;
      const auto unit = [&](int c) { return [&state, c](int l) -> S& { return state(c, 1 + crack_numbers + l); }; };
      const S before[3] = {state(0, 0), state(1, 0), state(2, 0)};
      S f[3];  // without motion of the crack
      f[0] = chain.template trial<units>(before[0], dx[0], unit(0), factors.normal);
      for (int c = 1; c < 3; ++c) f[c] = chain.template trial<units>(before[c], dx[c], unit(c), factors.shear);

      const CrackOpenings<S> old{state(0, 1), {state(1, 1), state(2, 1)}, state(0, 2)};
      CrackOpenings<S> w = old;
      const S to_shear = S(alpha) * over_d;
      const S shear[2] = {to_shear * f[1], to_shear * f[2]};
      const S per_opening = S(chain.step_stiffness()) * over_d;
      const CrackStresses<S> stress =
          crack(over_d * f[0], shear, factors.normal * per_opening, S(alpha) * (factors.shear * per_opening), w);
      const auto intact = !(w.largest > S(0));
      f[0] = select(intact, f[0], stress.normal * d);
      for (int k = 0; k < 2; ++k) f[1 + k] = select(intact, f[1 + k], stress.shear[k] * (d * S(inverse_alpha)));

      const S stress_before[3] = {over_d * before[0], to_shear * before[1], to_shear * before[2]};
      state(1, 2) += friction_work(old, w, stress, stress_before);
      state(2, 2) += dissipated(old, w, stress_before);
      state(0, 1) = w.opening, state(1, 1) = w.slip[0], state(2, 1) = w.slip[1], state(0, 2) = w.largest;
      for (int c = 0; c < 3; ++c) {
        state(c, 0) = f[c];
        chain.template follow<units>(f[c] + before[c], unit(c));
      }
    }

   private:
    /// Returns the work of friction in a step [J/m²]: slip times the mean of the stresses that friction bears before
    /// and after the step. A point that was intact has no friction before the step.
    template <class S>
    MACADAM_HD S friction_work(const CrackOpenings<S>& old, const CrackOpenings<S>& now, const CrackStresses<S>& stress,
                               const S (&before)[3]) const {
      const S zero(0), y = old.largest,
                       secant = S(crack.strengths) * stress.cohesion_before / select(y > zero, y, S(1));
      S out(0);
      for (int k = 0; k < 2; ++k) {
        const S friction_before = select(y > zero, before[1 + k] - secant * old.slip[k], stress.friction[k]);
        out += S(R(0.5)) * (friction_before + stress.friction[k]) * (now.slip[k] - old.slip[k]);
      }
      return out;
    }
    /// Returns the energy that damage dissipates in a step [J/m²]. Along a fixed direction of opening it is the change
    /// of Φ(y), times the ratio of the energies per opening and per effective opening. In a brittle crack it is the
    /// work of the stress that vanishes.
    template <class S>
    MACADAM_HD S dissipated(const CrackOpenings<S>& old, const CrackOpenings<S>& now, const S (&before)[3]) const {
      const S zero(0);
      if (crack.curve.kind == Softening::brittle) {
        const S work = before[0] * now.opening + before[1] * now.slip[0] + before[2] * now.slip[1];
        return select(old.largest > zero || !(now.largest > zero), zero, S(R(0.5)) * work);
      }
      const S change = crack.curve.dissipated(now.largest) - crack.curve.dissipated(old.largest);
      if (crack.strengths == crack.slip_weight * crack.slip_weight) return change;
      const S after = energy_ratio(now), mean = S(R(0.5)) * (energy_ratio(old) + after);
      return change * select(old.largest > zero, mean, after);
    }
    template <class S>
    MACADAM_HD S energy_ratio(const CrackOpenings<S>& w) const {
      const S n = w.opening * w.opening, s = w.slip[0] * w.slip[0] + w.slip[1] * w.slip[1];
      const S effective = n + S(crack.slip_weight * crack.slip_weight) * s;
      const auto moved = effective > S(0);
      return select(moved, (n + S(crack.strengths) * s) / select(moved, effective, S(1)), S(1));
    }
  };

  /// See law.hpp.
  template <class R>
  using Step = Advance<R, passes_of_step>;
  template <class R>
  Step<R> step(double dt) const {
    return advance_in<R, passes_of_step>(dt);
  }
  /// Returns the coefficients of a quasi-static increment.
  Advance<double, passes_of_increment> increment(double dt) const {
    return advance_in<double, passes_of_increment>(dt);
  }

 private:
  template <class R, int passes>
  Advance<R, passes> advance_in(double dt) const {
    return {Inner::template step<R>(dt), CrackSolve<R, passes>::of(crack, this->alpha), R(this->alpha),
            R(this->alpha > 0 ? 1 / this->alpha : 0)};
  }
  /// Gives access to number n of component c of a contact point.
  struct Place {
    const double* state;
    int words;
    double operator()(int c, int n) const { return state[c * words + n]; }
  };
};

}  // namespace macadam::laws
