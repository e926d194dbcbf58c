// SPDX-License-Identifier: GPL-3.0-or-later
// stepper_cuda_double.cu  Compiles the stepper for CUDA devices in double precision. Each precision has its own file,
// so that they compile in parallel.
#include "kernels/make_cuda.hpp"

MACADAM_CUDA_STEPPER(DoublePrecision, macadam::Law);
