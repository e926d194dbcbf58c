// SPDX-License-Identifier: GPL-3.0-or-later
// on_device.cu  Compiles the steppers for this program's laws on a CUDA device.
#include <kernels/make_cuda.hpp>

#include "laws.hpp"

MACADAM_CUDA_STEPPER(DoublePrecision, OwnLaw);
