// SPDX-License-Identifier: GPL-3.0-or-later
// chain_fit.cpp  Refines a Kelvin chain from several starts.
#include "host/tools/fit/chain_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/tools/fit/chain_starts.hpp"
#include "macadam/error.hpp"

namespace macadam::fitting {
namespace {

/// Converts a fitted chain to θ of the larger chain `unknowns`, which must contain it. The curve stays the same,
/// because the additional elements are as stiff as the limits allow.
std::vector<double> embedded(const Unknowns& unknowns, const std::vector<Limits>& limits, const Chain& chain) {
  const std::vector<double>& theta = chain.minimum.theta;
  std::vector<double> out{theta[0]};
  if (unknowns.flow) out.push_back(chain.unknowns.flow ? theta[1] : limits[1].high);
  const auto first = theta.begin() + (chain.unknowns.flow ? 2 : 1);
  const auto end = theta.begin() + static_cast<std::ptrdiff_t>(chain.unknowns.of_model());
  out.insert(out.end(), first, end);
  const double time = first == end ? 0 : *(first + 1) - *first;
  while (out.size() < unknowns.of_model()) {
    out.push_back(limits[0].high);
    out.push_back(limits[0].high + time);
  }
  out.insert(out.end(), end, theta.end());
  return out;
}

}  // namespace

std::vector<Limits> chain_limits(const Unknowns& unknowns, const std::vector<Target>& targets,
                                 const std::vector<double>& shift) {
  double soft = std::numeric_limits<double>::infinity(), stiff = -soft, slow = soft, fast = -soft;
  for (const Target& t : targets) {
    soft = std::min(soft, t.log_modulus);
    stiff = std::max(stiff, t.log_modulus);
    slow = std::min(slow, std::log(t.place.omega));
    fast = std::max(fast, std::log(t.place.omega));
  }
  constexpr double wide = 12;  // a factor of e^12 = 1.6e5; the effect of a unit beyond it is far below the noise
  // If the temperature shifts the curves, the limits are wider by the largest |ln a_T| of the start plus 25 (eleven
  // decades). A |ln a_T| above 200 (87 decades) is not plausible and counts as 200.
  double shifts = 0;
  std::vector<double> theta(unknowns.of_model(), 0.0);
  theta.insert(theta.end(), shift.begin(), shift.end());
  for (const Target& t : targets)
    shifts = std::max(shifts, std::min(std::abs(log_shift(unknowns, theta.data(), t.place)), 200.0));
  if (unknowns.shift != ShiftKind::none) shifts += 25;
  const Limits spring{soft - wide, stiff + wide};
  const Limits dashpot{soft - wide - fast - shifts, stiff + wide - slow + shifts};
  std::vector<Limits> out{spring};
  if (unknowns.flow) out.push_back(dashpot);
  for (int l = 0; l < unknowns.units; ++l) {
    out.push_back(spring);
    out.push_back(dashpot);
  }
  return out;
}

bool contains(const Unknowns& larger, const Unknowns& smaller) {
  return smaller.units <= larger.units && (larger.flow || !smaller.flow);
}

Minimum fit_chain(const Unknowns& unknowns, const std::vector<Target>& targets, const std::vector<Limits>& limits,
                  const std::vector<double>& shift, const std::vector<const Chain*>& known, double tolerance) {
  std::vector<Minimum> minima;
  for (const std::vector<double>& theta : chain_starts(unknowns, targets, shift, known))
    minima.push_back(refine(unknowns, targets, limits, theta, near_enough));
  const auto lower = [](const Minimum& a, const Minimum& b) { return a.misfit < b.misfit; };
  std::sort(minima.begin(), minima.end(), lower);
  // The three results with the lowest misfit are refined to the end, because the misfit of a result that converges
  // slowly may still become the lowest.
  constexpr std::size_t most_refined = 3;
  Minimum best = minima.front();
  for (std::size_t i = 0; i < std::min(minima.size(), most_refined); ++i) {
    if (!std::isfinite(minima[i].misfit)) continue;
    Minimum end = refine(unknowns, targets, limits, std::move(minima[i].theta), tolerance);
    if (i == 0 || end.misfit < best.misfit) best = std::move(end);
  }
  for (const Chain* chain : known) {
    if (!contains(unknowns, chain->unknowns) || best.misfit <= chain->minimum.misfit) continue;
    best = std::min(refine(unknowns, targets, limits, embedded(unknowns, limits, *chain), tolerance), best, lower);
  }
  if (!std::isfinite(best.misfit)) throw RunError("fit: no starting values of the chain give a finite misfit");
  return best;
}

laws::GeneralisedKelvin chain_of(const Unknowns& unknowns, const std::vector<double>& theta) {
  laws::GeneralisedKelvin law;
  auto next = theta.begin();
  law.E_m = std::exp(*next++);
  if (unknowns.flow) law.C_m = std::exp(*next++);
  for (int l = 0; l < unknowns.units; ++l) {
    law.E.push_back(std::exp(*next++));
    law.C.push_back(std::exp(*next++));
  }
  return law;
}

}  // namespace macadam::fitting
