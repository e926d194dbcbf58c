// SPDX-License-Identifier: GPL-3.0-or-later
/// \file fields.hpp  Declares functions that return fields of a specimen as NumPy arrays or write them to files for
/// viewers. A field has one value or vector per particle, contact or polygon of a cell.
#pragma once

#include <filesystem>

#include "macadam/fields.hpp"
#include "python/src/arrays.hpp"
#include "python/src/bindings.hpp"

namespace macadam::python {

/// Returns the mean stress in the cell of each particle [Pa], (n, 6): xx yy zz xy yz xz, tension positive.
nb::ndarray<nb::numpy, float> stress_of(const Preparation& made, const ContactState& state);

/// Writes particles, contacts or cells (`what`) into a file for viewers, with the given arrays in addition to the
/// standard arrays of such files. Writes a .csv file if the name ends in .csv and no arrays are given. \throws
/// InputError for another ending or arrays of wrong shape, RunError if the file cannot be written.
void write_specimen(const Prepared& p, const std::filesystem::path& file, const std::string& what,
                    const nb::dict& arrays);

}  // namespace macadam::python
