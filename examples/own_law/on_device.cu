// SPDX-License-Identifier: GPL-3.0-or-later
// on_device.cu  The steppers of this program's laws on a CUDA device.
#include <kernels/make_cuda.hpp>

#include "laws.hpp"

std::unique_ptr<macadam::Stepper> make_own_stepper(const macadam::Specimen& specimen,
                                                   const macadam::ContactNetwork& network, const OwnLaws& laws,
                                                   const macadam::Inertia& inertia,
                                                   const macadam::StepperOptions& options) {
  return macadam::kernels::make_cuda_in<macadam::kernels::DoublePrecision, OwnLaw>(specimen, network, laws, inertia,
                                                                                   options, nullptr);
}
