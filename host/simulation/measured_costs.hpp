// SPDX-License-Identifier: GPL-3.0-or-later
/// \file measured_costs.hpp  Lists the measured time and memory of the parts of a run, from which a forecast is
/// computed (docs/forecast.md).
#pragma once

#include <cstddef>

#include "macadam/stepper.hpp"

namespace macadam {

/// Costs on the CPU were measured on two cores of an AMD EPYC, by bench/forecast/run and macadam bench
/// (bench/results/bench-cpu-…); costs on a device on an H200, by bench/steps/run (bench/results/gpu-step-…). Costs that
/// depend on the size, and the memory of a device and of its host, were measured by bench/forecast/run on machines with
/// devices (bench/results/forecast-large.csv).
struct Cost {
  // Contacts per particle. A Laguerre cell of a mixture has about 14 facets, or 13 if the aggregates are large single
  // spheres, and two cells share a facet. Facets at free sides are not contacts.
  double contacts = 7.1, contacts_of_single_spheres = 6.5, missing_at_sides = 9;
  // Seconds of one thread: per particle (`relaxing`, `tessellating`), per aggregate (`inserting`, `packing`), and per
  // shape of the library (`packed_shape`).
  double relaxing = 0.9e-4, inserting = 1e-3, packing = 7e-3, packed_shape = 0.085, tessellating = 1.5e-5;
  // Seconds per particle in work that one thread does, however many threads there are: `placing` for positions, sums
  // and lists, `joining` for joining the cells and contacts that several threads have found. (These and `tessellating`
  // are from runs with 2 and with 16 threads: bench/results/preparation-h100-2026-11-26.csv.)
  double placing = 1.6e-5, joining = 3e-6;
  // seconds of one thread per solution and particle^(4/3): the number of iterations grows with the specimen's edge
  double solving = 1.1e-6, solving_on_device = 2e-8;
  // Contrast is the stiffness of the stiffest contact over the stiffness of the softest. A solution takes
  // by_contrast·∛contrast times as long as one of small contrast. If contrast·particles exceeds `iterable`, the
  // iterative solver fails and the direct solver is used. The direct solver takes `factors` bytes per particle^(4/3)
  // and `factoring` seconds per particle^1.5 for the factors, and then `factored_iterations` iterations of
  // `with_factors` seconds per byte (measured with 600 to 4,805 particles and contrasts of 20 to 1e7).
  double by_contrast = 0.4, iterable = 2e8, factors = 2.9e3, factoring = 2e-6, factored_iterations = 500,
         with_factors = 5e-11;
  // seconds per byte of a file, and in addition per frame of fields
  double writing = 8e-9, frame = 5e-4;
  // seconds that the program needs to start, without and with a device
  double start = 0.1, start_on_device = 0.8;
  // A specimen with fewer than `contacts_in_cache` contacts fits into the processor's cache, and the time of a step on
  // the CPU is multiplied by `cached`.
  double cached = 0.5, contacts_in_cache = 30'000;
  // A step on a device takes at least `least_step_on_device` [s], however small the specimen is. If the specimen has
  // fewer contacts than `contacts_on_chip`, the data of the contacts stay in registers and shared memory, and the time
  // of a step is multiplied by `on_chip`.
  double least_step_on_device = 3e-6, contacts_on_chip = 420'000, on_chip = 0.4;
  // Bytes on the host: `program` for the program, `a_shape` per shape of the library, `a_contact` per contact of the
  // specimen, and `a_solved_contact` per contact for the solutions. Bytes on the device: `device` without a specimen,
  // and `a_solved_contact_on_device` per contact for the solutions.
  double program = 33e6, a_shape = 7e5, a_contact = 650, a_solved_contact = 850;
  double device = 5.6e8, a_solved_contact_on_device = 655;
  // Bytes on the host if a device is used: `driver` for NVIDIA's driver, and `a_solved_contact_beside_device` per
  // contact for the solutions. In addition, the host holds copies of a part of the stepper's arrays. `staged` is the
  // copied fraction of the bytes of all arrays except the chains. `staged_chain` is the copied fraction of the bytes of
  // the chains; it counts only if the chains are not zero at the start.
  double driver = 2.5e8, a_solved_contact_beside_device = 220, staged = 0.55, staged_chain = 0.77;
};

/// Cost per contact: seconds per step (on the CPU, of one thread), bytes of the stepper, and the part of these bytes
/// that the chains of the contact's law take.
struct StepCost {
  double seconds = 0, bytes = 0, chain = 0;
};

/// Returns the cost per contact. `units`: number of Kelvin units of the law that most contacts have, -1 if it has no
/// chain. The table was measured with three units. The table is indexed by backend (CPU, device), contact form,
/// precision (single, mixed, double) and geometry (fixed, updated). The effect of the number of units is from
/// bench/results/kelvin-units-cpu.csv.
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
  // A Kelvin unit keeps one number per displacement: 18 in the points form (six points with three each), 6 in the
  // condensed form. `of_unit` is this in bytes.
  const double of_unit = (points ? 18 : 6) * (p == single ? 4 : 8);
  out.chain = (1 + units) * of_unit;
  const double more = (units - 3) * of_unit;
  // all of these bytes are read and written in every step
  if (points || p == double_) out.seconds *= 1 + more / out.bytes;
  out.bytes += more;
  return out;
}

}  // namespace macadam
