// SPDX-License-Identifier: GPL-3.0-or-later
// extrapolation.cpp  Evaluates polynomials in the difference of the mixing rules where this difference is zero.
#include "host/tools/ct/continuum/extrapolation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace macadam::continuum {
namespace {

/// Returns the modulus and Poisson's ratio at g = 0 of Lagrange polynomials through the `count` finest sizes.
std::array<Complex, 2> limit(const Sizes& stiff, const Sizes& soft, std::size_t count) {
  const std::size_t first = soft.size() - count;
  std::array<Complex, 2> out{};
  for (std::size_t a = first; a < soft.size(); ++a) {
    Complex weight = 1;
    for (std::size_t b = first; b < soft.size(); ++b) {
      const Complex ga = stiff[a].modulus - soft[a].modulus, gb = stiff[b].modulus - soft[b].modulus;
      if (b != a) weight *= gb / (gb - ga);
    }
    out[0] += weight * soft[a].modulus, out[1] += weight * soft[a].poisson;
  }
  return out;
}

}  // namespace

Limit extrapolated(const Sizes& stiff, const Sizes& soft) {
  const std::size_t last = soft.size() - 1;
  const auto gap = [&](std::size_t a) { return std::abs(stiff[a].modulus - soft[a].modulus); };
  const auto apart = [](Complex a, Complex b) { return std::abs(std::abs(a) - std::abs(b)); };
  const auto turned = [](Complex a, Complex b) { return std::abs(std::arg(a / b)); };
  const SizeResult& finest = soft[last];
  Limit out{finest.modulus, finest.poisson, gap(last), gap(last) / std::abs(finest.modulus)};
  if (gap(last) < 1e-9 * std::abs(finest.modulus)) {  // no voxel is cut
    out.uncertainty = apart(finest.modulus, soft[last - 1].modulus);
    out.phase_uncertainty = turned(finest.modulus, soft[last - 1].modulus);
    return out;
  }
  if (gap(last) > 0.8 * gap(last - 1)) return out;
  const bool three = last > 1 && gap(last - 1) <= 0.8 * gap(last - 2);
  const Complex line = limit(stiff, soft, 2)[0];
  const auto best = limit(stiff, soft, three ? 3 : 2);
  return {best[0], best[1], std::max(apart(best[0], line), apart(line, finest.modulus)),
          std::max(turned(best[0], line), turned(line, finest.modulus))};
}

}  // namespace macadam::continuum
