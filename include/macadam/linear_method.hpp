// SPDX-License-Identifier: GPL-3.0-or-later
/// \file linear_method.hpp  Lists the methods that solve the linear systems of the frequency domain.
#pragma once

#include <cstdint>

namespace macadam {

/// `iterative`: the iterative solver. `direct`: an iteration whose preconditioner is the Cholesky factorisation of the
/// real part of the stiffness. `automatic`: the iterative solver and, if that does not reach the tolerance, the direct
/// one, up to `largest_direct` particles (harmonic.hpp).
enum class LinearMethod : std::uint8_t { automatic, iterative, direct };

/// Returns "auto", "iterative" or "direct".
const char* to_string(LinearMethod);

}  // namespace macadam
