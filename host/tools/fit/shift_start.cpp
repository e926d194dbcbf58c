// SPDX-License-Identifier: GPL-3.0-or-later
// shift_start.cpp  Moves the curves of |E*| at different temperatures onto each other along the frequency axis, and
// fits the shift law to these shifts.
#include "host/tools/fit/shift_start.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace macadam::fitting {
namespace {

/// (log10 of the angular frequency, ln |E*|) at one temperature, sorted by frequency.
using Curve = std::vector<std::pair<double, double>>;

/// Returns the mean of log10 f_cold − log10 f_hot at equal |E*|, over the moduli that both curves have. If they have
/// none in common, returns the distance from the hot curve's last point to the cold curve's first, extrapolated along
/// the steeper of the two slopes; `otherwise` if both curves are flat.
double distance(const Curve& cold, const Curve& hot, double otherwise) {
  double sum = 0;
  int count = 0;
  for (const auto& [x, y] : hot) {
    for (std::size_t i = 1; i < cold.size(); ++i) {
      const auto& [x0, y0] = cold[i - 1];
      const auto& [x1, y1] = cold[i];
      if (!(y0 <= y && y <= y1 && y0 < y1)) continue;
      sum += x0 + (x1 - x0) * (y - y0) / (y1 - y0) - x;
      ++count;
      break;
    }
  }
  if (count > 0) return sum / count;
  const auto slope = [](const Curve& c) {
    return c.size() > 1 ? (c.back().second - c.front().second) / (c.back().first - c.front().first) : 0.0;
  };
  const double mean = std::max(slope(cold), slope(hot));
  if (!(mean > 1e-3)) return otherwise;
  return cold.front().first - hot.back().first - (cold.front().second - hot.back().second) / mean;
}

/// Returns, for every temperature, the shift log10 a_T with which the curves of all temperatures form one master curve.
/// The shift of the first temperature is 0.
std::vector<double> master_curve_shift(const std::vector<Target>& targets, const std::vector<double>& temperatures) {
  std::vector<Curve> curves(temperatures.size());
  for (const Target& t : targets) curves[t.place.isotherm].emplace_back(std::log10(t.place.omega), t.log_modulus);
  for (Curve& curve : curves) std::sort(curve.begin(), curve.end());
  std::vector<double> out{0};
  // `usual`: decades per kelvin of a usual binder at room temperature, for flat curves. `largest_rate`: more decades
  // per kelvin than any polymer has; without this limit, nearly flat curves with different moduli would be shifted by
  // thousands of decades. `range`: limit of all steps together [decades], so that every a_T is within the range of a
  // double.
  constexpr double usual = 0.1, largest_rate = 1, range = 150;
  for (std::size_t i = 1; i < curves.size(); ++i) {
    const double kelvins = temperatures[i] - temperatures[i - 1];
    const double largest = std::min(largest_rate * kelvins, range / static_cast<double>(curves.size() - 1));
    out.push_back(out.back() + std::clamp(distance(curves[i - 1], curves[i], -usual * kelvins), -largest, 0.0));
  }
  return out;
}

}  // namespace

std::vector<double> start_shift(const Unknowns& u, const std::vector<Target>& targets,
                                const std::vector<double>& temperatures) {
  if (u.shift == ShiftKind::none) return {};
  std::vector<double> log_a = master_curve_shift(targets, temperatures);
  // Adds a constant to log_a so that it is 0 at the reference temperature. If that temperature was not measured, log_a
  // is interpolated linearly.
  const auto above = std::clamp<std::ptrdiff_t>(
      std::lower_bound(temperatures.begin(), temperatures.end(), u.reference_temperature) - temperatures.begin(), 1,
      std::ssize(temperatures) - 1);
  const auto b = static_cast<std::size_t>(above), a = b - 1;
  const double chord = (log_a[b] - log_a[a]) / (temperatures[b] - temperatures[a]);
  const double zero = log_a[a] + chord * (u.reference_temperature - temperatures[a]);
  for (double& l : log_a) l -= zero;
  if (u.shift == ShiftKind::free) {
    log_a.erase(log_a.begin() + static_cast<std::ptrdiff_t>(u.reference_isotherm));
    return log_a;
  }
  if (u.shift == ShiftKind::arrhenius) {
    double product = 0, square = 0;
    for (std::size_t i = 0; i < log_a.size(); ++i) {
      const double x = log10_shift(laws::Arrhenius{1, u.reference_temperature}, temperatures[i]);
      product += x * log_a[i];
      square += x * x;
    }
    return {std::log(std::max(product / square, 1e4))};
  }
  // Solves WLF as a linear system, y·d = −C1·d − C2·y, with y = log10 a_T and d = T − T_r. If the result is not
  // plausible, takes a usual C2 and the C1 that fits best.
  const double coldest = u.reference_temperature - temperatures.front();
  const auto n = static_cast<Eigen::Index>(log_a.size());
  Eigen::MatrixXd A(n, 2);
  Eigen::VectorXd rhs(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double d = temperatures[static_cast<std::size_t>(i)] - u.reference_temperature;
    const double y = log_a[static_cast<std::size_t>(i)];
    A.row(i) << -d, -y;
    rhs[i] = y * d;
  }
  Eigen::Vector2d c = A.colPivHouseholderQr().solve(rhs);
  if (!(c[0] > 0 && c[1] > 1.2 * std::max(coldest, 1.0) && c[1] < 1e4)) {
    c[1] = std::max(130.0, 2 * coldest);
    double product = 0, square = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double d = -A(i, 0), x = -d / (c[1] + d);
      product += x * -A(i, 1);
      square += x * x;
    }
    c[0] = std::max(product / square, 0.1);
  }
  return {std::log(c[0]), std::log(c[1])};
}

std::vector<double> convert_shift(const Unknowns& u, const std::vector<double>& theta, ShiftKind larger,
                                  const std::vector<double>& temperatures) {
  std::vector<double> out(theta.begin(), theta.begin() + static_cast<std::ptrdiff_t>(u.of_model()));
  if (larger == ShiftKind::wlf) {
    // With temperatures in kelvins, 1/T − 1/T_r = −(T − T_r)/(T_r·T). So Arrhenius is WLF with C2 = T_r and
    // C1 = E_a/(R·T_r·ln 10).
    const double reference = laws::zero_celsius + u.reference_temperature;
    out.push_back(theta[u.of_model()] - std::log(laws::gas_constant * reference * std::numbers::ln10));
    out.push_back(std::log(reference));
    return out;
  }
  for (std::size_t i = 0; i < temperatures.size(); ++i) {
    if (i != u.reference_isotherm)
      out.push_back(log_shift(u, theta.data(), {1, temperatures[i], i}) / std::numbers::ln10);
  }
  return out;
}

std::vector<Limits> shift_limits(const Unknowns& u, const std::vector<double>& temperatures) {
  switch (u.shift) {
    case ShiftKind::wlf: {
      // C2 + T − T_r must be positive at every temperature
      const double smallest_c2 = std::max(u.reference_temperature - temperatures.front() + 0.5, 0.5);
      return {{std::log(1e-3), std::log(1e4)}, {std::log(smallest_c2), std::log(1e5)}};
    }
    case ShiftKind::arrhenius:
      return {{std::log(1e2), std::log(1e8)}};
    default:
      return std::vector<Limits>(u.of_shift(), {-30, 30});
  }
}

}  // namespace macadam::fitting
