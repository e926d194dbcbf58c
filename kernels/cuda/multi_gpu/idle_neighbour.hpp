// SPDX-License-Identifier: GPL-3.0-or-later
/// \file idle_neighbour.hpp  Declares the check whether a second device may be used although the user did not ask for
/// it. Only in builds with CUDA.
#pragma once

namespace macadam::kernels {

/// Returns whether `device` is of the same model as `first`, the two can access each other's memory, and no process,
/// including this one, computes on it. Creates no context.
bool cuda_idle_beside(int device, int first);

}  // namespace macadam::kernels
