// SPDX-License-Identifier: GPL-3.0-or-later
// series.cpp  Evaluates sums of exponentials, and converts laws to relaxation and relaxation to creep. The poles of a
// stiffness are the zeros of the corresponding compliance, and vice versa. Each zero lies between two poles, where
// bisection finds it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "macadam/error.hpp"
#include "macadam/spectrum.hpp"

namespace macadam {

using Complex = std::complex<double>;

double PronySeries::instantaneous() const {
  double out = long_term;
  for (const Unit& u : units) out += u.modulus;
  return out;
}

double PronySeries::modulus(double t) const {
  if (t < 0) return 0;
  double out = long_term;
  for (const Unit& u : units) out += u.modulus * std::exp(-t / u.time);
  return out;
}

double PronySeries::after_ramp(double t, double duration) const {
  if (duration == 0 || t < 0) return modulus(t);
  const double ramp = std::min(t, duration), held = t - ramp;
  double out = long_term * ramp;
  for (const Unit& u : units) out -= u.modulus * u.time * std::exp(-held / u.time) * std::expm1(-ramp / u.time);
  return out / duration;
}

Complex PronySeries::stiffness(Complex s) const {
  Complex out = long_term;
  for (const Unit& u : units) out += u.modulus * s * u.time / (1.0 + s * u.time);
  return out;
}

double CreepSeries::compliance(double t) const {
  if (t < 0) return 0;
  double out = instantaneous + fluidity * t;
  for (const Unit& u : units) out -= u.compliance * std::expm1(-t / u.time);
  return out;
}

namespace {

/// Returns x − 1 + e^(−x). For small x (a unit much slower than its ramp) a power series is used, because x²/2 would be
/// the difference of two numbers near x.
double lag(double x) {
  if (x > 0.5) return x + std::expm1(-x);
  double out = 0;
  for (int n = 16; n >= 2; --n) out = (1 - out) * x / n;  // Horner's scheme: x²/2·(1 − x/3·(1 − x/4·(…
  return out * x;
}

}  // namespace

double CreepSeries::after_ramp(double t, double duration) const {
  if (duration == 0 || t < 0) return compliance(t);
  const double ramp = std::min(t, duration), held = t - ramp;
  double out = instantaneous * ramp + fluidity * ramp * (0.5 * ramp + held);
  for (const Unit& u : units) {
    out += u.compliance * (u.time * std::exp(-held / u.time) * lag(ramp / u.time) - ramp * std::expm1(-held / u.time));
  }
  return out / duration;
}

namespace {

/// Returns the root r of a function that increases from below zero at ln r = low to above zero at ln r = high. Uses
/// bisection of ln r, because the function may be infinite at both ends.
template <class F>
double root(F&& f, double low, double high) {
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (f(std::exp(middle)) < 0 ? low : high) = middle;
  }
  return std::exp(0.5 * (low + high));
}

/// How far beyond the outermost pole a root is searched, as a natural logarithm (a factor of 1e26). A unit that is even
/// farther away would contribute nothing.
constexpr double beyond = 60;

}  // namespace

