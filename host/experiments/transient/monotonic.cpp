// SPDX-License-Identifier: GPL-3.0-or-later
// monotonic.cpp  Implements kind "monotonic": the stress under a strain that grows at a constant rate.
#include "host/experiments/transient/transient_experiment.hpp"
#include "macadam/drives/constant_rate.hpp"

namespace macadam {

using experiments::Monotonic;
using experiments::ResponsePoint;

TransientExperiment load_test(const Monotonic& spec) {
  const double end = spec.times.back();
  TransientExperiment out;
  out.kind = spec.kind;
  out.history = {spec.times, {{0, end}}};
  out.poisson_ratio = spec.poisson_ratio;
  out.temperature = spec.temperature;
  out.load = {{"rate_1_s", spec.rate}};
  out.grows = true;
  out.strain = spec.rate * end;
  out.unstepped = [spec](const Spectrum& spectrum, double t, const LoadTimes&) -> ResponsePoint {
    const double secant = spectrum.relaxation.after_ramp(t, t), strain = spec.rate * t;
    return {t, strain, secant * strain, secant};
  };
  out.drive = [spec, end](double unit, double dt, double) {
    return std::make_shared<drives::ConstantRate>(unit * spec.rate, dt, end);
  };
  return out;
}

template <>
std::unique_ptr<PlannedExperiment> ExperimentOf<Monotonic>::plan(const Monotonic& spec, const Scene& scene,
                                                                 const Preparation& prepared, const Watcher& watcher,
                                                                 std::optional<Resumed> resumed, RunResult& result) {
  return plan_load_test(load_test(spec), scene, prepared, watcher, std::move(resumed), result);
}

template <>
std::vector<std::string> ExperimentOf<Monotonic>::files(const Monotonic& spec, const Scene& scene) {
  return load_files(spec.kind, scene);
}

}  // namespace macadam
