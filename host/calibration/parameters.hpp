// SPDX-License-Identifier: GPL-3.0-or-later
/// \file parameters.hpp  The parameters of a scene's laws by their names.
#pragma once

#include <string>
#include <vector>

#include "macadam/calibration.hpp"

namespace macadam::calibration {

/// One of them, "M-A.E_1": its pair and the key in the pair's section.
struct Parameter {
  std::string name, unit;
  PairType pair{};
  std::string key;
  double value = 0;  ///< in the scene's file
};

/// All parameters that the scene's laws have; no α of 0, no C_m of infinity.
std::vector<Parameter> parameters_of(const Scene& scene);

/// Laws whose parameter is multiplied by a factor.
void multiply(LawTable& laws, const Parameter& parameter, double factor);

}  // namespace macadam::calibration
