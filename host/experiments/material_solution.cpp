// SPDX-License-Identifier: GPL-3.0-or-later
// material_solution.cpp  Checks the scene, computes the spectrum, and reduces it to few units for the tables.
#include "host/experiments/material_solution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "host/experiments/material_files.hpp"
#include "host/harmonic/law_stiffness.hpp"
#include "host/base/seconds_of.hpp"
#include "host/run/harmonic_options.hpp"
#include "host/run/phases.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

using experiments::Material;

/// Relative tolerance of E(t) if the section [solver] of the scene gives no tolerance.
constexpr double usual_tolerance = 1e-5;
/// The same for the rule "volumetric", with which a sum of exponentials is not exact (volumetric_spectrum.cpp).
constexpr double usual_tolerance_volumetric = 1e-4;

class PlannedMaterial : public PlannedExperiment {
 public:
  PlannedMaterial(const Scene& scene, const Preparation& prepared, const Watcher& watcher, RunResult& result,
                  const History& history, double poisson_ratio, Responds responds)
      : scene_(scene),
        prepared_(prepared),
        watcher_(watcher),
        poisson_ratio_(poisson_ratio),
        responds_(std::move(responds)) {
    const SolverSpec& solver = scene.solver;
    if (solver.inertia) {
      throw InputError(scene.file.string(), 0, "inertia in [solver]",
                       std::string("true with kind \"") + kind_of(scene.experiment) + "\"",
                       "false, because relaxation is computed without inertia");
    }
    // The CPU is used instead of the reference backend, which implements time steps only. The CPU is also used instead
    // of a device if the direct solver is requested, which runs on the CPU only. solve_frequencies.cpp does the same.
    if (result.backend == Backend::reference || solver.linear == LinearMethod::direct) result.backend = Backend::cpu;
    result.solver = std::string("relaxation spectrum, without inertia, ") + to_string(result.backend);
    std::tie(options_.shortest, options_.longest) = history.range();
    options_.tolerance = solver.tolerance.value_or(
        scene.network.rule == ContactRule::volumetric ? usual_tolerance_volumetric : usual_tolerance);
    options_.backend = result.backend == Backend::cuda ? Backend::cuda : Backend::cpu;
    if (options_.backend == Backend::cuda) options_.devices = solver.devices;
    options_.linear = solver.linear;
    options_.stop = watcher.stop;
    require_solvable(result);
  }

  void solve(const std::filesystem::path& out, const Saving& save, RunResult& result) override {
    save("running");
    options_.on_progress = [&](int solutions, double error) {
      if (watcher_.progress) {
        watcher_.progress(fmt::format("spectrum: {} solutions, error {:.1e} (tolerance {:.1e})", solutions, error,
                                      options_.tolerance),
                          std::min(1.0, std::log(error) / std::log(options_.tolerance)));
      }
    };
    Material material;
    material.seconds = seconds_of([&] {
      try {
        const InPhase in(result.phases, &PhaseSeconds::harmonic);
        material.spectrum = spectrum_of(prepared_.specimen, prepared_.network, scene_.laws, options_);
      } catch (const InterruptedError&) {
        throw InterruptedError("interrupted while the spectrum was computed; this computation writes no checkpoints");
      }
    });
    material.shortest_s = options_.shortest, material.longest_s = options_.longest;
    material.confined = scene_.network.lateral_walls;
    material.relaxation =
        few_units(material.spectrum.relaxation, options_.shortest, options_.longest, options_.tolerance);
    material.creep = creep_series(material.relaxation);
    material.table_error =
        difference(material.relaxation, material.spectrum.relaxation, options_.shortest, options_.longest);
    const InPhase writing(result.phases, &PhaseSeconds::writing);
    write_material(out, material, poisson_ratio_);
    if (material.confined) {
      result.warnings.emplace_back(
          "no tables for finite-element programs are written, because such tables need uniaxial moduli, and the sides "
          "are held");
    }
    responds_(out, std::move(material), result);
  }

 private:
  /// Builds the solver once, so that laws and networks that it cannot solve are refused during planning.
  void require_solvable(RunResult& result) const {
    if (watcher_.progress) watcher_.progress("spectrum: preconditioner", 0);
    const InPhase in(result.phases, &PhaseSeconds::preconditioner);
    require_stiffness(scene_.laws);
    for (const auto& law : scene_.laws)
      if (law) prony_series(*law);
    HarmonicOptions options = harmonic_options(scene_, result.backend, watcher_.stop);
    options.typical_growth = 1 / options_.longest;
    Harmonic(prepared_.specimen, prepared_.network, scene_.laws, make_inertia(prepared_.specimen, 1, 1), options, 0);
  }

  const Scene& scene_;
  const Preparation& prepared_;
  const Watcher& watcher_;
  double poisson_ratio_;
  Responds responds_;
  SpectrumOptions options_;
};

nlohmann::ordered_json relaxation_json(const PronySeries& series) {
  nlohmann::ordered_json out = {{"long_term_pa", series.long_term}, {"units", nlohmann::ordered_json::array()}};
  for (const auto& u : series.units) out["units"].push_back({{"modulus_pa", u.modulus}, {"time_s", u.time}});
  return out;
}

}  // namespace

std::pair<double, double> History::range() const {
  // the last tenth of a load change before a time has little effect, so E at times shorter than this tenth is not
  // needed
  double shortest = 0.1 * shortest_change, longest = 0;
  for (const double t : times) {
    for (const Ramp& r : ramps) {
      const double since = t - r.begin;
      if (!(since > 0)) continue;
      longest = std::max(longest, since);
      // `grown`: the part of the ramp before t
      const double grown = std::min(since, r.duration);
      shortest = std::min(shortest, std::max(since - grown, 0.1 * grown));
    }
  }
  return {shortest, std::max(longest, 2 * shortest)};
}

const char* modulus_words(bool confined) {
  return confined ? "confined modulus (the sides are held)" : "uniaxial modulus (the sides are free)";
}

std::unique_ptr<PlannedExperiment> plan_material(const Scene& scene, const Preparation& prepared,
                                                 const Watcher& watcher, RunResult& result, const History& history,
                                                 double poisson_ratio, Responds responds) {
  return std::make_unique<PlannedMaterial>(scene, prepared, watcher, result, history, poisson_ratio,
                                           std::move(responds));
}

nlohmann::ordered_json material_json(const char* kind, const Material& m) {
  return {{"kind", kind},
          {"sides", m.confined ? "held" : "free"},
          {"modulus", m.confined ? "confined" : "uniaxial"},
          {"shortest_s", m.shortest_s},
          {"longest_s", m.longest_s},
          {"error", m.spectrum.error},
          {"difference_from_harmonic", m.spectrum.checked},
          {"solutions", m.spectrum.solutions},
          {"solve_s", m.seconds},
          {"instantaneous_pa", m.spectrum.relaxation.instantaneous()},
          {"prony", relaxation_json(m.relaxation)},
          {"table_error", m.table_error}};
}

std::string material_lines(const Material& m) {
  return fmt::format(
      "{}; E(t) from {:g} to {:g} s has a relative error of {:.1e}, from {} solutions in {:.1f} s\n"
      "The Prony series of {} units and the Kelvin chain of {} units differ from E(t) by at most {:.1e}\n",
      modulus_words(m.confined), m.shortest_s, m.longest_s, m.error(), m.spectrum.solutions, m.seconds,
      m.relaxation.units.size(), m.creep.units.size(), m.table_error);
}

}  // namespace macadam
