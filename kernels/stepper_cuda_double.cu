// SPDX-License-Identifier: GPL-3.0-or-later
// stepper_cuda_double.cu  The step compiled for CUDA devices in one precision: a file each, so that they compile side
// by side.
#include "kernels/make_cuda.hpp"

namespace macadam::kernels {

template std::unique_ptr<Stepper> make_cuda_in<DoublePrecision, Law>(const Specimen&, const ContactNetwork&,
                                                                     const LawTable&, const Inertia&,
                                                                     const StepperOptions&, std::unique_ptr<Stepper>);

}  // namespace macadam::kernels
