// SPDX-License-Identifier: GPL-3.0-or-later
// solve_frequencies.cpp  Implements method "harmonic": solves the steady states of all frequencies, four side by side.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "host/experiments/cyclic/beam_modulus.hpp"
#include "host/experiments/cyclic/disc_modulus.hpp"
#include "host/experiments/cyclic/judgement.hpp"
#include "host/experiments/cyclic/torsion_modulus.hpp"
#include "host/run/harmonic_options.hpp"
#include "host/fields/field_output.hpp"
#include "host/run/phases.hpp"
#include "host/experiments/cyclic/plan.hpp"
#include "host/experiments/cyclic/methods.hpp"
#include "macadam/error.hpp"
#include "macadam/harmonic.hpp"

namespace macadam {

using experiments::HarmonicFrequency;

namespace {

/// Returns the names of the scene's settings that only a stepped run uses.
std::string unused_settings(const Scene& scene) {
  const SolverSpec& s = scene.solver;
  const auto* cyclic = std::get_if<experiments::Cyclic>(&scene.experiment);
  const experiments::Cyclic l = cyclic ? *cyclic : experiments::Cyclic{};
  std::string out;
  for (const auto& [given, name] : {std::pair{s.tolerance.has_value(), "tolerance"},
                                    {s.density_scaling && !s.inertia, "density_scaling"},
                                    {s.safety.has_value(), "safety"},
                                    {s.time_step.has_value(), "time_step"},
                                    {s.form.has_value(), "form"},
                                    {s.geometry.has_value(), "geometry"},
                                    {s.precision.has_value(), "precision"},
                                    {l.start.has_value(), "start"},
                                    {l.cycles.has_value(), "cycles"},
                                    {l.ramp_cycles.has_value(), "ramp_cycles"},
                                    {scene.output.fields.every.has_value(), "every"}}) {
    if (given) out += (out.empty() ? "" : ", ") + std::string(name);
  }
  return out;
}

/// Describes the method, for the results.
std::string described(const Scene& scene, double viscous, Backend backend) {
  const SolverSpec& solver = scene.solver;
  std::string out = solver.inertia ? "harmonic, with inertia" : "harmonic, without inertia";
  if (viscous > 0) out += " and viscous damping";
  out += std::string(", ") + to_string(backend);
  if (solver.damping_kind != Damping::none && viscous == 0) {
    out += fmt::format("; {} damping is not used", to_string(solver.damping_kind));
  }
  if (const std::string unused = unused_settings(scene); !unused.empty())
    out += "; settings that this method does not use: " + unused;
  return out;
}

class PlannedHarmonic : public PlannedExperiment {
 public:
  PlannedHarmonic(const Scene& scene, const Preparation& prepared, const Watcher& watcher, RunResult& result,
                  ListOfStates states)
      : scene_(scene), prepared_(prepared), watcher_(watcher), states_(states) {
    const SolverSpec& solver = scene.solver;
    viscous_ = solver.inertia && solver.damping_kind == Damping::viscous ? solver.damping : 0;
    // the reference backend implements time steps only; the direct solver and the rule "volumetric" need the CPU
    if (result.backend == Backend::reference || solver.linear == LinearMethod::direct ||
        scene.network.rule == ContactRule::volumetric)
      result.backend = Backend::cpu;
    result.solver = described(scene, viscous_, result.backend);
    if (watcher.progress) watcher.progress("harmonic: preconditioner", 0);
    backend_ = result.backend;
    if (!temperatures_.empty()) set_temperature(temperatures_.front());
    prepare_solver(result);
  }

  void solve(const std::filesystem::path& out, const Saving& save, RunResult& result) override {
    save("running");
    fields_.emplace(scene_, prepared_, out);
    solve_isotherm(save, result);
    for (std::size_t i = 1; i < temperatures_.size(); ++i) {
      set_temperature(temperatures_[i]);
      prepare_solver(result);
      solve_isotherm(save, result);
    }
  }

 private:
  void set_temperature(double temperature) {
    isothermal_.laws = laws_at(scene_, temperature);
    isothermal_.materials.temperature = temperature;
  }

  void prepare_solver(RunResult& result) {
    const InPhase in(result.phases, &PhaseSeconds::preconditioner);
    const Inertia inertia = make_inertia(prepared_.specimen, scene_.materials.aggregate, scene_.materials.mastic);
    harmonic_.emplace(prepared_.specimen, prepared_.network, isothermal_.laws, inertia,
                      harmonic_options(scene_, backend_, watcher_.stop), geometric_mean(frequencies_));
  }

