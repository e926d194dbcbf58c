// SPDX-License-Identifier: GPL-3.0-or-later
// reference.cpp  Moves a fitted model to another reference temperature by rescaling its times.
#include "host/tools/fit/reference.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host/tools/fit/isotherms.hpp"
#include "macadam/error.hpp"

namespace macadam::fitting {
namespace {

/// Adds ln a to the logarithm of every time of the model, so that E*(ω) becomes E*(a·ω).
void scale_times(const Unknowns& u, double log_a, double* theta) {
  if (u.model != FitModel::kelvin) {
    theta[5] += log_a;  // ln τ
    return;
  }
  if (u.flow) theta[1] += log_a;
  for (std::size_t i = u.flow ? 3 : 2; i < u.of_model(); i += 2) theta[i] += log_a;
}

}  // namespace

void move_reference(const Problem& problem, const ModulusData& data, Chain& fitted) {
  Unknowns& u = fitted.unknowns;
  const double wanted = problem.wanted_reference, change = wanted - u.reference_temperature;
  if (u.shift == ShiftKind::none || change == 0) return;
  std::vector<double>& theta = fitted.minimum.theta;
  double* const constants = theta.data() + u.of_model();
  if (u.shift == ShiftKind::wlf && !(std::exp(constants[1]) + change > 0)) {
    throw InputError(
        data.source, 0, "reference temperature", fmt::format("{}", wanted),
        fmt::format("a temperature above {:.4g} degrees C, at which a_T of the fitted law becomes infinite",
                    u.reference_temperature - std::exp(constants[1])));
  }
  const double log_a = log_shift(u, theta.data(), {1, wanted, problem.wanted_isotherm});
  scale_times(u, log_a, theta.data());
  if (u.shift == ShiftKind::wlf) {  // C1'·C2' = C1·C2, C2' = C2 + change
    const double moved = std::log(std::exp(constants[1]) + change);
    constants[0] += constants[1] - moved;
    constants[1] = moved;
  }
  if (u.shift == ShiftKind::free) {
    std::vector<double> factors(constants, constants + u.of_shift());
    factors.insert(factors.begin() + static_cast<std::ptrdiff_t>(u.reference_isotherm), 0.0);
    const double at_wanted = factors[problem.wanted_isotherm];
    factors.erase(factors.begin() + static_cast<std::ptrdiff_t>(problem.wanted_isotherm));
    for (std::size_t i = 0; i < factors.size(); ++i) constants[i] = factors[i] - at_wanted;
  }
  u.reference_temperature = wanted;
  u.reference_isotherm = problem.wanted_isotherm;
}

}  // namespace macadam::fitting
