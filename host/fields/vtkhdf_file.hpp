// SPDX-License-Identifier: GPL-3.0-or-later
/// \file vtkhdf_file.hpp  VTKHDF 2.0 of type PolyData.
#pragma once

#include "macadam/fields.hpp"

namespace macadam {

/// begin_fields() and write_fields() of format vtkhdf; `file` with its ending.
/// @{
std::unique_ptr<FieldSeries> begin_vtkhdf(const std::filesystem::path& file, FieldMesh mesh,
                                          std::optional<double> until);
void write_vtkhdf(const std::filesystem::path& file, const FieldMesh& mesh);
/// @}

}  // namespace macadam
