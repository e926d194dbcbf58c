// SPDX-License-Identifier: GPL-3.0-or-later
// chain_fit.cpp  Starts of a Kelvin chain by linear least squares in the compliances, and their refinement.
#include "host/fit/chain_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "host/fit/non_negative.hpp"
#include "macadam/error.hpp"

namespace macadam::fitting {
namespace {

using Complex = std::complex<double>;

/// The targets at the reference temperature: ω·a_T.
struct Reduced {
  std::vector<double> omega;
  double lowest = std::numeric_limits<double>::infinity(), highest = 0;
};

Reduced reduced(const Unknowns& unknowns, const std::vector<Target>& targets, const std::vector<double>& shift) {
  std::vector<double> theta(unknowns.of_model(), 0.0);
  theta.insert(theta.end(), shift.begin(), shift.end());
  Reduced out;
  for (const Target& t : targets) {
    out.omega.push_back(t.place.omega * std::exp(log_shift(unknowns, theta.data(), t.place)));
    out.lowest = std::min(out.lowest, out.omega.back());
    out.highest = std::max(out.highest, out.omega.back());
  }
  return out;
}

/// Compliances of spring, dashpot and units, and what the misfit is to first order.
struct Linear {
  double spring = 0, dashpot = 0;
  std::vector<double> tau, unit;
  double misfit = 0;
};

Linear solve_linear(const Unknowns& unknowns, const std::vector<Target>& targets, const Reduced& at,
                    const std::vector<double>& tau) {
  // δ(J*·E*) = δ ln|J*| + i·δ arg J* about J*·E* = 1
  const Eigen::Index fixed = unknowns.flow ? 2 : 1, columns = fixed + std::ssize(tau);
  Eigen::MatrixXd A(2 * std::ssize(targets), columns);
  Eigen::VectorXd b(2 * std::ssize(targets));
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const Target& t = targets[i];
    const Complex modulus = std::polar(std::exp(t.log_modulus), t.phase), s(0, at.omega[i]);
    const auto row = static_cast<Eigen::Index>(2 * i);
    const auto set = [&](Eigen::Index column, Complex compliance) {
      const Complex product = compliance * modulus;
      A(row, column) = product.real() / t.modulus_deviation;
      A(row + 1, column) = product.imag() / t.phase_deviation;
    };
    set(0, 1.0);
    if (unknowns.flow) set(1, 1.0 / s);
    for (std::size_t l = 0; l < tau.size(); ++l) set(fixed + static_cast<Eigen::Index>(l), 1.0 / (1.0 + s * tau[l]));
    b[row] = 1 / t.modulus_deviation;
    b[row + 1] = 0;
  }
  const Eigen::VectorXd x = non_negative_least_squares(A, b);
  Linear out;
  out.spring = x[0];
  if (unknowns.flow) out.dashpot = x[1];
  out.tau = tau;
  out.unit.assign(x.begin() + fixed, x.end());
  out.misfit = (A * x - b).squaredNorm();
  return out;
}

std::vector<double> spaced(double low, double high, std::size_t count) {
  std::vector<double> out;
  for (std::size_t i = 0; i < count; ++i)
    out.push_back(low * std::pow(high / low, (static_cast<double>(i) + 0.5) / static_cast<double>(count)));
  return out;
}

/// Retardation times of a fine grid that carry anything, merged where they are nearest until `count` are left.
std::vector<double> merged(Linear grid, std::size_t count) {
  std::vector<std::pair<double, double>> peaks;  // ln τ, compliance
  const double most = *std::max_element(grid.unit.begin(), grid.unit.end());
  for (std::size_t l = 0; l < grid.unit.size(); ++l)
    if (grid.unit[l] > 1e-9 * most) peaks.emplace_back(std::log(grid.tau[l]), grid.unit[l]);
  while (peaks.size() > count) {
    std::size_t nearest = 0;
    for (std::size_t i = 1; i + 1 < peaks.size(); ++i)
      if (peaks[i + 1].first - peaks[i].first < peaks[nearest + 1].first - peaks[nearest].first) nearest = i;
    auto& [time, weight] = peaks[nearest];
    const auto& [next_time, next_weight] = peaks[nearest + 1];
    time = (time * weight + next_time * next_weight) / (weight + next_weight);
    weight += next_weight;
    peaks.erase(peaks.begin() + static_cast<std::ptrdiff_t>(nearest) + 1);
  }
  std::vector<double> out;
  for (const auto& [time, weight] : peaks) out.push_back(std::exp(time));
  return out;
}

/// Unknowns from compliances; what is zero becomes a spring too stiff to matter, from where refining can come back.
std::vector<double> theta_of(const Unknowns& unknowns, const Linear& linear, const std::vector<double>& shift,
                             const Reduced& at) {
  double sum = linear.spring;
  for (const double unit : linear.unit) sum += unit;
  const double least = 1e-4 * sum;
  std::vector<double> theta{-std::log(std::max(linear.spring, least))};
  if (unknowns.flow) theta.push_back(-std::log(std::max(linear.dashpot, least * at.lowest)));
  for (std::size_t l = 0; l < linear.tau.size(); ++l) {
    theta.push_back(-std::log(std::max(linear.unit[l], least)));
    theta.push_back(theta.back() + std::log(linear.tau[l]));
  }
  theta.insert(theta.end(), shift.begin(), shift.end());
  return theta;
}

}  // namespace

