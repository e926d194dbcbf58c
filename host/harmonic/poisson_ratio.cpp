// SPDX-License-Identifier: GPL-3.0-or-later
// poisson_ratio.cpp  Computes the Poisson's ratio of a specimen from the motion of its free sides.
#include "host/network/free_sides.hpp"
#include "macadam/harmonic.hpp"

namespace macadam {

std::optional<std::complex<double>> poisson_ratio(const Specimen& specimen, const Tessellation& cells,
                                                  const HarmonicResult& state) {
  using Complex = std::complex<double>;
  const FreeSides sides(specimen, cells);
  if (!sides.known()) return {};
  const auto number = [&](std::size_t i) { return static_cast<std::size_t>(sides.particles()[i]); };
  // The opening makes the stress on a free facet zero, 2μ/h·opening + pressure = 0 (model, section 26). The top wall
  // moves by 1, so the contraction is the ratio.
  return sides.contraction<Complex>(
      [&](std::size_t i) { return &state.motion[6 * number(i)]; },
      [&](std::size_t i) { return state.pressures.empty() ? Complex() : state.pressures[number(i)]; });
}

}  // namespace macadam
