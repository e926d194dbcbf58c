// SPDX-License-Identifier: GPL-3.0-or-later
// analogue_fit.cpp  Fits 2S2P1D and Huet–Sayegh: computes the misfit of a grid of usual values and refines the best
// ones.
#include "host/tools/fit/analogue_fit.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>

#include "host/tools/fit/chain_fit.hpp"
#include "host/tools/fit/shift_start.hpp"
#include "macadam/error.hpp"

namespace macadam::fitting {
namespace {

/// Range of the targets, as logarithms.
struct Extent {
  /// Softest and stiffest modulus, lowest and highest frequency.
  double soft = std::numeric_limits<double>::infinity(), stiff = -soft, slow = soft, fast = -soft;
};

Extent extent_of(const std::vector<Target>& targets) {
  Extent e;
  for (const Target& t : targets) {
    e.soft = std::min(e.soft, t.log_modulus);
    e.stiff = std::max(e.stiff, t.log_modulus);
    e.slow = std::min(e.slow, std::log(t.place.omega));
    e.fast = std::max(e.fast, std::log(t.place.omega));
  }
  return e;
}

/// Exchanges k and h if k > h. The curve stays the same: in 1 + δ·(sτ)^(−k) + (sτ)^(−h) the two elements exchange their
/// names.
void order(const Unknowns& u, std::vector<double>& theta) {
  double &k = theta[2], &h = theta[3], &log_delta = theta[4], &log_tau = theta[5];
  if (k <= h) return;
  const double longer = log_tau - log_delta / k;                     // δ·τ^(−k) = τ'^(−k)
  log_delta = h * (longer - log_tau);                                // δ'·τ'^(−h) = τ^(−h)
  if (u.model == FitModel::two_s2p1d) theta[6] += log_tau - longer;  // keeps β·τ
  log_tau = longer;
  std::swap(k, h);
}

/// Returns bounds for the unknowns of the model.
std::vector<Limits> analogue_limits(const Unknowns& u, const std::vector<Target>& targets) {
  const Extent e = extent_of(targets);
  const double shifts = u.shift == ShiftKind::none ? 0 : 25;  // eleven decades for the effect of temperature
  std::vector<Limits> out{{e.stiff - 0.5, e.stiff + 7},
                          {e.soft - 14, e.soft + 0.5},
                          {0.01, 1},
                          {0.01, 1},
                          {-8, 8},
                          {-e.fast - 30 - shifts, -e.slow + 10 + shifts}};
  if (u.model == FitModel::two_s2p1d) out.push_back({-3, 40});
  return out;
}

constexpr std::size_t refined = 6;  ///< number of best starts that are refined

/// Computes the misfit of usual constants θ on a grid of τ, E_00 and δ. Returns the few θ with the smallest misfit,
/// best first.
std::vector<std::vector<double>> usual_starts(const Unknowns& u, const std::vector<Target>& targets,
                                              const std::vector<double>& shift) {
  const Extent e = extent_of(targets);
  std::vector<std::pair<double, std::vector<double>>> starts;
  for (double log_tau = -e.fast - 15; log_tau < -e.slow + 8; log_tau += 1.5) {
    for (const double statics : {e.soft - 0.7, e.soft - 7}) {
      for (const double log_delta : {0.0, 1.0}) {
        std::vector<double> theta{e.stiff + 0.7, statics, 0.2, 0.6, log_delta, log_tau};
        if (u.model == FitModel::two_s2p1d) theta.push_back(5);
        theta.insert(theta.end(), shift.begin(), shift.end());
        const double misfit = misfit_at(u, targets, theta);
        if (std::isfinite(misfit)) starts.emplace_back(misfit, std::move(theta));
      }
    }
  }
  std::sort(starts.begin(), starts.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::vector<double>> out;
  for (std::size_t i = 0; i < std::min(starts.size(), refined); ++i) out.push_back(std::move(starts[i].second));
  return out;
}

/// Returns starts of 2S2P1D from a fitted Huet–Sayegh model, with dashpots of several sizes. A dashpot at its upper
/// limit has no effect, so this start has the misfit of the Huet–Sayegh model.
std::vector<std::vector<double>> with_dashpot(const std::vector<double>& huet_sayegh,
                                              const std::vector<Limits>& limits) {
  constexpr std::ptrdiff_t beta = 6;  // position of ln β in θ
  std::vector<std::vector<double>> out;
  for (const double log_beta : {5.0, 12.0, limits[beta].high}) {
    out.push_back(huet_sayegh);
    out.back().insert(out.back().begin() + beta, log_beta);
  }
  return out;
}

/// Returns the smallest misfit that is reached from usual values and from the fitted smaller models `contained`; empty
/// if no start has a finite misfit.
std::optional<Minimum> fit_from(const Unknowns& u, const Problem& problem, const std::vector<Chain>& contained) {
  const std::vector<Limits> limits = joined(analogue_limits(u, problem.targets), shift_limits(u, problem.temperatures));
  std::vector<std::vector<double>> starts =
      usual_starts(u, problem.targets, start_shift(u, problem.targets, problem.temperatures));
  for (const Chain& smaller : contained) {
    const std::vector<double>& theta = smaller.minimum.theta;
    if (smaller.unknowns.model == u.model) {
      starts.push_back(convert_shift(smaller.unknowns, theta, u.shift, problem.temperatures));
    } else if (smaller.unknowns.shift == u.shift) {
      const std::vector<std::vector<double>> more = with_dashpot(theta, limits);
      starts.insert(starts.end(), more.begin(), more.end());
    }
  }
  std::optional<Minimum> best;
  for (std::vector<double>& start : starts) {
    Minimum minimum = refine(u, problem.targets, limits, std::move(start));
    if (std::isfinite(minimum.misfit) && (!best || minimum.misfit < best->misfit)) best = std::move(minimum);
  }
  if (best) order(u, best->theta);
  return best;
}

}  // namespace

Minimum fit_analogue(const Problem& problem) {
  std::vector<FitModel> models{FitModel::huet_sayegh};
  if (problem.unknowns.model == FitModel::two_s2p1d) models.push_back(FitModel::two_s2p1d);
  std::vector<ShiftKind> shifts = contained_shift_laws(problem);
  shifts.push_back(problem.unknowns.shift);
  std::vector<Chain> fitted;
  for (const FitModel model : models) {
    for (const ShiftKind shift : shifts) {
      Unknowns u = problem.unknowns;
      u.model = model, u.shift = shift;
      const bool is_asked = model == models.back() && shift == shifts.back();
      if (std::optional<Minimum> minimum = fit_from(u, problem, fitted)) {
        if (is_asked) return *minimum;
        fitted.push_back({u, std::move(*minimum)});
      }
    }
  }
  throw RunError("fit: no starting values of the model give a finite misfit");
}

AnalogueModel analogue_of(const Unknowns& u, const std::vector<double>& theta) {
  AnalogueModel model;
  model.E_0 = std::exp(theta[0]);
  model.E_00 = std::exp(theta[1]);
  model.k = theta[2];
  model.h = theta[3];
  model.delta = std::exp(theta[4]);
  model.tau = std::exp(theta[5]);
  if (u.model == FitModel::two_s2p1d) model.beta = std::exp(theta[6]);
  return model;
}

}  // namespace macadam::fitting
