// SPDX-License-Identifier: GPL-3.0-or-later
// block_lengths.cpp  Measures the error of |E*| and phase from taking steps in blocks, for several block lengths.
// Writes CSV to standard output.
//
// A block is a sequence of time steps; the viscoelastic state of a contact is updated only at its end. The program
// repeats the stepping in blocks of the GPU backend (kernels/cuda/tiles/tile_blocks.hpp) in simple code and in double
// precision. It steps small networks of spheres with fixed geometry from the steady state. Each row compares a block
// length with blocks of one step at the same time step and masses. The program takes some minutes.
#include <fmt/format.h>

#include "host/run/error_model.hpp"
#include "kernels/contact/initial_contact.hpp"
#include "kernels/layout/layout.hpp"
#include "tests/support/test_scenes.hpp"

namespace macadam::bench {
namespace {

using kernels::Placement;
using kernels::Twist;

/// A case: binder, frequency, and size of specimen and run.
struct Case {
  const char* binder;
  double frequency;    // [Hz]
  std::int64_t steps;  // per period
  int cycles, cells;
};

/// A contact stepped in blocks: the values that TileArrays holds for a contact, in double precision.
struct Element {
  Placement<double> frame;
  double moments[6];
  std::size_t a, b;
  double alpha, rate, relax, follow;
  const laws::GeneralisedKelvin::Block* block;  ///< null for an elastic law
  double f[6] = {}, change[6] = {}, sum[6] = {}, drive[6] = {};
  std::vector<double> x[6];

