// SPDX-License-Identifier: GPL-3.0-or-later
/// \file parameters.hpp  Lists the parameters of a scene's laws by name, and changes their values.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "macadam/calibration.hpp"

namespace macadam::calibration {

/// One parameter, for example "M-A.E_1": its pair, and its key in the `[[contacts]]` section of the pair. With the rule
/// "series" a parameter belongs to a phase, for example "mastic.E_1", with its key in the section of the phase in
/// `[materials]`.
struct Parameter {
  std::string name, unit;
  std::optional<Phase> phase;  ///< empty with the rule "centres"
  PairType pair{};             ///< used only without a phase
  std::string key;
  double value = 0;  ///< as in the scene's file
};

/// Returns all parameters that the scene's laws have, except an α of 0 and an infinite C_m. With the rule "series"
/// these are the parameters of the laws of mastic and rock.
std::vector<Parameter> parameters_of(const Scene& scene);

/// Multiplies a parameter of the laws by a factor; a parameter of a phase in the laws of all its pairs.
void multiply(LawTable& laws, const Parameter& parameter, double factor);

/// Returns the compliance of the rock in series with the laws over its compliance in the scene. `laws`: the scene's
/// laws with other values. Returns 1 with the rule "centres", or without rock.
double rock_compliance(const Scene& scene, const LawTable& laws);

}  // namespace macadam::calibration
