// SPDX-License-Identifier: GPL-3.0-or-later
/// \file steppers.hpp  Makers of the backends' steppers; arguments as make_stepper().
#pragma once

#include <memory>

#include "macadam/stepper.hpp"

namespace macadam::kernels {

std::unique_ptr<Stepper> make_cpu_stepper(const Specimen& specimen, const ContactNetwork& network,
                                          const std::array<std::optional<Law>, pair_types>& laws,
                                          const Inertia& inertia, const StepperOptions& options);

/// Only in builds with CUDA.
std::unique_ptr<Stepper> make_cuda_stepper(const Specimen& specimen, const ContactNetwork& network,
                                           const std::array<std::optional<Law>, pair_types>& laws,
                                           const Inertia& inertia, const StepperOptions& options);

/// Only in builds with CUDA: the devices that answer; `status` says in words why there are none.
std::vector<DeviceInfo> cuda_devices(std::string& status);

}  // namespace macadam::kernels
