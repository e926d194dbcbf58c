// SPDX-License-Identifier: GPL-3.0-or-later
// indirect_tensile_strength.cpp  Implements kind "indirect_tensile_strength": two strips approach each other at a
// constant rate and split a disc.
#include "host/experiments/transient/transient_experiment.hpp"
#include "macadam/drives/constant_rate.hpp"

namespace macadam {

using experiments::IndirectTensileStrength;

TransientExperiment load_test(const IndirectTensileStrength& spec) {
  const double end = spec.times.back(), strain_rate = -spec.rate / spec.diameter;
  TransientExperiment out;
  out.kind = spec.kind;
  out.history = {spec.times, {{0, end}}};
  out.load = {{"rate_m_s", spec.rate}};
  out.grows = true;
  out.strain = strain_rate * end;
  out.drive = [strain_rate, end](double unit, double dt, double) {
    return std::make_shared<drives::ConstantRate>(unit * strain_rate, dt, end);
  };
  return out;
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