std::vector<Limits> chain_limits(const Unknowns& unknowns, const std::vector<Target>& targets) {
  double soft = std::numeric_limits<double>::infinity(), stiff = -soft, slow = soft, fast = -soft;
  for (const Target& t : targets) {
    soft = std::min(soft, t.log_modulus);
    stiff = std::max(stiff, t.log_modulus);
    slow = std::min(slow, std::log(t.place.omega));
    fast = std::max(fast, std::log(t.place.omega));
  }
  constexpr double wide = 12;  // e^12: 1.6e5, which leaves nothing of a unit that noise could show
  const double shifts = unknowns.shift == ShiftKind::none ? 0 : 25;  // eleven decades for what temperature adds
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

Minimum fit_chain(const Unknowns& unknowns, const std::vector<Target>& targets, const std::vector<Limits>& limits,
                  const std::vector<double>& shift, const Minimum* fewer, double tolerance) {
  const auto units = static_cast<std::size_t>(unknowns.units);
  std::vector<std::vector<double>> starts;
  const auto add = [&](const std::vector<double>& tau, const std::vector<double>& with, const Reduced& at) {
    starts.push_back(theta_of(unknowns, solve_linear(unknowns, targets, at, tau), with, at));
  };
  const Reduced at = reduced(unknowns, targets, shift);
  const double shortest = 0.1 / at.highest, longest = 10 / at.lowest;
  const auto grid = static_cast<std::size_t>(std::ceil(4 * std::log10(longest / shortest)));
  if (units == 0) {
    add({}, shift, at);
  } else {
    const std::vector<double> few = merged(solve_linear(unknowns, targets, at, spaced(shortest, longest, grid)), units);
    if (few.size() == units) add(few, shift, at);
    add(spaced(shortest, longest, units), shift, at);
  }
  if (fewer) {
    const std::vector<double> own(fewer->theta.end() - static_cast<std::ptrdiff_t>(unknowns.of_shift()),
                                  fewer->theta.end());
    const Reduced there = reduced(unknowns, targets, own);
    std::vector<double> tau;
    for (std::size_t at_unit = unknowns.flow ? 2 : 1; tau.size() + 1 < units; at_unit += 2)
      tau.push_back(std::exp(fewer->theta[at_unit + 1] - fewer->theta[at_unit]));
    tau.push_back(0);
    double best = std::numeric_limits<double>::infinity(), added = 0;
    for (const double more : spaced(shortest, longest, grid / 2)) {
      tau.back() = more;
      const double misfit = solve_linear(unknowns, targets, there, tau).misfit;
      if (misfit < best) best = misfit, added = more;
    }
    tau.back() = added;
    add(tau, own, there);
  }
  std::optional<Minimum> out;
  for (std::vector<double>& start : starts) {
    Minimum minimum = refine(unknowns, targets, limits, std::move(start), tolerance);
    if (!out || minimum.misfit < out->misfit) out = std::move(minimum);
  }
  if (!std::isfinite(out->misfit)) throw RunError("fit: no start of the chain gives a finite misfit");
  return *out;
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
