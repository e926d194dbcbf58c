// SPDX-License-Identifier: GPL-3.0-or-later
// cyclic.cpp  Implements the cyclic test. Calls method "explicit" (time steps), "quasi_static" (increments) or
// "harmonic" (steady states), as the scene asks.
#include "host/experiments/cyclic/methods.hpp"
#include "host/experiments/experiment.hpp"
#include "host/run/cracks.hpp"

namespace macadam {

using experiments::Cyclic;

template <>
std::unique_ptr<PlannedExperiment> ExperimentOf<Cyclic>::plan(const Cyclic&, const Scene& scene,
                                                              const Preparation& prepared, const Watcher& watcher,
                                                              std::optional<Resumed> resumed, RunResult& result) {
  if (is_stepped(scene.solver.method)) { return plan_steps(scene, prepared, watcher, std::move(resumed), result); }
  result.found.emplace<experiments::HarmonicCyclic>();
  return plan_harmonic(
      scene, prepared, watcher, result,
      [](RunResult & run) -> auto& { return std::get<experiments::HarmonicCyclic>(run.found).frequencies; });
}

template <>
std::vector<std::string> ExperimentOf<Cyclic>::files(const Cyclic&, const Scene& scene) {
  std::vector<std::string> out;
  if (is_stepped(scene.solver.method) && scene.output.response) out.push_back("response.csv");
  if (counts_cracks(scene)) out.push_back(cracks_file);
  return out;
}

experiments::Frequency frequency_of(const Scene& scene, double frequency_hz, std::optional<double> temperature_c,
                                    double density_scaling, const Stiffness& stiffness, double seconds) {
  experiments::Frequency out;
  out.frequency_hz = frequency_hz;
  out.temperature_c = temperature_c;
  out.stiffness = stiffness;
  out.confined = scene.network.lateral_walls;
  out.density_scaling = density_scaling;
  out.seconds = seconds;
  return out;
}

}  // namespace macadam
