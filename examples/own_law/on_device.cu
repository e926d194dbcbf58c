// SPDX-License-Identifier: GPL-3.0-or-later
// on_device.cu  Compiles the steppers (which advance particles in time) for this program's laws on a GPU.
#include <kernels/make_cuda.hpp>

#include "laws.hpp"

MACADAM_CUDA_STEPPER(DoublePrecision, OwnLaw);
