// SPDX-License-Identifier: GPL-3.0-or-later
// chain_starts.cpp  Computes starting values of a Kelvin chain by linear least squares in the compliances.
#include "host/tools/fit/chain_starts.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "host/base/non_negative_least_squares.hpp"

namespace macadam::fitting {
namespace {

using Complex = std::complex<double>;

/// Frequencies of the targets at the reference temperature, ω·a_T, and their range.
struct Reduced {
  std::vector<double> omega;
  double lowest = std::numeric_limits<double>::infinity(), highest = 0;
};

/// Returns the reduced frequencies of the targets for given unknowns of the shift.
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

/// Compliances of spring, dashpot and units at given retardation times, and the misfit to first order.
struct Linear {
  double spring = 0, dashpot = 0;
  std::vector<double> tau, unit;
  double misfit = 0;
};

/// Finds the compliances for given retardation times.
Linear solve_linear(const Unknowns& unknowns, const std::vector<Target>& targets, const Reduced& at,
                    const std::vector<double>& tau) {
  // residuals are linear in J*: near J*·E* = 1, δ(J*·E*) = δ ln|J*| + i·δ arg J*
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

/// Returns `count` values between low and high, equally spaced in the logarithm.
std::vector<double> spaced(double low, double high, std::size_t count) {
  std::vector<double> out;
  for (std::size_t i = 0; i < count; ++i)
    out.push_back(low * std::pow(high / low, (static_cast<double>(i) + 0.5) / static_cast<double>(count)));
  return out;
}

/// Returns the retardation times of a fine grid that carry a compliance. If there are more than `count`, merges the
/// nearest two until `count` are left.
std::vector<double> merged(Linear grid, std::size_t count) {
  std::vector<std::pair<double, double>> peaks;  // ln τ, compliance
  const double largest = *std::max_element(grid.unit.begin(), grid.unit.end());
  for (std::size_t l = 0; l < grid.unit.size(); ++l)
    if (grid.unit[l] > 1e-9 * largest) peaks.emplace_back(std::log(grid.tau[l]), grid.unit[l]);
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

/// Returns θ for given compliances. A compliance of zero becomes a very stiff spring. Such a spring hardly changes the
/// curve, and the refinement can still make it softer.
std::vector<double> theta_of(const Unknowns& unknowns, const Linear& linear, const std::vector<double>& shift,
                             const Reduced& at) {
  double sum = linear.spring;
  for (const double unit : linear.unit) sum += unit;
  const double smallest = 1e-4 * sum;
  std::vector<double> theta{-std::log(std::max(linear.spring, smallest))};
  if (unknowns.flow) theta.push_back(-std::log(std::max(linear.dashpot, smallest * at.lowest)));
  for (std::size_t l = 0; l < linear.tau.size(); ++l) {
    theta.push_back(-std::log(std::max(linear.unit[l], smallest)));
    theta.push_back(theta.back() + std::log(linear.tau[l]));
  }
  theta.insert(theta.end(), shift.begin(), shift.end());
  return theta;
}

/// Collects starts of one chain, from linear solutions and from smaller chains.
class Starts {
 public:
  Starts(const Unknowns& unknowns, const std::vector<Target>& targets, const std::vector<double>& shift)
      : unknowns_(unknowns), targets_(targets), shift_(shift) {
    const auto units = static_cast<std::size_t>(unknowns.units);
    const Reduced at = reduced(unknowns, targets, shift);
    if (units == 0) {
      add({}, shift, at);
      return;
    }
    const double low = 1 / at.highest, high = 1 / at.lowest;
    // Grids of different density merge into different times; which start reaches the lowest misfit depends on the data.
    for (const double per_decade : {2.0, 4.0, 8.0}) {
      const std::vector<double> grid = spaced(0.1 * low, 10 * high, grid_points(at, per_decade));
      const std::vector<double> times = merged(solve_linear(unknowns, targets, at, grid), units);
      if (times.size() == units) add(times, shift, at);
    }
    for (const double beyond : {1.0, 10.0}) add(spaced(low / beyond, high * beyond, units), shift, at);
  }

  /// Adds starts from another chain that is not longer. If it has fewer units, a retardation time is added at each of
  /// the three places where it lowers the linear misfit most, one start per place.
  void add_from(const Chain& other) {
    const auto units = static_cast<std::size_t>(unknowns_.units);
    if (other.unknowns.units == unknowns_.units && other.unknowns.flow == unknowns_.flow)
      thetas_.push_back(other.minimum.theta);
    std::vector<double> shift = shift_of(other);
    Reduced at = reduced(unknowns_, targets_, shift);
    // the shift of a chain with far too few units may be useless
    if (!is_sensible(at)) shift = shift_, at = reduced(unknowns_, targets_, shift);
    const std::vector<double> tau = times_of(other);
    if (tau.size() >= units) return add(tau, shift, at);
    constexpr std::size_t most_added = 3;
    const std::vector<double> places = places_for_one(tau, at);
    for (std::size_t i = 0; i < std::min(places.size(), most_added); ++i) {
      std::vector<double> longer = tau;
      longer.push_back(places[i]);
      while (longer.size() < units) longer.push_back(places_for_one(longer, at).front());
      add(longer, shift, at);
    }
  }

  const std::vector<std::vector<double>>& thetas() const { return thetas_; }

  /// Returns the retardation times of a chain.
  static std::vector<double> times_of(const Chain& chain) {
    std::vector<double> out;
    const std::vector<double>& theta = chain.minimum.theta;
    for (std::size_t i = chain.unknowns.flow ? 2 : 1; i < chain.unknowns.of_model(); i += 2)
      out.push_back(std::exp(theta[i + 1] - theta[i]));
    return out;
  }
  /// Returns the unknowns of the shift of a chain.
  static std::vector<double> shift_of(const Chain& chain) {
    const std::vector<double>& theta = chain.minimum.theta;
    return {theta.begin() + static_cast<std::ptrdiff_t>(chain.unknowns.of_model()), theta.end()};
  }

 private:
  /// Returns whether the reduced frequencies are plausible: within 60 decades.
  static bool is_sensible(const Reduced& at) { return at.lowest > 0 && at.highest / at.lowest < 1e60; }

  /// Returns the times of a grid that, added to the retardation times, lower the linear misfit more than their
  /// neighbours in the grid; the best time comes first.
  std::vector<double> places_for_one(std::vector<double> tau, const Reduced& at) const {
    const std::vector<double> grid = spaced(0.1 / at.highest, 10 / at.lowest, grid_points(at, 2));
    std::vector<double> misfit;
    tau.push_back(0);
    for (const double one : grid) {
      tau.back() = one;
      misfit.push_back(solve_linear(unknowns_, targets_, at, tau).misfit);
    }
    std::vector<std::pair<double, double>> lowest;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const bool falls = i == 0 || misfit[i] <= misfit[i - 1],
                 rises = i + 1 == grid.size() || misfit[i] < misfit[i + 1];
      if (falls && rises) lowest.emplace_back(misfit[i], grid[i]);
    }
    std::sort(lowest.begin(), lowest.end());
    std::vector<double> out;
    for (const auto& [value, time] : lowest) out.push_back(time);
    if (out.empty()) out.push_back(grid.front());
    return out;
  }

  /// Returns the number of points of a grid that extends one decade beyond the frequencies at both ends.
  static std::size_t grid_points(const Reduced& at, double per_decade) {
    return static_cast<std::size_t>(std::ceil(per_decade * (2 + std::log10(at.highest / at.lowest))));
  }
  /// Adds the start with given retardation times.
  void add(const std::vector<double>& tau, const std::vector<double>& shift, const Reduced& at) {
    thetas_.push_back(theta_of(unknowns_, solve_linear(unknowns_, targets_, at, tau), shift, at));
  }

  const Unknowns& unknowns_;
  const std::vector<Target>& targets_;
  const std::vector<double>& shift_;
  std::vector<std::vector<double>> thetas_;
};

}  // namespace

std::vector<std::vector<double>> chain_starts(const Unknowns& unknowns, const std::vector<Target>& targets,
                                              const std::vector<double>& shift,
                                              const std::vector<const Chain*>& known) {
  Starts starts(unknowns, targets, shift);
  for (const Chain* chain : known)
    if (chain->unknowns.units <= unknowns.units) starts.add_from(*chain);
  return starts.thetas();
}

}  // namespace macadam::fitting
