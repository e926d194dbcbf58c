// SPDX-License-Identifier: GPL-3.0-or-later
// cooling.cpp  Implements kind "cooling": the stress of a specimen between two platens that rest while it cools.
#include "host/experiments/transient/transient_experiment.hpp"
#include "macadam/drives/constant_rate.hpp"

namespace macadam {

using experiments::Cooling;

TransientExperiment load_test(const Cooling& spec) {
  const double end = spec.times.back();
  TransientExperiment out;
  out.kind = spec.kind;
  out.history = {spec.times, {{0, end}}};
  out.temperature = spec.temperature;
  out.load = {{"from_c", spec.from}, {"to_c", spec.to}, {"rate_k_s", spec.rate}};
  // increments choose their lengths as in a strain history, because the strain of this test is not a measure of time
  out.grows = out.reverses = out.cools = true;
  out.strain = 0;
  out.drive = [end](double, double dt, double) { return std::make_shared<drives::ConstantRate>(0.0, dt, end); };
  return out;
}

template <>
std::unique_ptr<PlannedExperiment> ExperimentOf<Cooling>::plan(const Cooling& spec, const Scene& scene,
                                                               const Preparation& prepared, const Watcher& watcher,
                                                               std::optional<Resumed> resumed, RunResult& result) {
  return plan_load_test(load_test(spec), scene, prepared, watcher, std::move(resumed), result);
}

template <>
std::vector<std::string> ExperimentOf<Cooling>::files(const Cooling& spec, const Scene& scene) {
  return load_files(spec.kind, scene);
}

}  // namespace macadam
