// SPDX-License-Identifier: GPL-3.0-or-later
// cell_pressure.cpp  Each particle sums the forces of its own contacts in a fixed order, so that the result does not
// depend on the number of threads.
#include "host/harmonic/cell_pressure.hpp"

namespace macadam::harmonic {

CentroidLever centroid_lever(const Contact& c, bool first_end) {
  return {first_end ? c.arm_a : -c.arm_b, c.moments.s / c.moments.a, c.moments.t / c.moments.a};
}

Vector cell_pressures(const ContactNetwork& network, const PairStiffness& stiffness, const Vector& motion,
                      const WallMotion& wall) {
  Vector out(network.cells.size());
// dynamic, because large particles have hundreds of contacts each and have consecutive numbers
#pragma omp parallel for schedule(dynamic, 64)
  for (std::size_t i = 0; i < out.size(); ++i) {
    const CellStiffness& cell = network.cells[i];
    if (cell.weight == 0) continue;
    Complex sum = 0;
    for (const std::uint32_t number : network.row(i)) {
      const Contact& c = network.contacts[number];
      const bool is_a = static_cast<std::size_t>(c.a) == i;
      const CentroidLever lever = centroid_lever(c, is_a);
      const auto on_a = facet_load(c, stiffness, relative_motion(c, motion, wall));
      const Complex on_lever = on_a.n * lever.n + on_a.s * lever.s + on_a.t * lever.t;
      sum += is_a ? on_lever : -on_lever;
    }
    out[i] = cell.weight / stiffness.k[static_cast<std::size_t>(cell.law)] * sum;
  }
  return out;
}

std::array<Complex, 3> pressure_shift(const Contact& c, const Vector& pressures) {
  if (pressures.empty()) return {};
  std::array<Complex, 3> out{};
  const auto add = [&](std::int32_t end, double sign) {
    if (end < 0) return;
    const CentroidLever lever = centroid_lever(c, sign > 0);
    const Complex p = sign * pressures[static_cast<std::size_t>(end)];
    out[0] += p * lever.n, out[1] += p * lever.s, out[2] += p * lever.t;
  };
  add(c.a, 1), add(c.b, -1);
  return out;
}

void add_pressure_shift(const Contact& c, const Vector& pressures, std::array<Complex, 6>& u) {
  if (pressures.empty()) return;
  const auto shift = pressure_shift(c, pressures);
  u[0] += shift[0], u[3] += shift[1], u[4] += shift[2];
}

}  // namespace macadam::harmonic
