// SPDX-License-Identifier: GPL-3.0-or-later
// main.cpp  Example of a new drive (the prescribed motion of a wall): a sawtooth moves the top wall of a specimen up
// and down while a platen presses on its side. The program takes samples during the run and reads the contact forces at
// the end.
#include <macadam/macadam.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace {

using namespace macadam;

/// Displacement that rises from 0 to `height` and falls back to 0. Both changes are linear and take `period` steps
/// each.
struct Sawtooth final : Drive {
  double height, step;
  std::int64_t period;

  Sawtooth(double height, double step, std::int64_t period) : height(height), step(step), period(period) {}
  double dt() const override { return step; }
  double shortest_time() const override { return static_cast<double>(period) * step; }
  double fastest() const override { return height / shortest_time(); }
  double value(std::int64_t k) const override {
    const std::int64_t in = std::max<std::int64_t>(k, 0) % (2 * period);
    return height * static_cast<double>(std::min(in, 2 * period - in)) / static_cast<double>(period);
  }
};

/// Returns a specimen of 3 × 3 × 4 spheres in cubic cells of 1 mm.
Specimen make_block() {
  const int nx = 3, ny = 3, nz = 4;
  const double side = 1e-3;
  Specimen out;
  out.box.size = {nx * side, ny * side, nz * side};
  for (int i = 0; i < nx * ny * nz; ++i) {
    out.centre.push_back({(i % nx + 0.5) * side, (i / nx % ny + 0.5) * side, (i / (nx * ny) + 0.5) * side});
    out.radius.push_back(side / 2);
    out.phase.push_back(Phase::mastic);
    out.body.push_back(-1);
  }
  return out;
}

}  // namespace

int main() {
  const Specimen specimen = make_block();
  NetworkSpec walls;
  walls.lateral_walls = true;
  const ContactNetwork network = build_network(specimen, tessellate(specimen), walls);
  LawTable laws;
  laws.fill(laws::Elastic{5e9, 0.3});
  const Inertia inertia = make_inertia(specimen, 2630, 2110);

  StepperOptions options;
  options.damping_kind = Damping::local;
  options.damping = 0.3;
  const double mass = 2e-6, force = -0.05;  // mass of the platen at the side +x [kg], force on it [N]
  options.boundary.load(wall_x_hi, 0, std::make_shared<drives::Ramp>(), mass);
  options.dt = 0.3 * critical_step(network, laws, inertia, options).dt;
  const std::int64_t period = 2000;
  options.boundary.load(wall_x_hi, 0, std::make_shared<drives::Ramp>(force, options.dt, 500), mass);
  options.boundary.move(wall_z_hi, 2, std::make_shared<Sawtooth>(1e-8, options.dt, period));
  const auto stepper = make_stepper(Backend::cpu, specimen, network, laws, inertia, options);

  double highest = 0;
  sample(*stepper, 50, 4 * period / 50, [&](const Observation& now) {
    const double stress = -now.top_force() / section_area(specimen);
    highest = std::max(highest, stress);
    if (now.step % period == 0)
      std::printf("t = %.3e s: top %+.2e m, stress %+.3e Pa\n", now.time, now.top_displacement(), stress);
  });

  const Observation end = stepper->observe();
  const ContactState contacts = stepper->contacts(network);
  double on_top = 0, largest = 0;
  for (std::size_t c = 0; c < network.contacts.size(); ++c) {
    largest = std::max(largest, norm(contacts.force[c]));
    if (network.contacts[c].b == wall_z_hi) on_top -= contacts.force[c].z;
  }
  std::printf("largest contact force %.3e N; side wall at %+.3e m\n", largest,
              end.wall_displacement[wall_index(wall_x_hi)].x);
  const bool good = std::abs(on_top - end.top_force()) <= 1e-9 * largest && highest > 0 &&
                    std::abs(end.wall_force[wall_index(wall_x_hi)].x + force) < 0.05 * std::abs(force);
  std::printf("%s\n", good ? "contacts add up to the wall's force; the platen is in balance" : "WRONG");
  return good ? 0 : 1;
}
