// SPDX-License-Identifier: GPL-3.0-or-later
// creep.cpp  Kind "creep": strain under a stress that is held, and after it is taken off.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "host/experiments/experiment.hpp"
#include "host/experiments/material_solution.hpp"
#include "host/experiments/read_points.hpp"
#include "host/results/files.hpp"

namespace macadam {

using experiments::Creep;
using experiments::CreepResult;
using experiments::Material;

template <>
Creep ExperimentOf<Creep>::read(const scene::Section& section) {
  using namespace scene;
  constexpr Rule any{[](double v) { return v != 0; }, "a stress that is not 0"};
  Creep out;
  Points times;
  std::vector<Key> keys = times.keys("times", duration);
  keys.insert(keys.end(), {kind_key(),
                           poisson_key(out.poisson_ratio),
                           {"stress", Need::required, into(out.stress, modulus, any)},
                           {"ramp", Need::optional, into(out.ramp, duration, non_negative)},
                           {"release", Need::optional, into(out.release, duration, positive)}});
  section.read(keys);
  out.times = times.all(section, "times", "s", "time");
  if (out.release && *out.release < out.ramp) {
    section.refuse("release", fmt::format("{} s", *out.release),
                   fmt::format("the end of the ramp, {} s, or later", out.ramp));
  }
  return out;
}

namespace {

/// The share of the stress that is there at t.
double loaded(const Creep& spec, double t) {
  const auto grown = [&](double since) { return since < 0 ? 0 : spec.ramp > 0 ? std::min(1.0, since / spec.ramp) : 1; };
  return grown(t) - (spec.release ? grown(t - *spec.release) : 0);
}

CreepResult response(const Creep& spec, Material material) {
  CreepResult out{std::move(material), {}};
  const CreepSeries& series = out.material.spectrum.creep;
  for (const double t : spec.times) {
    double strain = series.after_ramp(t, spec.ramp);
    if (spec.release) strain -= series.after_ramp(t - *spec.release, spec.ramp);
    out.points.push_back({t, spec.stress * loaded(spec, t), spec.stress * strain, series.compliance(t)});
  }
  return out;
}

}  // namespace

template <>
std::unique_ptr<Solution> ExperimentOf<Creep>::plan(const Creep& spec, const Scene& scene, const Preparation& prepared,
                                                    const Watcher& watcher, std::optional<Resumed>, RunResult& result) {
  History history{spec.times, {{0, spec.ramp}}};
  if (spec.release) history.ramps.push_back({*spec.release, spec.ramp});
  const auto responds = [spec](const std::filesystem::path& out, Material material, RunResult& found) {
    CreepResult r = response(spec, std::move(material));
    std::string text = fmt::format("# of a {} specimen; compliance_1_pa is after a step; error: of it, relative\n",
                                   r.material.confined ? "confined" : "free") +
                       "time_s,stress_pa,strain,compliance_1_pa,error\n";
    for (const auto& p : r.points) {
      text +=
          fmt::format("{},{},{},{},{:.2e}\n", p.time_s, p.stress_pa, p.strain, p.compliance_1_pa, r.material.error());
    }
    write_whole(out / "creep.csv", text);
    found.found = std::move(r);
  };
  return plan_material(scene, prepared, watcher, result, history, spec.poisson_ratio, responds);
}

template <>
void ResultOf<CreepResult>::summarise(const CreepResult& found, const Scene& scene, const RunResult&,
                                      nlohmann::ordered_json& summary) {
  const auto& spec = std::get<Creep>(scene.experiment);
  nlohmann::ordered_json out = material_json(spec.kind, found.material);
  out["stress_pa"] = spec.stress;
  out["ramp_s"] = spec.ramp;
  out["release_s"] = spec.release ? nlohmann::ordered_json(*spec.release) : nlohmann::ordered_json();
  for (const auto& p : found.points) {
    out["points"].push_back({{"time_s", p.time_s},
                             {"stress_pa", p.stress_pa},
                             {"strain", p.strain},
                             {"compliance_1_pa", p.compliance_1_pa}});
  }
  summary["results"].push_back(std::move(out));
}

template <>
double ResultOf<CreepResult>::seconds(const CreepResult& found) {
  return found.material.seconds;
}

template <>
std::string ResultOf<CreepResult>::table(const CreepResult& found) {
  std::string out = fmt::format("\n{:>12} {:>14} {:>12} {:>14}\n", "t (s)", "stress (MPa)", "strain", "J(t) (1/GPa)");
  for (const auto& p : found.points) {
    out += fmt::format("{:>12.5g} {:>14.6g} {:>12.6g} {:>14.6g}\n", p.time_s, p.stress_pa / 1e6, p.strain,
                       p.compliance_1_pa * 1e9);
  }
  return out + material_lines(found.material);
}

}  // namespace macadam
