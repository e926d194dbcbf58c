// SPDX-License-Identifier: GPL-3.0-or-later
/// \file precision.hpp  Measures the differences of mixed and single precision from double precision at the same
/// settings.
#pragma once

#include "bench/accuracy/runner.hpp"

namespace macadam::accuracy {

/// Returns the runs of the study, each of which is made in every precision. The full specimen is included only on a
/// GPU.
std::vector<Case> precision_cases(Backend backend);

/// Makes the runs. Writes one line for each run in mixed or single precision: the differences of |E*| (relative) and φ
/// from double precision, and the values of rounding_scale() for the run. Lines of other backends in the file are
/// kept. `only` selects the runs whose description contains this text. \throws RunError, InputError.
void measure_precision(Runner& runner, Backend backend, const std::filesystem::path& csv, const std::string& machine,
                       const std::string& only);

}  // namespace macadam::accuracy
