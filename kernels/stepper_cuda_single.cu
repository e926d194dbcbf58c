// SPDX-License-Identifier: GPL-3.0-or-later
// stepper_cuda_single.cu  The step compiled for CUDA devices in one precision: a file each, so that they compile side
// by side.
#include "kernels/make_cuda.hpp"

MACADAM_CUDA_STEPPER(SinglePrecision, macadam::Law);
