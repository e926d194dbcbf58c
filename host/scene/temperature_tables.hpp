// SPDX-License-Identifier: GPL-3.0-or-later
/// \file temperature_tables.hpp  Reads values that a scene may give as a table over temperature.
#pragma once

#include <optional>

#include "host/scene/table.hpp"

namespace macadam::scene {

/// The temperature of a scene, at which its tables are evaluated.
struct TemperatureTables {
  std::optional<double> temperature = {};  ///< of `[materials]` [°C]
  bool used = false;                       ///< whether a value was read from a table
};

/// Returns a reader of a positive number, or of a table `{ temperatures = […], values = […] }`, which is evaluated
/// linearly between its temperatures. A number without a unit must satisfy `bare`. The reader refuses a temperature
/// outside the table, and a table in a scene without a temperature. `target` and `tables` must outlive the reading.
Reader at_temperature(std::optional<double>& target, const Quantity& quantity, const Rule& bare,
                      TemperatureTables& tables);

}  // namespace macadam::scene
