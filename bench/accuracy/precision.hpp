// SPDX-License-Identifier: GPL-3.0-or-later
/// \file precision.hpp  What mixed and single precision change, against double at the same settings.
#pragma once

#include "bench/accuracy/runner.hpp"

namespace macadam::accuracy {

/// The runs of the study, each to be made in every precision; the full specimen on a device alone.
std::vector<Case> precision_cases(Backend backend);

/// Runs them and writes a line for each scene and each of mixed and single: how far |E*| (relative) and φ are from
/// those of double, and what rounding_scale() says of the run. Lines that the file has of other backends stay. `only`:
/// those whose description holds this text. \throws RunError, InputError.
void measure_precision(Runner& runner, Backend backend, const std::filesystem::path& csv, const std::string& machine,
                       const std::string& only);

}  // namespace macadam::accuracy
