// SPDX-License-Identifier: GPL-3.0-or-later
/// \file parameters.hpp  Lists the parameters of a scene's laws by name, and changes their values.
#pragma once

#include <string>
#include <vector>

#include "macadam/calibration.hpp"

namespace macadam::calibration {

/// One parameter, for example "M-A.E_1": its pair, and its key in the `[[contacts]]` section of the pair.
struct Parameter {
  std::string name, unit;
  PairType pair{};
  std::string key;
  double value = 0;  ///< as in the scene's file
};

/// Returns all parameters that the scene's laws have, except an α of 0 and an infinite C_m.
std::vector<Parameter> parameters_of(const Scene& scene);

/// Multiplies a parameter of the laws by a factor.
void multiply(LawTable& laws, const Parameter& parameter, double factor);

}  // namespace macadam::calibration
