// SPDX-License-Identifier: GPL-3.0-or-later
// indirect_tensile_strength.cpp  Implements kind "indirect_tensile_strength": two strips approach each other at a
// constant rate and split a disc.
#include "host/experiments/transient/constant_approach.hpp"

namespace macadam {

using experiments::IndirectTensileStrength;

TransientExperiment load_test(const IndirectTensileStrength& spec) {
  return constant_approach(spec.kind, spec.times, spec.rate, spec.diameter,
                           "disc between two strips; strain: their approach over the diameter; stress: load over "
                           "diameter times thickness");
}

template <>
std::unique_ptr<PlannedExperiment> ExperimentOf<IndirectTensileStrength>::plan(
    const IndirectTensileStrength& spec, const Scene& scene, const Preparation& prepared, const Watcher& watcher,
    std::optional<Resumed> resumed, RunResult& result) {
  return plan_load_test(load_test(spec), scene, prepared, watcher, std::move(resumed), result);
}

template <>
std::vector<std::string> ExperimentOf<IndirectTensileStrength>::files(const IndirectTensileStrength& spec,
                                                                      const Scene& scene) {
  return load_files(spec.kind, scene);
}

}  // namespace macadam