  /// Updates the viscoelastic state at the end of a block of `steps` steps, and begins the next block. With 0 steps it
  /// only begins the first block.
  void settle(int steps, const std::vector<Twist<double>>& u) {
    double at[6];
    relative_rates(frame, Twist<double>{{}, u[a].angular}, {u[b].linear - u[a].linear, u[b].angular}, at);
    for (int c = 0; c < 6; ++c) {
      const auto unit = [&](int l) -> double& { return x[c][static_cast<std::size_t>(l)]; };
      const double start = f[c];
      f[c] = block ? start + change[c] : rate * at[c];
      if (block && steps > 0) block->settle<-1>(2.0 * steps * start + sum[c], unit);
      if (block) drive[c] = block->drift<-1>(f[c], unit);
      change[c] = sum[c] = 0;
    }
  }
  /// Does one step of a contact within a block and returns its load.
  kernels::ContactLoad<double> step(const std::vector<Twist<double>>& v, double dt) {
    double u[6], now[6];
    relative_rates(frame, v[a], v[b], u);
    for (int c = 0; c < 6; ++c) {
      const double before = change[c];
      change[c] += rate * dt * u[c] + (drive[c] + follow * sum[c] - relax * before);
      sum[c] += change[c] + before;
      now[c] = f[c] + change[c];
    }
    return to_centres(frame, kernels::condensed_load(now, alpha, moments));
  }
};

/// Steps a specimen in blocks of `block` steps and returns |E*| and phase of the last period.
Stiffness stepped(const test::TestScene& scene, const StartState& start, const drives::Cyclic& loading, double scaling,
                  int block, int cycles) {
  const double dt = loading.dt();
  const std::size_t n = scene.specimen.size(), top = n + 5;
  std::vector<Twist<double>> v(n + kernels::walls), u(v.size()), load(v.size());
  for (std::size_t i = 0; i < n; ++i) {
    v[i] = {start.velocity[i], start.spin[i]};
    u[i] = {start.displacement[i], start.rotation[i]};
  }
  u[top].linear.z = loading.value(-1);
  std::array<laws::GeneralisedKelvin::Block, pair_types> blocks;
  std::vector<Element> elements;
  for (std::size_t i = 0; i < scene.network.contacts.size(); ++i) {
    const Contact& c = scene.network.contacts[i];
    const auto pair = static_cast<std::size_t>(c.pair);
    Element e{};
    e.frame = kernels::canonical_placement(c.n, std::copysign(1.0, c.n.z), c.arm_a, c.arm_b);
    kernels::moments_over_length(c, e.moments);
    e.a = static_cast<std::size_t>(c.a);
    e.b = c.b >= 0 ? static_cast<std::size_t>(c.b) : n + static_cast<std::size_t>(-1 - c.b);
    const double* chain = &start.chain[start.chain_begin[i]];
    if (const auto* kelvin = std::get_if<laws::GeneralisedKelvin>(&*scene.laws[pair])) {
      blocks[pair] = kelvin->block(dt, block);
      e.block = &blocks[pair];
      e.alpha = kelvin->alpha, e.rate = e.block->rate, e.relax = e.block->relax, e.follow = e.block->follow;
      for (int k = 0; k < 6; ++k) {
        e.f[k] = *chain++;
        e.x[k].assign(chain, chain + kelvin->units());
        chain += kelvin->units();
      }
    } else {
      const auto& elastic = std::get<laws::Elastic>(*scene.laws[pair]);
      e.alpha = elastic.alpha, e.rate = elastic.E;
    }
    elements.push_back(e);
  }
  constexpr int samples = 500;
  const std::int64_t stride = loading.steps_per_period / samples;
  const Vec3d& size = scene.specimen.box.size;
  std::vector<ResponseSample> response;
  for (std::int64_t k = -1; k < loading.steps_per_period * cycles; ++k) {
    for (std::size_t i = 0; k >= 0 && i < n; ++i) {
      v[i].linear += dt / (scene.inertia.mass[i] * scaling) * load[i].linear;
      v[i].angular += dt / (scene.inertia.inertia[i] * scaling) * load[i].angular;
    }
    v[top].linear.z = loading.rate(k);
    if ((k + 1) % block == 0) {
      for (Element& e : elements) e.settle(k < 0 ? 0 : block, u);
    }
    for (std::size_t i = 0; i < v.size(); ++i) {
      u[i].linear += dt * v[i].linear;
      u[i].angular += dt * v[i].angular;
      load[i] = {};
    }
    for (Element& e : elements) {
      const auto of = e.step(v, dt);
      load[e.a].linear += of.force_a;
      load[e.a].angular += of.moment_a;
      load[e.b].linear -= of.force_a;
      load[e.b].angular += of.moment_b;
    }
    if ((k + 1) % stride == 0) {
      const double time = static_cast<double>(k + 1) * dt;
      response.push_back(
          {loading.frequency, time, loading.value(k + 1) / size.z, -load[top].linear.z / (size.x * size.y)});
    }
  }
  return evaluate_cyclic(response, loading.frequency, 1).fit;
}

/// Prints one row for each block length. The length is given as the number of blocks in the shortest time scale of the
/// case: the period of the load or 2π times the shortest relaxation time of the laws.
void run(const Case& c) {
  auto scene = test::make_scene(test::random_specimen(3, c.cells, c.cells, c.cells * 3 / 2), {},
                                std::string(c.binder) == "AM2" ? test::am2_laws() : test::am1_laws());
  const double critical = critical_step(scene.network, scene.laws, scene.inertia, {}).dt;
  const drives::Cyclic loading{1e-4 * scene.specimen.box.size.z, c.frequency, c.steps, 0};
  const double scaling = std::pow(loading.dt() / (0.95 * critical), 2);
  Harmonic harmonic(scene.specimen, scene.network, scene.laws, scene.inertia, HarmonicOptions{}, c.frequency);
  const auto solved = harmonic.solve(c.frequency, scaling, 0);
  const StartState start = steady_start(scene.network, scene.laws, solved.motion, loading);
  const Stiffness exact = stepped(scene, start, loading, scaling, 1, c.cycles);
  double shortest = 1 / c.frequency;
  for (const auto& law : scene.laws) {
    if (!law) continue;
    const double time = std::visit([](const auto& l) { return l.shortest_time(); }, *law);
    shortest = std::min(shortest, 2 * std::numbers::pi * time);
  }
  for (const double blocks : {4000.0, 2000.0, 1000.0, 500.0, 250.0, 125.0, 60.0, 30.0}) {
    const int steps = static_cast<int>(shortest / blocks / loading.dt());
    if (steps < 2) continue;
    const ErrorEstimate e = difference(stepped(scene, start, loading, scaling, steps, c.cycles), exact);
    fmt::print("{},{:g},{},{},{},{:g},{},{:.3g},{:.3g},{:.2g}\n", c.binder, c.frequency, c.cycles,
               scene.specimen.size(), c.steps, blocks, steps, e.e_star, e.phase_rad, largest(e) / block_error(blocks));
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace macadam::bench

int main() {
  fmt::print(
      "# steps in blocks against single steps, in double precision on the processor; random spheres, geometry of "
      "the start, steady start, the last period of 500 samples fitted; blocks: in the shortest time of load and "
      "laws; envelope: the bound that the plan uses\n"
      "binder,hz,cycles,particles,steps_per_period,blocks,steps,e_star,phase_rad,over_envelope\n");
  using macadam::bench::Case;
  for (const Case& c : {Case{"AM1", 2, 40000, 1, 4}, Case{"AM1", 5, 20000, 1, 4}, Case{"AM1", 10, 8000, 3, 4},
                        Case{"AM1", 20, 20000, 1, 4}, Case{"AM1", 20, 5000, 2, 5}, Case{"AM1", 20, 30000, 1, 6},
                        Case{"AM2", 2, 40000, 1, 4}, Case{"AM2", 20, 20000, 1, 4}}) {
    macadam::bench::run(c);
  }
  return 0;
}
