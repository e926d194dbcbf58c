// SPDX-License-Identifier: GPL-3.0-or-later
/// \file costs.hpp  What parts of a run take of time and memory, as measured: docs/forecast.md.
#pragma once

#include <cstddef>

#include "macadam/stepper.hpp"

namespace macadam {

/// Of two cores of an AMD EPYC, by bench/forecast/run and macadam bench (bench/results/bench-cpu-…); of a device an
/// H200, by bench/steps/run (bench/results/gpu-step-…). What depends on the size, and memory of and beside a device, by
/// bench/forecast/run on machines with them (bench/results/forecast-large.csv).
struct Cost {
  // A Laguerre cell of a mixture has about 14 facets, each of two cells, and 13 where aggregates are large single
  // spheres; those at free sides are none.
  double contacts = 7.1, contacts_of_single_spheres = 6.5, missing_at_sides = 9;
  // seconds of one thread a particle, an aggregate, a shape of the library
  double relaxing = 0.9e-4, inserting = 1e-3, packing = 7e-3, packed_shape = 0.085, tessellating = 1.5e-5;
  // seconds a particle that no second thread shortens: places, sums and lists; cells and contacts that threads found,
  // put together (with `tessellating`, of runs with 2 threads and with 16:
  // bench/results/preparation-h100-2026-11-26.csv)
  double placing = 1.6e-5, joining = 3e-6;
  // seconds of one thread a particle^(4/3) and solution: the iterations grow with the specimen's edge
  double solving = 1.1e-6, solving_on_device = 2e-8;
  // Contrast is the stiffest over the softest contact. A solution takes by_contrast·∛contrast times as long as one of
  // small contrast. If contrast·particles exceeds `iterable`, the iteration fails and the direct solver follows: its
  // bytes per particle^(4/3), seconds per particle^1.5, iterations, and seconds per iteration and byte (measured: 600
  // to 4,805 particles, contrasts of 20 to 1e7)
  double by_contrast = 0.4, iterable = 2e8, factors = 2.9e3, factoring = 2e-6, factored_iterations = 500,
         with_factors = 5e-11;
  // seconds per byte of a file, and per frame of fields beside that
  double writing = 8e-9, frame = 5e-4;
  double start = 0.1, start_on_device = 0.8;
  // a specimen of fewer contacts fits into the processor's cache
  double cached = 0.5, contacts_in_cache = 30'000;
  // a step on a device, however small the specimen [s]; fewer contacts than that stay on the chip, in so much less time
  double least_step_on_device = 3e-6, contacts_on_chip = 420'000, on_chip = 0.4;
  // bytes: of the program, of a shape of the library; a contact, of the specimen, and of the solutions beside it; of
  // the device's own, and a contact's solutions
  double program = 33e6, a_shape = 7e5, a_contact = 650, a_solved_contact = 850;
  double device = 5.6e8, a_solved_contact_on_device = 655;
  // on the host, beside a device: of NVIDIA's driver; a contact's solutions, or shares of what the stepper holds there,
  // without chains, and of chains that are not zero at first
  double driver = 2.5e8, a_solved_contact_beside_device = 220, staged = 0.55, staged_chain = 0.77;
};

/// Of a step: seconds a contact (of the CPU: one thread), and bytes a contact that its stepper holds, of which so many
/// are the chains of its law.
struct StepCost {
  double seconds = 0, bytes = 0, chain = 0;
};

/// `units`: Kelvin units of the usual contact's law, -1 where it keeps no chain. Measured with three; in the order of
/// ContactForm and Precision, then geometry: fixed, updated. What units change: bench/results/kelvin-units-cpu.csv.
inline StepCost step_cost(bool on_device, ContactForm form, Precision precision, Geometry geometry, double units) {
  enum { single, mixed, double_ };
  // clang-format off
  static constexpr StepCost costs[2][2][3][2] = {
      {{{{1.32e-8, 253}, {1.94e-8, 318}}, {{1.74e-8, 377}, {2.44e-8, 451}}, {{2.56e-8, 328}, {4.66e-8, 362}}},    // condensed
       {{{2.81e-8, 442}, {5.46e-8, 463}}, {{4.33e-8, 750}, {6.96e-8, 782}}, {{5.17e-8, 864}, {7.96e-8, 900}}}},   // points
      {{{{9.1e-11, 433}, {1.0e-10, 475}}, {{9.6e-11, 601}, {1.1e-10, 651}}, {{2.55e-10, 425}, {2.9e-10, 460}}},   // device
       {{{5.1e-10, 1000}, {5.4e-10, 1040}}, {{5.1e-10, 1000}, {5.4e-10, 1040}}, {{5.1e-10, 1000}, {5.4e-10, 1040}}}}};
  // clang-format on
  const int p = precision == Precision::single ? single : precision == Precision::mixed ? mixed : double_;
  const bool points = form == ContactForm::points;
  StepCost out = costs[on_device][points][p][geometry == Geometry::updated];
  // three displacements of six points, or six of the contact; a number of each is kept for each unit
  const double of_unit = (points ? 18 : 6) * (p == single ? 4 : 8);
  out.chain = (1 + units) * of_unit;
  const double more = (units - 3) * of_unit;
  if (points || p == double_) out.seconds *= 1 + more / out.bytes;  // all are moved in every step
  out.bytes += more;
  return out;
}

}  // namespace macadam
