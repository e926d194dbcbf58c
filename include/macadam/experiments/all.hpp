// SPDX-License-Identifier: GPL-3.0-or-later
/// \file all.hpp  Lists the experiments that a scene may request.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "macadam/experiments/bending.hpp"
#include "macadam/experiments/cooling.hpp"
#include "macadam/experiments/creep.hpp"
#include "macadam/experiments/cyclic.hpp"
#include "macadam/experiments/indirect_tensile_strength.hpp"
#include "macadam/experiments/indirect_tension.hpp"
#include "macadam/experiments/monotonic.hpp"
#include "macadam/experiments/relaxation.hpp"
#include "macadam/experiments/response.hpp"
#include "macadam/experiments/semicircular_bending.hpp"
#include "macadam/experiments/strain_history.hpp"
#include "macadam/experiments/sweep.hpp"
#include "macadam/experiments/three_point_bending.hpp"
#include "macadam/experiments/torsion.hpp"

namespace macadam {

/// The experiment that `[loading]` of a scene requests. Its `kind` selects one of these types.
using Experiment =
    std::variant<experiments::Cyclic, experiments::Sweep, experiments::Relaxation, experiments::Creep,
                 experiments::Monotonic, experiments::StrainHistory, experiments::IndirectTension,
                 experiments::IndirectTensileStrength, experiments::Bending, experiments::SemicircularBending,
                 experiments::ThreePointBending, experiments::Torsion, experiments::Cooling>;

/// The result of an experiment. Its type depends on the experiment and on the method that ran; it is monostate before a
/// run.
using ExperimentResult =
    std::variant<std::monostate, experiments::SteppedCyclic, experiments::HarmonicCyclic, experiments::SweepResult,
                 experiments::SpectrumResponse, experiments::SteppedResponse>;

/// Returns the name of the experiment, which is the value of `kind` in `[loading]`.
inline const char* kind_of(const Experiment& experiment) {
  return std::visit([](const auto& spec) { return spec.kind; }, experiment);
}

/// Returns the result files that a run of this experiment may write, in addition to the files that every run writes.
inline std::vector<std::string> files_of(const Experiment& experiment) {
  return std::visit([](const auto& spec) { return std::vector<std::string>(spec.files.begin(), spec.files.end()); },
                    experiment);
}

/// Returns whether the experiment may be stepped in time (method "explicit").
inline experiments::Stepping stepping_of(const Experiment& experiment) {
  return std::visit([](const auto& spec) { return spec.stepping; }, experiment);
}

/// Returns the frequencies of the experiment [Hz]; without frequencies, an empty list.
inline std::vector<double> frequencies_of(const Experiment& experiment) {
  return std::visit(
      [](const auto& spec) -> std::vector<double> {
        if constexpr (requires { spec.frequencies; }) return spec.frequencies;
        return {};
      },
      experiment);
}

/// Returns the temperatures at which the experiment is done [°C]; without temperatures, an empty list.
inline std::vector<double> temperatures_of(const Experiment& experiment) {
  return std::visit(
      [](const auto& spec) -> std::vector<double> {
        if constexpr (requires { spec.temperatures; }) return spec.temperatures;
        return {};
      },
      experiment);
}

/// Returns the temperature during the experiment; empty if it is constant.
inline TemperatureHistory temperature_history_of(const Experiment& experiment) {
  return std::visit(
      [](const auto& spec) -> TemperatureHistory {
        if constexpr (requires { spec.temperature; }) return spec.temperature;
        return {};
      },
      experiment);
}

}  // namespace macadam