  void solve_isotherm(const Saving& save, RunResult& result) {
    const InPhase in(result.phases, &PhaseSeconds::harmonic);
    const auto& frequencies = frequencies_;
    const std::optional<double>& temperature = isothermal_.materials.temperature;
    const std::string at = temperature ? fmt::format(" at {} degrees C", *temperature) : "";
    constexpr std::size_t block = 4;  // number of frequencies that are solved side by side
    for (std::size_t i = 0; i < frequencies.size(); i += block) {
      const std::size_t end = std::min(i + block, frequencies.size());
      const std::string where = fmt::format("{} Hz{} ({} of {})", frequencies[i], at, i + 1, frequencies.size());
      if (watcher_.progress) {
        watcher_.progress("harmonic: " + where, static_cast<double>(i) / static_cast<double>(frequencies.size()));
      }
      try {
        if (watcher_.stop && watcher_.stop()) throw InterruptedError("");
        const std::optional<std::vector<HarmonicResult>> solved = try_to_solve(i, end);
        if (solved) {
          take(*solved, result, save);
        } else {
          // One frequency has no solution. The frequencies before it are solved one by one, and their results are kept.
          for (std::size_t k = i; k < end; ++k) take(solve(k, k + 1), result, save);
        }
      } catch (const InterruptedError&) {
        throw InterruptedError(
            "interrupted at " + where +
            "; summary.json holds the results up to there; a run with method harmonic writes no checkpoints");
      }
    }
  }

  /// Solves a range of frequencies together. Returns nothing if one of several frequencies has no solution. \throws
  /// RunError if a single frequency has none.
  std::optional<std::vector<HarmonicResult>> try_to_solve(std::size_t first, std::size_t end) {
    try {
      return solve(first, end);
    } catch (const InterruptedError&) { throw; } catch (const RunError&) {
      if (end - first == 1) throw;
      return {};
    }
  }

  std::vector<HarmonicResult> solve(std::size_t first, std::size_t end) {
    std::vector<HarmonicLoad> loads;
    for (std::size_t i = first; i < end; ++i) {
      const double scaling = scene_.solver.inertia ? density_scaling_of(scene_.solver, i) : 0;
      loads.push_back({frequencies_[i], scaling, viscous_});
      loads.back().top = wall_;
    }
    return harmonic_->solve(loads);
  }

  void take(const std::vector<HarmonicResult>& solved, RunResult& result, const Saving& save) {
    for (const HarmonicResult& s : solved) {
      const std::size_t i = states_(result).size() % frequencies_.size();
      HarmonicFrequency f;
      static_cast<experiments::Frequency&>(f) =
          frequency_of(scene_, s.frequency_hz, isothermal_.materials.temperature,
                       scene_.solver.inertia ? density_scaling_of(scene_.solver, i) : 0, s.top, s.seconds);
      f.linear = s.linear;
      if (!s.why_factors.empty()) {
        result.warnings.push_back(
            fmt::format("{} Hz: solved with the direct solver, because the iterative solver cannot be used: {}",
                        s.frequency_hz, s.why_factors));
      }
      f.parts = s.parts;
      f.bottom = s.bottom;
      if (!f.confined) f.poisson_ratio = poisson_ratio(prepared_.specimen, prepared_.tessellation, s);
      f.residual = s.residual;
      f.iterations = s.iterations;
      f.held_force = s.held_force;
      if (const auto* test = std::get_if<experiments::IndirectTension>(&scene_.experiment))
        observe_disc(*test, prepared_.specimen, prepared_.tessellation, s, f);
      if (const auto* test = std::get_if<experiments::Bending>(&scene_.experiment))
        observe_beam(*test, prepared_.specimen, prepared_.network, isothermal_.laws, s, f);
      if (s.wall.turns()) observe_torsion(prepared_.specimen, s, f);
      judge(f, stiffest_contact(isothermal_, prepared_.network, f.frequency_hz), result.warnings);
      {
        const InPhase writing(result.phases, &PhaseSeconds::writing);
        const bool several = !temperatures_.empty();
        fields_->write(s, isothermal_.laws, several ? f.temperature_c : std::nullopt);
      }
      states_(result).push_back(std::move(f));
    }
    save("running");
  }

  const Scene& scene_;
  const Preparation& prepared_;
  const Watcher& watcher_;
  ListOfStates states_;
  std::vector<double> frequencies_ = frequencies_of(scene_.experiment),
                      temperatures_ = temperatures_of(scene_.experiment);
  Backend backend_ = Backend::cpu;
  WallMotion wall_ = std::holds_alternative<experiments::Torsion>(scene_.experiment)
                         ? WallMotion::turn(prepared_.specimen)
                         : WallMotion();
  Scene isothermal_ = scene_;  ///< the scene with the laws of the present temperature
  double viscous_ = 0;
  std::optional<Harmonic> harmonic_;
  std::optional<FieldOutput> fields_;
};

}  // namespace

std::unique_ptr<PlannedExperiment> plan_harmonic(const Scene& scene, const Preparation& prepared,
                                                 const Watcher& watcher, RunResult& result, ListOfStates states) {
  return std::make_unique<PlannedHarmonic>(scene, prepared, watcher, result, states);
}

}  // namespace macadam
