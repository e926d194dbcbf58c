// SPDX-License-Identifier: GPL-3.0-or-later
// indirect_tensile_strength.cpp  Implements kind "indirect_tensile_strength": two strips approach each other at a
// constant rate and split a disc.
#include "host/experiments/read_points.hpp"
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
IndirectTensileStrength ExperimentOf<IndirectTensileStrength>::read(const scene::Section& section) {
  using namespace scene;
  constexpr std::int64_t most_points = 100'000;
  IndirectTensileStrength out;
  std::optional<double> rate;
  double displacement = 0;
  int points = 200;
  section.read({kind_key(),
                strip_width_key(out.strip_width),
                {"rate", Need::optional, into(rate, speed, positive), "rate at which the strips approach each other",
                 "50 mm/min, as in the standards"},
                {"displacement", Need::required, into(displacement, length, positive),
                 "approach of the strips at which the test ends"},
                {"points", Need::optional, into(points, 10, most_points), "rows of the result, evenly spaced"}});
  out.rate = rate.value_or(out.rate);
  for (int i = 1; i <= points; ++i) out.times.push_back(displacement / out.rate * i / points);
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
