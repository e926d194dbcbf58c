// SPDX-License-Identifier: GPL-3.0-or-later
// stepper_cuda_single.cu  Compiles the stepper for CUDA devices in single precision. Each precision has its own file,
// so that they compile in parallel.
#include "kernels/make_cuda.hpp"

MACADAM_CUDA_STEPPER(SinglePrecision, macadam::Law);
