// SPDX-License-Identifier: GPL-3.0-or-later
/// \file vtkhdf_file.hpp  Writes field files in VTK's format VTKHDF 2.0, type PolyData.
#pragma once

#include "macadam/fields.hpp"

namespace macadam {

/// Do what begin_fields() and write_fields() do, for the format vtkhdf. `file` is the path with its ending.
/// @{
std::unique_ptr<FieldSeries> begin_vtkhdf(const std::filesystem::path& file, FieldMesh mesh,
                                          std::optional<double> until);
void write_vtkhdf(const std::filesystem::path& file, const FieldMesh& mesh);
/// @}

}  // namespace macadam
