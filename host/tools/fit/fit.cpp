// SPDX-License-Identifier: GPL-3.0-or-later
// fit.cpp  Defines fit_modulus(), which fits the model, then adds statistics and warnings.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/tools/fit/analogue_fit.hpp"
#include "host/tools/fit/choose_chain.hpp"
#include "host/tools/fit/criterion.hpp"
#include "host/tools/fit/reference.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace fitting {
namespace {

/// Fits the model that the options ask for.
Chain fit_any(const Problem& problem, const ModulusData& data, Fit& fit) {
  if (problem.unknowns.model == FitModel::kelvin) return choose_chain(problem, data, fit);
  const Unknowns& u = problem.unknowns;
  if (!enough(2 * problem.targets.size(), u.count(), Criterion::bic)) {
    throw InputError(data.source, 0, "measurements", fmt::format("{}", data.points.size()),
                     fmt::format("more measurements for the {} parameters of {}", u.count(), to_string(u.model)));
  }
  return {u, fit_analogue(problem)};
}

/// Returns the shift law with the constants θ.
laws::Shift shift_of(const Unknowns& u, const std::vector<double>& theta, const std::vector<double>& temperatures) {
  const double* constants = theta.data() + u.of_model();
  switch (u.shift) {
    case ShiftKind::wlf:
      return laws::Wlf{std::exp(constants[0]), std::exp(constants[1]), u.reference_temperature};
    case ShiftKind::arrhenius:
      return laws::Arrhenius{std::exp(constants[0]), u.reference_temperature};
    case ShiftKind::free: {
      laws::ShiftTable table{temperatures, {}};
      for (std::size_t i = 0; i < temperatures.size(); ++i)
        table.log10_a_T.push_back(i == u.reference_isotherm ? 0 : theta[u.of_isotherm(i)]);
      return table;
    }
    default:
      return laws::NoShift{};
  }
}

/// Returns names and units of θ, in its order, and which entries are logarithms.
std::vector<FitParameter> named(const Unknowns& u, const std::vector<double>& temperatures) {
  std::vector<FitParameter> out;
  const auto add = [&](const std::string& name, const std::string& unit, bool logarithmic = true) {
    out.push_back({name, unit, 0, 0, logarithmic});
  };
  if (u.model == FitModel::kelvin) {
    add("E_m", "Pa");
    if (u.flow) add("C_m", "Pa s");
    for (int l = 1; l <= u.units; ++l) {
      add(fmt::format("E_{}", l), "Pa");
      add(fmt::format("C_{}", l), "Pa s");
    }
  } else {
    add("E_0", "Pa");
    add("E_00", "Pa");
    add("k", "", false);
    add("h", "", false);
    add("delta", "");
    add("tau", "s");
    if (u.model == FitModel::two_s2p1d) add("beta", "");
  }
  if (u.shift == ShiftKind::wlf) {
    add("C1", "");
    add("C2", "K");
  }
  if (u.shift == ShiftKind::arrhenius) add("activation_energy", "J/mol");
  if (u.shift == ShiftKind::free) {
    for (std::size_t i = 0; i < temperatures.size(); ++i)
      if (i != u.reference_isotherm) add(fmt::format("log10_a_T({} C)", temperatures[i]), "", false);
  }
  return out;
}

/// Sorts the units of a chain by ascending retardation time.
void sort_units(const Unknowns& u, std::vector<double>& theta) {
  if (u.model != FitModel::kelvin) return;
  std::vector<std::pair<double, double>> units;
  const std::size_t first = u.flow ? 2 : 1;
  for (std::size_t i = first; i < u.of_model(); i += 2) units.emplace_back(theta[i], theta[i + 1]);
  std::sort(units.begin(), units.end(),
            [](const auto& a, const auto& b) { return a.second - a.first < b.second - b.first; });
  for (std::size_t l = 0; l < units.size(); ++l) {
    theta[first + 2 * l] = units[l].first;
    theta[first + 2 * l + 1] = units[l].second;
  }
}

/// Adds the parameters with their standard deviations, and the covariance.
void add_statistics(const Problem& problem, const Chain& fitted, Fit& fit) {
  const std::vector<double>& theta = fitted.minimum.theta;
  const Covariance covariance = covariance_at(fitted.unknowns, problem.targets, theta);
  fit.covariance = covariance.matrix;
  const double scale = fit.deviations ? 1 : fit.misfit / fit.degrees_of_freedom;
  for (double& c : fit.covariance) c *= scale;
  fit.parameters = named(fitted.unknowns, problem.temperatures);
  std::string unknown;
  for (std::size_t i = 0; i < theta.size(); ++i) {
    FitParameter& p = fit.parameters[i];
    const double deviation = std::sqrt(fit.covariance[i * theta.size() + i]);
    p.value = p.logarithmic ? std::exp(theta[i]) : theta[i];
    p.deviation = p.logarithmic ? p.value * deviation : deviation;
    if (covariance.undetermined[i]) p.deviation = std::numeric_limits<double>::infinity();
    if (!(p.logarithmic ? deviation < 1 : true) || covariance.undetermined[i])
      unknown += (unknown.empty() ? "" : ", ") + p.name;
  }
  if (!unknown.empty())
    fit.warnings.push_back(fmt::format("the data hardly determine {}: standard deviations of 100 % and more", unknown));
  if (!fitted.minimum.determined)
    fit.warnings.emplace_back(
        "a parameter lies at a limit of its plausible values; a chain with fewer units, or another model, would fit "
        "the data as well");
}

/// Adds measured and fitted values of each measurement, and the errors.
void add_points(const Problem& problem, const ModulusData& data, const Chain& fitted, Fit& fit) {
  double modulus = 0, phase = 0;
  for (std::size_t i = 0; i < problem.targets.size(); ++i) {
    const Target& t = problem.targets[i];
    const Polar<double> value = modulus_at(fitted.unknowns, fitted.minimum.theta.data(), t.place);
    FittedPoint p;
    p.measured = data.points[i];
    p.log10_a_T = log_shift(fitted.unknowns, fitted.minimum.theta.data(), t.place) / std::numbers::ln10;
    p.e_star_pa = std::exp(value.log_modulus);
    p.phase_deg = value.phase / degree;
    const double e = p.e_star_pa / p.measured.e_star_pa - 1, d = p.phase_deg - p.measured.phase_deg;
    modulus += e * e;
    phase += d * d;
    fit.errors.e_star_largest = std::max(fit.errors.e_star_largest, std::abs(e));
    fit.errors.phase_largest_deg = std::max(fit.errors.phase_largest_deg, std::abs(d));
    fit.points.push_back(p);
  }
  const auto n = static_cast<double>(problem.targets.size());
  fit.errors.e_star_rms = std::sqrt(modulus / n);
  fit.errors.phase_rms_deg = std::sqrt(phase / n);
}

/// Returns an estimate of the standard deviation of a normal distribution from the median of the absolute values; a few
/// outliers do not change it.
double robust_deviation(std::vector<double> values) {
  for (double& v : values) v = std::abs(v);
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle / 0.6745;
}

/// Warns of measurements that lie more than five standard deviations off the fit. Among 20,000 normally distributed
/// errors, one is this large with a probability of 1 %. The standard deviation is the larger of two: the given or
/// assumed standard deviation of the data, and the standard deviation of all differences from the fit. The latter is
/// large if the model misses the whole curve.
void warn_of_outliers(const Problem& problem, Fit& fit) {
  constexpr double far_off = 5;
  constexpr std::size_t most_named = 3;
  std::vector<double> moduli, phases;
  for (std::size_t i = 0; i < fit.points.size(); ++i) {
    const FittedPoint& p = fit.points[i];
    const Target& t = problem.targets[i];
    moduli.push_back(std::log(p.e_star_pa / p.measured.e_star_pa) / t.modulus_deviation);
    phases.push_back((p.phase_deg - p.measured.phase_deg) * degree / t.phase_deviation);
  }
  const double modulus_bound = far_off * std::max(1.0, robust_deviation(moduli));
  const double phase_bound = far_off * std::max(1.0, robust_deviation(phases));
  std::vector<std::string> named;
  for (std::size_t i = 0; i < fit.points.size(); ++i) {
    const bool modulus = std::abs(moduli[i]) > modulus_bound, phase = std::abs(phases[i]) > phase_bound;
    if (!modulus && !phase) continue;
    const FittedPoint& p = fit.points[i];
    std::string one =
        p.measured.line > 0 ? fmt::format("line {}", p.measured.line) : fmt::format("measurement {}", i + 1);
    if (modulus) one += fmt::format(": |E*| {:.4g} Pa, fit {:.4g} Pa", p.measured.e_star_pa, p.e_star_pa);
    if (phase) one += fmt::format(": phase {:.3g} degrees, fit {:.3g}", p.measured.phase_deg, p.phase_deg);
    named.push_back(std::move(one));
  }
  if (named.empty()) return;
  const std::size_t shown = std::min(named.size(), most_named);
  fit.warnings.push_back(fmt::format("{} of {} measurements lie more than {} standard deviations off the fit: {}{}",
                                     named.size(), fit.points.size(), far_off,
                                     fmt::join(named.begin(), named.begin() + static_cast<std::ptrdiff_t>(shown), "; "),
                                     named.size() > shown ? "; ..." : ""));
}

/// Warns if log10 a_T rises with temperature, since warm materials flow faster. `temperatures`: each once, ascending.
void warn_of_shift(Fit& fit, const std::vector<double>& temperatures) {
  for (std::size_t i = 1; i < temperatures.size(); ++i) {
    if (laws::log10_shift(fit.shift, temperatures[i]) <= laws::log10_shift(fit.shift, temperatures[i - 1])) continue;
    fit.warnings.push_back(
        fmt::format("a_T rises from {} to {} degrees C, as if the material were stiffer when warm; the temperatures "
                    "may be in the wrong rows",
                    temperatures[i - 1], temperatures[i]));
    return;
  }
}

}  // namespace
}  // namespace fitting

