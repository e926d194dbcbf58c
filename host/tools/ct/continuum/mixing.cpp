// SPDX-License-Identifier: GPL-3.0-or-later
// mixing.cpp  Fills a grid with mixtures of the phases.
#include "host/tools/ct/continuum/mixing.hpp"

#include <algorithm>

#include "host/tools/ct/continuum/compression.hpp"

namespace macadam::continuum {
namespace {

/// Returns an elastic constant of a voxel, mixed from the mastic's constant a, the rock's constant b and voids.
Complex mixed(Complex a, Complex b, double rock, double voids, Mixing mixing) {
  const double solid = 1 - voids;
  if (solid < least_material) return 0;
  const double part = std::min(1.0, rock / solid);
  if (mixing == Mixing::stiff) return solid * ((1 - part) * a + part * b);
  return solid / (1 + voids) / ((1 - part) / a + part / b);
}

}  // namespace

Grid<double> grid_of(const PhaseFractions& of, const Material& mastic, const Material& rock, Mixing mixing) {
  const auto rounded = [](int n) { return (n + 7) / 8 * 8; };
  const Size n = of.size;
  Grid<double> out(Size{rounded(n.x), rounded(n.y), n.z});
  for (int k = 0; k < n.z; ++k)
    for (int j = 0; j < n.y; ++j)
      for (int i = 0; i < n.x; ++i) {
        const std::size_t from = n.element(i, j, k), to = out.size.element(i, j, k);
        const double f = of.rock[from], v = of.voids[from];
        const Complex mu = mixed(mastic.mu(), rock.mu(), f, v, mixing);
        out.mu[to] = mu / mastic.modulus;
        out.lambda[to] = (mixed(mastic.bulk(), rock.bulk(), f, v, mixing) - 2.0 / 3 * mu) / mastic.modulus;
      }
  remove_loose_pieces(out);
  return out;
}

}  // namespace macadam::continuum
