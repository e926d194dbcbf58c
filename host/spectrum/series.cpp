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

PronySeries laws::GeneralisedKelvin::prony() const {
  // At s = −r the compliance 1/E_m − 1/(r·C_m) + Σ 1/(E_l − r·C_l) increases from −∞ to ∞ between two poles, and also
  // beyond the last pole. The poles of k*(s) are the zeros of this compliance.
  struct Pole {
    double rate, E, C;
  };
  std::vector<Pole> poles;
  for (std::size_t l = 0; l < E.size(); ++l) poles.push_back({E[l] / C[l], E[l], C[l]});
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
  const bool flows = std::isfinite(C_m);
  const auto compliance = [&](double r) {
    double out = 1 / E_m - (flows ? 1 / (r * C_m) : 0);
    for (const Pole& p : apart) out += 1 / (p.E - r * p.C);
    return out;
  };
  const auto slope = [&](double r) {  // derivative by r
    double out = flows ? 1 / (r * r * C_m) : 0;
    for (const Pole& p : apart) out += p.C / ((p.E - r * p.C) * (p.E - r * p.C));
    return out;
  };
  PronySeries out;
  double sum = 0;
  for (std::size_t i = 0; i <= apart.size(); ++i) {
    if (i == 0 && !flows) continue;  // without a dashpot the first pole is not at 0, and no zero lies before it
    const bool last = i == apart.size();
    const double fastest = apart.empty() ? E_m / C_m : apart.back().rate;
    const double low =
        i == 0 ? std::log(apart.empty() ? fastest : apart.front().rate) - beyond : std::log(apart[i - 1].rate);
    const double high = last ? std::log(fastest) + beyond : std::log(apart[i].rate);
    const double r = root(compliance, low, high);
    const double modulus = 1 / (slope(r) * r);
    out.units.push_back({modulus, 1 / r});
    sum += modulus;
  }
  std::sort(out.units.begin(), out.units.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
  double at_rest = 1 / E_m;
  for (const Pole& p : apart) at_rest += 1 / p.E;
  out.long_term = flows ? 0 : 1 / at_rest;
  if (!(std::abs((sum + out.long_term) / E_m - 1) < 1e-9)) {
    throw InputError(
        "relaxation of a contact law", 0, "sum of the moduli of all relaxation terms",
        fmt::format("{:.10g} Pa", sum + out.long_term),
        fmt::format(
            "E_m of the law, {:.10g} Pa; the springs and dashpots of the law differ too much for double precision",
            E_m));
  }
  return out;
}

InputError without_prony(const char* law, bool linear) {
  return InputError("relaxation of a contact law", 0, "law",
                    std::string(law) + (linear ? ", which has no function prony()" : ", which is not linear"),
                    linear ? "a law with the function prony(), its relaxation as a sum of exponentials (laws/law.hpp); "
                             "or method = \"explicit\", which steps any law"
                           : "a linear law; or method = \"explicit\", which steps any law");
}

namespace {

/// Returns the series of a law in order of rising times, with units of equal times joined and without units of modulus
/// 0. \throws InputError naming the law if a unit or the long-term modulus is negative or not finite, or if the series
/// is zero.
PronySeries in_order(PronySeries series, const char* law) {
  const auto refuse = [&](const std::string& found) {
    throw InputError("relaxation of a contact law", 0, std::string("prony() of law ") + law, found,
                     "moduli of at least 0 with positive times, and a long-term modulus of at least 0");
  };
  const auto is_positive = [](double x) { return x > 0 && std::isfinite(x); };
  if (!(series.long_term >= 0) || !std::isfinite(series.long_term))
    refuse(fmt::format("a long-term modulus of {:g} Pa", series.long_term));
  for (const auto& u : series.units) {
    if (!(u.modulus >= 0) || !std::isfinite(u.modulus) || !is_positive(u.time))
      refuse(fmt::format("a unit of {:g} Pa with a time of {:g} s", u.modulus, u.time));
  }
  if (!(series.instantaneous() > 0)) refuse("no unit and no long-term modulus");
  std::sort(series.units.begin(), series.units.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
  std::vector<PronySeries::Unit> apart;
  for (const auto& u : series.units) {
    if (u.modulus == 0) continue;
    if (!apart.empty() && u.time <= apart.back().time * (1 + 1e-12))
      apart.back().modulus += u.modulus;
    else
      apart.push_back(u);
  }
  series.units = std::move(apart);
  return series;
}

}  // namespace

PronySeries prony_series(const Law& law) {
  return std::visit(
      []<class L>(const L& one) -> PronySeries {
        if constexpr (has_prony<L>) {
          PronySeries out = in_order(one.prony(), L::name);
          // A series of another stiffness than the law's own would give results of another material. The constants of
          // a law have at most 1e-9 of rounding error in the series.
          if (!(std::abs(out.instantaneous() / one.instantaneous() - 1) < 1e-8)) {
            throw InputError("relaxation of a contact law", 0, std::string("prony() of law ") + L::name,
                             fmt::format("{:g} Pa for a sudden strain", out.instantaneous()),
                             fmt::format("{:g} Pa, its instantaneous()", one.instantaneous()));
          }
          return out;
        } else {
          throw without_prony(L::name, linear_law<L>);
        }
      },
      law);
}

Law equivalent_law(const PronySeries& relaxation, double alpha, const char* name) {
  const PronySeries series = in_order(relaxation, name);
  if (series.units.empty()) return laws::Elastic{series.long_term, alpha};
  const CreepSeries creep = creep_series(series);
  laws::GeneralisedKelvin out;
  out.E_m = 1 / creep.instantaneous;
  if (creep.fluidity > 0) out.C_m = 1 / creep.fluidity;
  for (const auto& u : creep.units) out.E.push_back(1 / u.compliance), out.C.push_back(u.time / u.compliance);
  out.alpha = alpha;
  if (const auto fault = out.fault())
    throw InputError(std::string("relaxation of law ") + name, 0, "chain", fault->found, fault->expected);
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