Fit fit_modulus(const ModulusData& data, const FitOptions& options) {
  using namespace fitting;
  Problem problem = make_problem(data, options);
  Fit fit;
  fit.options = options;
  fit.temperatures = data.temperatures;
  if (data.temperatures) fit.options.reference_temperature = problem.wanted_reference;
  fit.deviations = data.deviations;
  Chain fitted = fit_any(problem, data, fit);
  move_reference(problem, data, fitted);
  // A free shift has one factor per isotherm. The isotherm of the reference temperature is then named by the
  // temperature that the user gives. This temperature may differ by tenths of a kelvin from the mean of the isotherm's
  // readings.
  if (options.shift == ShiftKind::free) problem.temperatures[problem.wanted_isotherm] = problem.wanted_reference;
  sort_units(fitted.unknowns, fitted.minimum.theta);
  if (options.model == FitModel::kelvin) {
    fit.model = chain_of(fitted.unknowns, fitted.minimum.theta);
  } else {
    fit.model = analogue_of(fitted.unknowns, fitted.minimum.theta);
  }
  fit.shift = shift_of(fitted.unknowns, fitted.minimum.theta, problem.temperatures);
  warn_of_shift(fit, problem.temperatures);
  fit.misfit = fitted.minimum.misfit;
  fit.degrees_of_freedom = static_cast<double>(2 * problem.targets.size() - fitted.unknowns.count());
  add_statistics(problem, fitted, fit);
  add_points(problem, data, fitted, fit);
  warn_of_outliers(problem, fit);
  if (fit.errors.e_star_rms > 0.1) {
    fit.warnings.push_back(
        fmt::format("the fit misses |E*| by {:.3g} % (rms); possible causes: too few measurements for more parameters, "
                    "temperatures in the wrong rows, or moduli that are not of one linear material",
                    100 * fit.errors.e_star_rms));
  }
  if (fit.deviations && fit.misfit > 2 * fit.degrees_of_freedom + 10) {
    fit.warnings.push_back(
        fmt::format("the misfit is {:.3g} times the misfit that the standard deviations of the data allow: "
                    "the model or the deviations are wrong, and the confidence bands are too narrow",
                    fit.misfit / fit.degrees_of_freedom));
  }
  return fit;
}

}  // namespace macadam
