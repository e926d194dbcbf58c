// SPDX-License-Identifier: GPL-3.0-or-later
/// \file fields.hpp  Fields of a specimen: for arrays and for files.
#pragma once

#include <filesystem>

#include "macadam/fields.hpp"
#include "python/src/arrays.hpp"
#include "python/src/bindings.hpp"

namespace macadam::python {

/// Mean stress in the cell of each particle, (n, 6).
nb::ndarray<nb::numpy, float> stress_of(const Preparation& made, const ContactState& state);

/// Writes particles, contacts or cells with these arrays beside their own. \throws InputError, RunError.
void write_specimen(const Prepared& p, const std::filesystem::path& file, const std::string& what,
                    const nb::dict& arrays);

}  // namespace macadam::python
