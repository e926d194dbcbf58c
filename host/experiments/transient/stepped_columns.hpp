// SPDX-License-Identifier: GPL-3.0-or-later
/// \file stepped_columns.hpp  Defines the columns that the table of a stepped test has after time, strain and stress.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "macadam/experiments/response.hpp"

namespace macadam {

/// The columns after those of csv_head().
struct SteppedColumns {
  bool top = false;          ///< stress at the top wall, if the load is a stress
  bool broken = false;       ///< broken points
  bool energies = false;     ///< cracked points and energies
  bool damping = false;      ///< energy that damping takes
  bool sides = false;        ///< Poisson's ratio, if the sides are free
  bool temperature = false;  ///< temperature and, with energies, work against expansion
  double length = 0;         ///< gauge length, if a row has displacement and load [m]; 0: it has not
  double section = 0;        ///< area of the section, if a row has displacement and load [m²]

  /// Return the names of the columns and their values at a point.
  /// @{
  std::string head() const;
  std::string line(const experiments::SteppedPoint& point) const;
  /// @}
};

/// Adds energies to a point of summary.json. `damping`, `thermal`: with the energy that damping takes, and with the
/// work against expansion.
void add_energies(const experiments::Energies& energies, bool damping, bool thermal, nlohmann::ordered_json& point);

}  // namespace macadam
