// SPDX-License-Identifier: GPL-3.0-or-later
/// \file unit_question.hpp  Measurements that seem to be in another unit than their columns say.
#pragma once

#include <string>

#include "host/fit/laboratory_table.hpp"
#include "macadam/fit.hpp"

namespace macadam::fitting {

/// Adds a question to the complaints where moduli or temperatures cannot be in the unit that the names of their columns
/// say. A column whose name has the unit in which the numbers are meant answers it.
void ask_about_units(const ModulusData& data, const std::string& modulus_column, const std::string& temperature_column,
                     Complaints& complaints);

}  // namespace macadam::fitting
