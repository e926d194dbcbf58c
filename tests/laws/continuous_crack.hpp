// SPDX-License-Identifier: GPL-3.0-or-later
/// \file continuous_crack.hpp  Integrates one contact point with a crack in continuous time, by a Runge–Kutta method of
/// fourth order for its dashpots.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "macadam/laws/all.hpp"

namespace macadam::test {

/// Constant rates of the opening and of the two slips [m/s], for a time [s].
struct Leg {
  double rate[3];
  double seconds;
};

/// A contact point whose chain has the displacements x_l of its Kelvin units and of its dashpot as unknowns. The
/// remainder of a displacement is divided between the chain's spring and the crack, by equations without time.
class ContinuousCrack {
 public:
  ContinuousCrack(const laws::GeneralisedKelvin& chain, const laws::Crack& crack, double d)
      : chain_(chain), solve_(laws::CrackSolve<double>::of(crack, chain.alpha)), d_(d) {
    unknowns_.assign(2 * words() + 2, 0.0);
  }

  void run(const Leg& leg, int steps) {
    const double h = leg.seconds / steps;
    for (int k = 0; k < steps; ++k) {
      const auto at = [&](double time, const std::vector<double>* slope) {
        std::vector<double> u = unknowns_;
        for (std::size_t i = 0; slope && i < u.size(); ++i) u[i] += time * (*slope)[i];
        const double x[2] = {x_[0] + time * leg.rate[0], x_[1] + time * leg.rate[1]};
        return slopes(u, x, leg.rate);
      };
      const auto a = at(0, nullptr), b = at(h / 2, &a), c = at(h / 2, &b), e = at(h, &c);
      for (std::size_t i = 0; i < unknowns_.size(); ++i) unknowns_[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + e[i]);
      for (int i = 0; i < 2; ++i) x_[i] += h * leg.rate[i];
      stresses(unknowns_, x_, w_);
    }
  }
  const laws::CrackOpenings<double>& openings() const { return w_; }
  double work() const { return unknowns_[2 * words()]; }              ///< [J/m²]
  double viscous_work() const { return unknowns_[2 * words() + 1]; }  ///< [J/m²]

 private:
  /// Unknowns of one direction: x_l of the units, and of the dashpot in series.
  std::size_t words() const { return chain_.E.size() + 1; }

  /// Returns normal stress and shear stress; `w` contains the openings before and after.
  std::array<double, 2> stresses(const std::vector<double>& u, const double (&x)[2],
                                 laws::CrackOpenings<double>& w) const {
    const double kappa = chain_.E_m / d_, kappa_s = chain_.alpha * kappa;
    double trial[2];
    for (std::size_t c = 0; c < 2; ++c) {
      double spring = x[c];
      for (std::size_t l = 0; l < words(); ++l) spring -= u[c * words() + l];
      trial[c] = (c == 0 ? kappa : kappa_s) * (spring - (c == 0 ? w.opening : w.slip[0]));
    }
    const double shear[2] = {trial[1], 0};
    const auto found = solve_(trial[0], shear, kappa, kappa_s, w);
    return {found.normal, found.shear[0]};
  }

  std::vector<double> slopes(const std::vector<double>& u, const double (&x)[2], const double (&rate)[3]) const {
    laws::CrackOpenings<double> w = w_;
    const std::array<double, 2> stress = stresses(u, x, w);
    std::vector<double> out(u.size());
    double& viscous = out.back();
    for (std::size_t c = 0; c < 2; ++c) {
      const double alpha = c == 0 ? 1 : chain_.alpha, f = stress[c] * d_ / alpha;
      for (std::size_t l = 0; l < chain_.E.size(); ++l) {
        double& slope = out[c * words() + l];
        slope = (f - chain_.E[l] * u[c * words() + l]) / chain_.C[l];
        viscous += alpha / d_ * chain_.C[l] * slope * slope;
      }
      out[c * words() + chain_.E.size()] = f / chain_.C_m;
      viscous += alpha / d_ * f * f / chain_.C_m;
      out[2 * words()] += stress[c] * rate[c];
    }
    return out;
  }

  laws::GeneralisedKelvin chain_;
  laws::CrackSolve<double> solve_;
  double d_;
  std::vector<double> unknowns_;
  double x_[2] = {0, 0};
  laws::CrackOpenings<double> w_{0, {0, 0}, 0};
};

}  // namespace macadam::test
