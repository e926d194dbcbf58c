// SPDX-License-Identifier: GPL-3.0-or-later
/// \file material_files.hpp  A mixture's Prony series and Kelvin chain as tables that other programs read.
#pragma once

#include <filesystem>

#include "macadam/experiments/material.hpp"

namespace macadam {

/// prony.csv and kelvin.csv; where the sides are free prony_abaqus.inp and prony_ansys.txt too. \throws RunError.
void write_material(const std::filesystem::path& out, const experiments::Material& material, double poisson_ratio);

}  // namespace macadam
