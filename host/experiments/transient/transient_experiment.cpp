// SPDX-License-Identifier: GPL-3.0-or-later
// transient_experiment.cpp  Defines names and files of the tests of a load, and computes their response from the
// specimen's spectrum.
#include "host/experiments/transient/transient_experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <variant>

#include "host/experiments/transient/step_load.hpp"
#include "host/experiments/material_files.hpp"
#include "host/run/cracks.hpp"
#include "host/run/damaged_contacts.hpp"
#include "host/files/result_files.hpp"
#include "macadam/error.hpp"

namespace macadam {

using experiments::Material;
using experiments::ResponsePoint;
using experiments::SpectrumResponse;

namespace {

constexpr std::array<LoadWords, 8> all_words{{
    {"relaxation", "relaxation.csv", "modulus_pa",
     "modulus_pa: modulus after an instantaneous strain; error: relative error of stress and modulus", false,
     "E(t) (MPa)", "stress/strain (MPa)", 1e6},
    {"creep", "creep.csv", "compliance_1_pa",
     "compliance_1_pa: compliance after an instantaneous stress; error: relative error of the compliance", true,
     "J(t) (1/GPa)", "strain/stress (1/GPa)", 1e-9},
    {"monotonic", "monotonic.csv", "secant_pa", "error: relative error of stress and modulus", false, "secant (MPa)",
     "secant (MPa)", 1e6},
    {"indirect_tensile_strength", "indirect_tensile_strength.csv", nullptr, "", false, nullptr, nullptr, 1},
    {"semicircular_bending", "semicircular_bending.csv", nullptr, "", false, nullptr, nullptr, 1},
    {"three_point_bending", "three_point_bending.csv", nullptr, "", false, nullptr, nullptr, 1},
    {"cooling", "cooling.csv", nullptr, "", false, nullptr, nullptr, 1},
    {"history", "history.csv", nullptr, "error: relative error of stress", false, nullptr, nullptr, 1},
}};

constexpr bool is_listed(std::string_view kind) {
  return std::any_of(all_words.begin(), all_words.end(), [&](const LoadWords& words) { return words.kind == kind; });
}

/// Returns whether all_words has an entry for every test of a load.
template <class... Spec>
constexpr bool are_all_listed(const std::variant<Spec...>* /*experiments*/) {
  const auto listed = []<class One>(const One* /*spec*/) {
    if constexpr (requires(const One& spec) { load_test(spec); })
      return is_listed(One::kind);
    else
      return true;
  };
  return (listed(static_cast<const Spec*>(nullptr)) && ...);
}
static_assert(are_all_listed(static_cast<const Experiment*>(nullptr)), "a test of a load has no entry in all_words");

/// Returns a number as text. NaN, which stands for a ratio without meaning, becomes an empty text.
std::string number(double value) { return std::isnan(value) ? "" : fmt::format("{}", value); }

}  // namespace

const LoadWords& load_words(const std::string& kind) {
  for (const LoadWords& words : all_words) {
    if (words.kind == kind) return words;
  }
  std::string known;
  for (const LoadWords& words : all_words) known += (known.empty() ? "" : ", ") + std::string(words.kind);
  throw RunError("test of a load: found kind \"" + kind + "\", expected one of " + known);
}

TransientExperiment load_test_of(const Scene& scene) {
  return std::visit(
      []<class Spec>(const Spec& spec) -> TransientExperiment {
        if constexpr (requires { load_test(spec); })
          return load_test(spec);
        else
          return {};
      },
      scene.experiment);
}

std::string csv_head(const LoadWords& words) {
  return fmt::format("time_s,{}{}", words.stress_first ? "stress_pa,strain" : "strain,stress_pa",
                     words.ratio ? std::string(",") + words.ratio : "");
}

std::string csv_line(const LoadWords& words, const ResponsePoint& p) {
  return fmt::format("{},{},{}{}", p.time_s, words.stress_first ? p.stress_pa : p.strain,
                     words.stress_first ? p.strain : p.stress_pa, words.ratio ? "," + number(p.ratio) : "");
}

nlohmann::ordered_json point_json(const LoadWords& words, const ResponsePoint& p) {
  nlohmann::ordered_json out = {{"time_s", p.time_s}, {"strain", p.strain}, {"stress_pa", p.stress_pa}};
  if (words.ratio) out[words.ratio] = p.ratio;
  return out;
}

namespace {

std::size_t width_of(const char* title) { return std::max<std::size_t>(14, std::string(title).size()); }

}  // namespace

std::string shown_head(const char* ratio) {
  std::string out = fmt::format("\n{:>12} {:>12} {:>14}", "t (s)", "strain", "stress (MPa)");
  if (ratio) out += fmt::format(" {:>{}}", ratio, width_of(ratio));
  return out;
}

std::string shown_line(const LoadWords& words, const char* ratio, const ResponsePoint& p) {
  std::string out = fmt::format("\n{:>12.5g} {:>12.5g} {:>14.6g}", p.time_s, p.strain, p.stress_pa / 1e6);
  if (ratio) {
    out += fmt::format(" {:>{}}", std::isnan(p.ratio) ? "-" : fmt::format("{:.6g}", p.ratio / words.unit),
                       width_of(ratio));
  }
  return out;
}

void add_load(const TransientExperiment& test, nlohmann::ordered_json& out) {
  for (const auto& [name, value] : test.load) {
    out[name] = value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
  }
}

std::vector<std::string> load_files(const std::string& kind, const Scene& scene) {
  std::vector<std::string> out{load_words(kind).file};
  if (counts_cracks(scene)) out.push_back(cracks_file);
  if (counts_cracks(scene) && can_crack(facts_of(scene.laws))) out.push_back(damage_file);
  if (is_stepped(scene.solver.method)) return out;
  for (const std::string& file : material_files(scene.network.lateral_walls)) out.push_back(file);
  return out;
}

std::unique_ptr<PlannedExperiment> plan_load_test(const TransientExperiment& test, const Scene& scene,
                                                  const Preparation& prepared, const Watcher& watcher,
                                                  std::optional<Resumed> resumed, RunResult& result) {
  if (is_stepped(scene.solver.method)) {
    return plan_load_steps(test, scene, prepared, watcher, std::move(resumed), result);
  }
  const auto responds = [test](const std::filesystem::path& out, Material material, RunResult& found) {
    const LoadWords& words = load_words(test.kind);
    SpectrumResponse r{test.kind, std::move(material), {}};
    std::string text =
        fmt::format("# {}; {}\n{},error\n", modulus_words(r.material.confined), words.comment, csv_head(words));
    for (const double t : test.history.times) {
      const ResponsePoint& p = r.points.emplace_back(test.unstepped(r.material.spectrum, t, test.when));
      text += fmt::format("{},{:.2e}\n", csv_line(words, p), r.material.error());
    }
    write_whole(out / words.file, text);
    found.found = std::move(r);
  };
  return plan_material(scene, prepared, watcher, result, test.history, test.poisson_ratio, responds);
}

template <>
void ResultOf<SpectrumResponse>::summarise(const SpectrumResponse& found, const Scene& scene, const RunResult&,
                                           nlohmann::ordered_json& summary) {
  nlohmann::ordered_json out = material_json(found.kind.c_str(), found.material);
  add_load(load_test_of(scene), out);
  add_extremes(found.kind, found.points, out);
  for (const ResponsePoint& p : found.points) out["points"].push_back(point_json(load_words(found.kind), p));
  summary["results"].push_back(std::move(out));
}

template <>
double ResultOf<SpectrumResponse>::seconds(const SpectrumResponse& found) {
  return found.material.seconds;
}

template <>
std::string ResultOf<SpectrumResponse>::table(const SpectrumResponse& found) {
  const LoadWords& words = load_words(found.kind);
  std::string out = shown_head(words.shown);
  for (const ResponsePoint& p : found.points) out += shown_line(words, words.shown, p);
  return out + "\n" + material_lines(found.material);
}

}  // namespace macadam