PronySeries prony_series(const Law& law) {
  if (const auto* elastic = std::get_if<laws::Elastic>(&law)) return {elastic->E, {}};
  if (!std::holds_alternative<laws::GeneralisedKelvin>(law)) {
    throw InputError(
        "relaxation of a contact law", 0, "law", std::visit([](const auto& l) { return l.name; }, law),
        fmt::format("{} or {}, whose relaxation times are known", laws::Elastic::name, laws::GeneralisedKelvin::name));
  }
  const auto& chain = std::get<laws::GeneralisedKelvin>(law);
  // At s = −r the compliance 1/E_m − 1/(r·C_m) + Σ 1/(E_l − r·C_l) increases from −∞ to ∞ between two poles, and also
  // beyond the last pole. The poles of k*(s) are the zeros of this compliance.
  struct Pole {
    double rate, E, C;
  };
  std::vector<Pole> poles;
  for (std::size_t l = 0; l < chain.E.size(); ++l) poles.push_back({chain.E[l] / chain.C[l], chain.E[l], chain.C[l]});
  std::sort(poles.begin(), poles.end(), [](const Pole& a, const Pole& b) { return a.rate < b.rate; });
  // units with the same time are merged into one: two equal poles would have no zero between them
  std::vector<Pole> apart;
  for (const Pole& p : poles) {
    if (!apart.empty() && p.rate <= apart.back().rate * (1 + 1e-12)) {
      Pole& same = apart.back();
      const double compliance = 1 / same.E + 1 / p.E;
      same.E = 1 / compliance, same.C = same.E / same.rate;
    } else {
      apart.push_back(p);
    }
  }
  const bool flows = std::isfinite(chain.C_m);
  const auto compliance = [&](double r) {
    double out = 1 / chain.E_m - (flows ? 1 / (r * chain.C_m) : 0);
    for (const Pole& p : apart) out += 1 / (p.E - r * p.C);
    return out;
  };
  const auto slope = [&](double r) {  // derivative by r
    double out = flows ? 1 / (r * r * chain.C_m) : 0;
    for (const Pole& p : apart) out += p.C / ((p.E - r * p.C) * (p.E - r * p.C));
    return out;
  };
  PronySeries out;
  double sum = 0;
  for (std::size_t i = 0; i <= apart.size(); ++i) {
    if (i == 0 && !flows) continue;  // without a dashpot the first pole is not at 0, and no zero lies before it
    const bool last = i == apart.size();
    const double fastest = apart.empty() ? chain.E_m / chain.C_m : apart.back().rate;
    const double low =
        i == 0 ? std::log(apart.empty() ? fastest : apart.front().rate) - beyond : std::log(apart[i - 1].rate);
    const double high = last ? std::log(fastest) + beyond : std::log(apart[i].rate);
    const double r = root(compliance, low, high);
    const double modulus = 1 / (slope(r) * r);
    out.units.push_back({modulus, 1 / r});
    sum += modulus;
  }
  std::sort(out.units.begin(), out.units.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
  double at_rest = 1 / chain.E_m;
  for (const Pole& p : apart) at_rest += 1 / p.E;
  out.long_term = flows ? 0 : 1 / at_rest;
  if (!(std::abs((sum + out.long_term) / chain.E_m - 1) < 1e-9)) {
    throw InputError(
        "relaxation of a contact law", 0, "sum of the moduli of all relaxation terms",
        fmt::format("{:.10g} Pa", sum + out.long_term),
        fmt::format(
            "E_m of the law, {:.10g} Pa; the springs and dashpots of the law differ too much for double precision",
            chain.E_m));
  }
  return out;
}

CreepSeries creep_series(const PronySeries& relaxation) {
  if (!(relaxation.instantaneous() > 0) || !std::isfinite(relaxation.instantaneous())) {
    throw InputError("creep of a Prony series", 0, "instantaneous modulus of the series",
                     fmt::format("{:g} Pa", relaxation.instantaneous()), "a positive modulus");
  }
  // At s = −r, E*(s) = E_∞ − Σ g·r·τ/(1 − r·τ) decreases from E_∞ at r = 0, and from ∞ to −∞ between two poles; beyond
  // the last pole it stays positive. The poles of J* = 1/E* are the zeros of E*.
  const auto minus_modulus = [&](double r) {
    double out = -relaxation.long_term;
    for (const auto& u : relaxation.units) out += u.modulus * r * u.time / (1 - r * u.time);
    return out;
  };
  const auto slope = [&](double r) {
    double out = 0;
    for (const auto& u : relaxation.units) out += u.modulus * u.time / ((1 - r * u.time) * (1 - r * u.time));
    return out;
  };
  CreepSeries out;
  out.instantaneous = 1 / relaxation.instantaneous();
  const auto& units = relaxation.units;
  if (relaxation.long_term == 0) {
    double viscosity = 0;
    for (const auto& u : units) viscosity += u.modulus * u.time;
    out.fluidity = 1 / viscosity;
  }
  for (std::size_t i = 0; i < units.size(); ++i) {
    // the zero next to the pole of this unit, on the side of longer times
    const bool slowest = i + 1 == units.size();
    if (slowest && relaxation.long_term == 0) continue;  // this zero is at r = 0: the dashpot
    const double high = -std::log(units[i].time), low = slowest ? high - beyond : -std::log(units[i + 1].time);
    const double r = root(minus_modulus, low, high);
    out.units.push_back({1 / (slope(r) * r), 1 / r});
  }
  return out;
}

std::vector<double> log_range(double first, double last, int per_decade) {
  // If last/first overflows, the logarithms are subtracted. Otherwise the logarithm of the ratio is used, because it
  // loses fewer digits.
  const bool far_apart = !std::isfinite(last / first);
  const double decades = far_apart ? std::log10(last) - std::log10(first) : std::log10(last / first);
  const auto at = [&](double decade) {
    return far_apart ? std::pow(10.0, std::log10(first) + decade) : first * std::pow(10.0, decade);
  };
  const int count = std::max(1, static_cast<int>(std::ceil(per_decade * decades - 1e-9)));
  std::vector<double> out;
  for (int i = 0; i < count; ++i) out.push_back(at(decades * i / count));
  out.push_back(last);
  return out;
}

}  // namespace macadam
