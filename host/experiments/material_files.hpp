// SPDX-License-Identifier: GPL-3.0-or-later
/// \file material_files.hpp  Writes a mixture's Prony series and Kelvin chain as tables that other programs read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "macadam/experiments/material.hpp"

namespace macadam {

/// Returns the names of the files that write_material() writes. `confined`: the sides of the specimen are held.
std::vector<std::string> material_files(bool confined);

/// Writes prony.csv and kelvin.csv, and if the sides are free also prony_abaqus.inp and prony_ansys.txt. \throws
/// RunError.
void write_material(const std::filesystem::path& out, const experiments::Material& material, double poisson_ratio);

}  // namespace macadam
