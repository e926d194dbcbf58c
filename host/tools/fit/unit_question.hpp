// SPDX-License-Identifier: GPL-3.0-or-later
/// \file unit_question.hpp  Detects measurements that seem to be in another unit than the names of their columns say.
#pragma once

#include <string>

#include "host/tools/fit/laboratory_table.hpp"
#include "macadam/fit.hpp"

namespace macadam::fitting {

/// Adds a question to the complaints if moduli or temperatures cannot be in the unit of their column. The user answers
/// it by a column name with the unit that is meant.
void ask_about_units(const ModulusData& data, const std::string& modulus_column, const std::string& temperature_column,
                     Complaints& complaints);

}  // namespace macadam::fitting
