// SPDX-License-Identifier: GPL-3.0-or-later
// monotonic.cpp  Kind "monotonic": stress under a strain that grows evenly.
#include <fmt/format.h>

#include "host/experiments/experiment.hpp"
#include "host/experiments/material_solution.hpp"
#include "host/experiments/read_points.hpp"
#include "host/results/files.hpp"

namespace macadam {

using experiments::Material;
using experiments::Monotonic;
using experiments::MonotonicResult;

template <>
Monotonic ExperimentOf<Monotonic>::read(const scene::Section& section) {
  using namespace scene;
  constexpr Rule any{[](double v) { return v != 0; }, "a rate that is not 0"};
  Monotonic out;
  Points times;
  std::vector<Key> keys = times.keys("times", duration);
  keys.insert(keys.end(),
              {kind_key(), poisson_key(out.poisson_ratio), {"rate", Need::required, into(out.rate, scene::rate, any)}});
  section.read(keys);
  out.times = times.all(section, "times", "s", "time");
  return out;
}

template <>
std::unique_ptr<Solution> ExperimentOf<Monotonic>::plan(const Monotonic& spec, const Scene& scene,
                                                        const Preparation& prepared, const Watcher& watcher,
                                                        std::optional<Resumed>, RunResult& result) {
  const auto responds = [spec](const std::filesystem::path& out, Material material, RunResult& found) {
    MonotonicResult r{std::move(material), {}};
    std::string text =
        fmt::format("# {}; error: of stress and modulus, relative\n", modulus_words(r.material.confined)) +
        "time_s,strain,stress_pa,secant_pa,error\n";
    for (const double t : spec.times) {
      const double secant = r.material.spectrum.relaxation.after_ramp(t, t), strain = spec.rate * t;
      r.points.push_back({t, strain, secant * strain, secant});
      text += fmt::format("{},{},{},{},{:.2e}\n", t, strain, secant * strain, secant, r.material.error());
    }
    write_whole(out / "monotonic.csv", text);
    found.found = std::move(r);
  };
  const History history{spec.times, {{0, spec.times.back()}}};
  return plan_material(scene, prepared, watcher, result, history, spec.poisson_ratio, responds);
}

template <>
void ResultOf<MonotonicResult>::summarise(const MonotonicResult& found, const Scene& scene, const RunResult&,
                                          nlohmann::ordered_json& summary) {
  const auto& spec = std::get<Monotonic>(scene.experiment);
  nlohmann::ordered_json out = material_json(spec.kind, found.material);
  out["rate_1_s"] = spec.rate;
  for (const auto& p : found.points) {
    out["points"].push_back(
        {{"time_s", p.time_s}, {"strain", p.strain}, {"stress_pa", p.stress_pa}, {"secant_pa", p.secant_pa}});
  }
  summary["results"].push_back(std::move(out));
}

template <>
double ResultOf<MonotonicResult>::seconds(const MonotonicResult& found) {
  return found.material.seconds;
}

template <>
std::string ResultOf<MonotonicResult>::table(const MonotonicResult& found) {
  std::string out = fmt::format("\n{:>12} {:>12} {:>14} {:>14}\n", "t (s)", "strain", "stress (MPa)", "secant (MPa)");
  for (const auto& p : found.points) {
    out += fmt::format("{:>12.5g} {:>12.5g} {:>14.6g} {:>14.6g}\n", p.time_s, p.strain, p.stress_pa / 1e6,
                       p.secant_pa / 1e6);
  }
  return out + material_lines(found.material);
}

}  // namespace macadam
