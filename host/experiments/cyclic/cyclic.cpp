// SPDX-License-Identifier: GPL-3.0-or-later
// cyclic.cpp  The cyclic test by either method.
#include "host/experiments/cyclic/methods.hpp"
#include "host/experiments/experiment.hpp"

namespace macadam {

using experiments::Cyclic;

template <>
std::unique_ptr<Solution> ExperimentOf<Cyclic>::plan(const Cyclic&, const Scene& scene, const Preparation& prepared,
                                                     const Watcher& watcher, std::optional<Resumed> resumed,
                                                     RunResult& result) {
  if (scene.solver.method == SolverMethod::explicit_) {
    return plan_steps(scene, prepared, watcher, std::move(resumed), result);
  }
  return plan_harmonic(scene, prepared, watcher, result,
                       result.found.emplace<experiments::HarmonicCyclic>().frequencies);
}

}  // namespace macadam
