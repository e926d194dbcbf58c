// SPDX-License-Identifier: GPL-3.0-or-later
/// \file material_files.hpp  A mixture's Prony series and Kelvin chain as tables that other programs read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "macadam/experiments/material.hpp"

namespace macadam {

/// The files that write_material() writes. `confined`: the sides are held.
std::vector<std::string> material_files(bool confined);

/// prony.csv and kelvin.csv; where the sides are free prony_abaqus.inp and prony_ansys.txt too. \throws RunError.
void write_material(const std::filesystem::path& out, const experiments::Material& material, double poisson_ratio);

}  // namespace macadam
