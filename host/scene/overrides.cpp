// SPDX-License-Identifier: GPL-3.0-or-later
// overrides.cpp  Replaces values of a scene by options.
#include "macadam/overrides.hpp"

#include <fmt/format.h>

#include "host/scene/sections.hpp"
#include "macadam/error.hpp"

namespace macadam {

void apply(const Overrides& asked, Scene& scene) {
  if (asked.seed && scene.specimen.file)
    throw InputError("--seed: has no effect, because the scene takes its specimen from a file");
  if (asked.seed) {
    scene.specimen.seed = *asked.seed;
    // A checkpoint is valid for one text of the scene only, so the text must contain the seed.
    scene.text += fmt::format("\n# --seed {}\n", *asked.seed);
  }
  SolverSpec& solver = scene.solver;
  if (asked.method) solver.method = *asked.method, solver.method_given = true;
  if (asked.backend) {
    solver.backend = *asked.backend;
    const bool may = solver.backend == Backend::cuda || solver.backend == Backend::automatic;
    if (!may) solver.devices.clear();  // the GPUs in the scene belong to the backend that is replaced
  }
  if (asked.devices) solver.devices = *asked.devices;
  if (asked.precision) solver.precision = asked.precision;
  if (asked.linear) solver.linear = *asked.linear;
  if (asked.threads) solver.threads = *asked.threads;
  scene::choose_method(solver, scene.experiment, scene.laws);
}

}  // namespace macadam
