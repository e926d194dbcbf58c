// SPDX-License-Identifier: GPL-3.0-or-later
/// \file linear_method.hpp  How the linear systems of the frequency domain are solved.
#pragma once

#include <cstdint>

namespace macadam {

/// `iterative`: by iteration without factors. `direct`: by iteration with Cholesky factors of the real part of the
/// stiffness as preconditioner. `automatic`: the first and, where that does not reach the tolerance, the second, up to
/// `largest_direct` particles (harmonic.hpp).
enum class LinearMethod : std::uint8_t { automatic, iterative, direct };

/// "auto", "iterative", "direct".
const char* to_string(LinearMethod);

}  // namespace macadam
