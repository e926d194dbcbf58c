// SPDX-License-Identifier: GPL-3.0-or-later
/// \file unit_question.hpp  Detects measurements that seem to be in another unit than the names of their columns say.
#pragma once

#include <string>

#include "host/tools/fit/laboratory_table.hpp"
#include "macadam/fit.hpp"

namespace macadam::fitting {

/// The columns of a table from which measurements were read; a name is empty if there is no such column.
struct ColumnsRead {
  std::string modulus, phase, temperature;
  double modulus_factor = 1;  ///< |E*| divided by the modulus in the column: 2·(1 + ν) for G*
};

/// Adds a question to the complaints if moduli, phases or temperatures cannot be in the unit of their column. The user
/// answers it by a column name with the unit that is meant.
void ask_about_units(const ModulusData& data, const ColumnsRead& columns, Complaints& complaints);

}  // namespace macadam::fitting
