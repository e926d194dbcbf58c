// SPDX-License-Identifier: GPL-3.0-or-later
/// \file linear_method.hpp  How the linear systems of the frequency domain are solved.
#pragma once

#include <cstdint>

namespace macadam {

/// By iteration without factors; by iteration with Cholesky factors of the real stiffness; or by the first and, where
/// it does not get there, by the second (up to Harmonic's largest_direct particles).
enum class LinearMethod : std::uint8_t { automatic, iterative, direct };

/// "auto", "iterative", "direct".
const char* to_string(LinearMethod);

}  // namespace macadam
