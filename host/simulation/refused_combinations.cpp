// SPDX-License-Identifier: GPL-3.0-or-later
// refused_combinations.cpp  Refuses settings of a scene and of the command line that do not go together.
#include "host/simulation/refused_combinations.hpp"

#include <fmt/format.h>

#include "host/experiments/experiment.hpp"
#include "host/experiments/transient/bottom_notch.hpp"
#include "host/harmonic/law_stiffness.hpp"
#include "host/run/checkpoints.hpp"
#include "host/scene/cooling_conditions.hpp"
#include "macadam/error.hpp"

namespace macadam {

namespace {

/// Refuses scenes that cannot be computed with the rule "volumetric". \throws InputError.
void require_volumetric(const Scene& scene) {
  const auto refuse = [&](const std::string& what, const std::string& found, const std::string& expected) {
    throw InputError(scene.file.string(), 0, what, found, expected);
  };
  if (scene.solver.method != SolverMethod::harmonic)
    refuse("rule in [network]", fmt::format("\"volumetric\" with method \"{}\"", to_string(scene.solver.method)),
           "method \"harmonic\", or rule \"series\", because time steps and increments do not compute the pressures of "
           "cells");
  if (scene.solver.backend == Backend::cuda)
    refuse("backend in [solver]", "\"cuda\" with rule \"volumetric\"",
           "\"cpu\", because the solver on GPUs does not compute the pressures of cells");
}

/// Refuses the tests of a domain that has no two platens with equal sections between them, because stress and strain
/// of every test are those of such a domain. \throws InputError.
[[noreturn]] void require_uniform_section(const Scene& scene) {
  throw InputError(
      scene.file.string(), 0, "kind in [loading]",
      fmt::format("\"{}\" with domain = \"{}\" in [specimen]", kind_of(scene.experiment), scene.specimen.box.name()),
      "a domain with two platens and equal sections between them, such as \"box\", \"cylinder\" or "
      "\"beam\"; kind = \"indirect_tension\" or \"indirect_tensile_strength\" for \"disc\", "
      "\"semicircular_bending\" for \"half_disc\"; macadam specimen makes specimens of every domain");
}

/// Refuses a setting that the test of the scene does not have. \throws InputError
[[noreturn]] void refuse_with_kind(const Scene& scene, const char* what, const std::string& found,
                                   const std::string& expected) {
  throw InputError(scene.file.string(), 0, fmt::format("{} with kind \"{}\"", what, kind_of(scene.experiment)), found,
                   expected);
}

/// Refuses what tests of other deformations than uniaxial ones do not have. `domain`: name of the domain that the test
/// needs. \throws InputError
void require_domain(const Scene& scene, const std::string& domain) {
  if (scene.specimen.box.name() != domain)
    refuse_with_kind(scene, "domain in [specimen]", std::string("\"") + scene.specimen.box.name() + "\"",
                     '"' + domain + '"');
  if (scene.network.lateral_walls) refuse_with_kind(scene, "lateral_walls in [network]", "true", "false");
  if (scene.network.rule == ContactRule::volumetric)
    refuse_with_kind(scene, "rule in [network]", "\"volumetric\"", "\"centres\" or \"series\"");
  if (scene.output.sensitivities) refuse_with_kind(scene, "sensitivities in [output]", "true", "false");
}

/// Refuses a torsion test with another domain than a cylinder, a notch, or platens without shear stiffness. \throws
/// InputError
void require_torsion(const Scene& scene) {
  require_domain(scene, domains::Cylinder::name);
  if (!scene.network.notches.empty())
    refuse_with_kind(scene, "[[specimen.notch]]", "a notch",
                     "no notch, because the torsion constant is that of the whole section");
  const FactsTable laws = facts_of(scene.laws);
  for (const PairType pair : {PairType::aw, PairType::mw}) {
    const std::optional<LawFacts>& law = laws[static_cast<std::size_t>(pair)];
    if (law && law->alpha == 0)
      refuse_with_kind(scene, fmt::format("alpha of {} in [[contacts]]", to_string(pair)).c_str(), "0",
                       "a number above 0, because the platens are glued to the cylinder and turn it by shear");
  }
}

/// Refuses a strength test if the scene has no cracks, or if the method cannot follow cracks. \throws InputError
void require_cracks(const Scene& scene) {
  if (!can_crack(facts_of(scene.laws)))
    refuse_with_kind(scene, "laws in [[contacts]]", "no crack", "a law with a crack between particles");
  if (scene.solver.method == SolverMethod::harmonic)
    refuse_with_kind(scene, "method in [solver]", "\"harmonic\"",
                     "\"quasi_static\" or \"explicit\", because cracks are not linear");
}

/// Refuses a bending test to failure with another domain, without cracks, or with an unsuitable notch. `domain`: name
/// of the domain that the test needs. \throws InputError
void require_bent_to_failure(const Scene& scene, const std::string& domain) {
  require_domain(scene, domain);
  require_cracks(scene);
  if (bottom_notch(scene.specimen.box, scene.network.notches)) return;
  refuse_with_kind(scene, "[[specimen.notch]]", "a notch of another kind, or several notches",
                   "no notch, or one notch with axis = \"x\" that begins at z = 0, ends within the specimen and passes "
                   "through the whole thickness along y");
}

bool is_of_disc(const Experiment& experiment) {
  return std::holds_alternative<experiments::IndirectTension>(experiment) ||
         std::holds_alternative<experiments::IndirectTensileStrength>(experiment);
}

}  // namespace

Backend requested_backend(const Scene& scene) {
  const bool on_cpu =
      scene.solver.method == SolverMethod::quasi_static && !temperature_history_of(scene.experiment).empty();
  return on_cpu && scene.solver.backend == Backend::automatic ? Backend::cpu : scene.solver.backend;
}

void require_combination(const Scene& scene) {
  if (std::holds_alternative<experiments::Bending>(scene.experiment))
    require_domain(scene, domains::Beam::name);
  else if (std::holds_alternative<experiments::SemicircularBending>(scene.experiment))
    require_bent_to_failure(scene, domains::HalfDisc::name);
  else if (std::holds_alternative<experiments::ThreePointBending>(scene.experiment))
    require_bent_to_failure(scene, domains::Beam::name);
  else if (std::holds_alternative<experiments::Torsion>(scene.experiment))
    require_torsion(scene);
  else if (is_of_disc(scene.experiment))
    require_domain(scene, domains::Disc::name);
  else if (!scene.specimen.box.has_uniform_section())
    require_uniform_section(scene);
  if (std::holds_alternative<experiments::IndirectTensileStrength>(scene.experiment)) require_cracks(scene);
  if (scene.network.rule == ContactRule::volumetric) require_volumetric(scene);
  if (scene.solver.method == SolverMethod::explicit_ && stepping_of(scene.experiment) == experiments::Stepping::never) {
    throw InputError(scene.file.string(), 0, "method",
                     std::string("\"explicit\" with kind \"") + kind_of(scene.experiment) + "\"",
                     "\"harmonic\", because this kind is not stepped in time");
  }
  if (scene.solver.method == SolverMethod::explicit_ && scene.network.rule == ContactRule::series &&
      can_crack(facts_of(scene.laws))) {
    throw InputError(scene.file.string(), 0, "method", "\"explicit\" with cracks and rule = \"series\" in [network]",
                     "\"quasi_static\", because time steps do not compute cracks in series with rock");
  }
  if (scene.solver.method == SolverMethod::explicit_ && scene.solver.inertia) {
    throw InputError(scene.file.string(), 0, "inertia", "true with method \"explicit\"",
                     "no key inertia, because this method always has inertia; or method \"harmonic\"");
  }
  if (scene.solver.method == SolverMethod::explicit_ && scene.output.sensitivities) {
    throw InputError(scene.file.string(), 0, "sensitivities in [output]", "true with method \"explicit\"",
                     "false, or method \"harmonic\"");
  }
  if (scene.solver.method == SolverMethod::explicit_ && !temperatures_of(scene.experiment).empty()) {
    throw InputError(
        scene.file.string(), 0, "temperatures in [loading]",
        fmt::format("{} temperature(s) with method \"explicit\"", temperatures_of(scene.experiment).size()),
        "method \"harmonic\", or a single temperature as temperature in [materials]");
  }
  if (scene.solver.method != SolverMethod::quasi_static && !temperature_history_of(scene.experiment).empty()) {
    const bool cools = std::holds_alternative<experiments::Cooling>(scene.experiment);
    throw InputError(
        scene.file.string(), 0, cools ? "kind in [loading]" : "temperature in [loading]",
        fmt::format("{} with method \"{}\"", cools ? "\"cooling\"" : "a list", to_string(scene.solver.method)),
        "method \"quasi_static\", because only increments follow a changing temperature" +
            (cools ? "; " + scene::why_cooling_has_no_steps(scene) : ""));
  }
  if (scene.solver.method == SolverMethod::quasi_static) {
    const auto refuse = [&](const char* what, const std::string& found, const char* expected) {
      throw InputError(scene.file.string(), 0, std::string(what) + " with method \"quasi_static\"", found, expected);
    };
    if (stepping_of(scene.experiment) == experiments::Stepping::never)
      refuse("kind", kind_of(scene.experiment),
             "\"cyclic\", \"monotonic\", \"relaxation\", \"creep\", \"history\", \"indirect_tensile_strength\", "
             "\"semicircular_bending\", \"three_point_bending\" or \"cooling\"");
    if (scene.solver.backend == Backend::reference) refuse("backend", "reference", "auto, cpu or cuda");
    if (scene.solver.backend == Backend::cuda && !temperature_history_of(scene.experiment).empty())
      refuse("backend", "cuda and a temperature that changes",
             "auto or cpu, because no GPU computes thermal expansion");
    if (scene.solver.devices.size() > 1)
      refuse("device", to_string(scene.solver.devices), "one device, because several cannot share such a test");
    if (scene.solver.precision.value_or(Precision::double_) != Precision::double_)
      refuse("precision", to_string(*scene.solver.precision), "double");
    if (scene.solver.inertia)
      refuse("inertia", "true", "false, because increments have no inertia; or method = \"explicit\"");
    if (scene.output.sensitivities) refuse("sensitivities in [output]", "true", "false");
    if (!temperatures_of(scene.experiment).empty())
      refuse("temperatures in [loading]", "a list", "a single temperature as temperature in [materials]");
  }
  if (scene.output.fields.any() && !has_fields(scene)) {
    throw InputError(scene.file.string(), 0, "fields in [output]",
                     std::string("fields with method \"harmonic\" of kind \"") + kind_of(scene.experiment) + "\"",
                     "no fields, or method \"explicit\"");
  }
  if (scene.solver.method == SolverMethod::harmonic) {
    if (const auto without = first_without_stiffness(scene.laws)) {
      const bool linear = facts_of(scene.laws)[static_cast<std::size_t>(without->pair)]->linear;
      throw InputError(
          scene.file.string(), 0, std::string("law of ") + to_string(without->pair) + " with method \"harmonic\"",
          std::string(without->law) + ", which has no complex stiffness" + (linear ? "" : " because it is not linear"),
          "a law that has a complex stiffness, or method = \"explicit\" if the test can be stepped");
    }
    return;
  }
  std::string why_not;
  if (scene.output.checkpoint.value_or(0) > 0 && !keeps_checkpoints(scene, scene.solver.backend, &why_not)) {
    throw InputError(scene.file.string(), 0, "checkpoint in [output]", fmt::format("{} s", *scene.output.checkpoint),
                     "0, because " + why_not);
  }
  if (scene.solver.backend != Backend::reference) return;
  const auto refuse = [&](const char* what, const char* found, const char* expected) {
    throw InputError(scene.file.string(), 0, std::string(what) + " with backend reference", found, expected);
  };
  if (scene.solver.precision.value_or(Precision::double_) != Precision::double_) {
    refuse("precision", to_string(*scene.solver.precision), "double");
  }
  if (scene.network.quadrature == Quadrature::exact)
    refuse("quadrature", "exact", "lumped, because this backend computes each contact point by itself");
}

}  // namespace macadam
