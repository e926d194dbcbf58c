// SPDX-License-Identifier: GPL-3.0-or-later
// relaxation.cpp  Kind "relaxation": stress under a strain that is held.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "host/experiments/experiment.hpp"
#include "host/experiments/material_solution.hpp"
#include "host/experiments/read_points.hpp"
#include "host/results/files.hpp"

namespace macadam {

using experiments::Material;
using experiments::Relaxation;
using experiments::RelaxationResult;

template <>
Relaxation ExperimentOf<Relaxation>::read(const scene::Section& section) {
  using namespace scene;
  constexpr Rule strain{[](double v) { return v != 0 && std::abs(v) < 1; }, "a strain between -1 and 1 that is not 0"};
  Relaxation out;
  Points times;
  std::vector<Key> keys = times.keys("times", duration);
  keys.insert(keys.end(), {kind_key(),
                           poisson_key(out.poisson_ratio),
                           {"strain", Need::optional, into(out.strain, ratio, strain)},
                           {"ramp", Need::optional, into(out.ramp, duration, non_negative)}});
  section.read(keys);
  out.times = times.all(section, "times", "s", "time");
  return out;
}

template <>
std::unique_ptr<Solution> ExperimentOf<Relaxation>::plan(const Relaxation& spec, const Scene& scene,
                                                         const Preparation& prepared, const Watcher& watcher,
                                                         std::optional<Resumed>, RunResult& result) {
  const auto responds = [spec](const std::filesystem::path& out, Material material, RunResult& found) {
    RelaxationResult r{std::move(material), {}};
    const PronySeries& series = r.material.spectrum.relaxation;
    std::string text = fmt::format("# {} modulus, after a step in modulus_pa; error: of stress and modulus, relative\n",
                                   r.material.confined ? "confined" : "uniaxial") +
                       "time_s,strain,stress_pa,modulus_pa,error\n";
    for (const double t : spec.times) {
      const double grown = spec.ramp > 0 ? std::min(1.0, t / spec.ramp) : 1;
      r.points.push_back({t, spec.strain * grown, spec.strain * series.after_ramp(t, spec.ramp), series.modulus(t)});
      const auto& p = r.points.back();
      text += fmt::format("{},{},{},{},{:.2e}\n", p.time_s, p.strain, p.stress_pa, p.modulus_pa, r.material.error());
    }
    write_whole(out / "relaxation.csv", text);
    found.found = std::move(r);
  };
  return plan_material(scene, prepared, watcher, result, {spec.times, {{0, spec.ramp}}}, spec.poisson_ratio, responds);
}

template <>
void ResultOf<RelaxationResult>::summarise(const RelaxationResult& found, const Scene& scene, const RunResult&,
                                           nlohmann::ordered_json& summary) {
  const auto& spec = std::get<Relaxation>(scene.experiment);
  nlohmann::ordered_json out = material_json(spec.kind, found.material);
  out["strain"] = spec.strain;
  out["ramp_s"] = spec.ramp;
  for (const auto& p : found.points) {
    out["points"].push_back(
        {{"time_s", p.time_s}, {"strain", p.strain}, {"stress_pa", p.stress_pa}, {"modulus_pa", p.modulus_pa}});
  }
  summary["results"].push_back(std::move(out));
}

template <>
double ResultOf<RelaxationResult>::seconds(const RelaxationResult& found) {
  return found.material.seconds;
}

template <>
std::string ResultOf<RelaxationResult>::table(const RelaxationResult& found) {
  std::string out = fmt::format("\n{:>12} {:>12} {:>14} {:>12}\n", "t (s)", "strain", "stress (MPa)", "E(t) (MPa)");
  for (const auto& p : found.points) {
    out += fmt::format("{:>12.5g} {:>12.5g} {:>14.6g} {:>12.6g}\n", p.time_s, p.strain, p.stress_pa / 1e6,
                       p.modulus_pa / 1e6);
  }
  return out + material_lines(found.material);
}

}  // namespace macadam
