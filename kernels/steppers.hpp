// SPDX-License-Identifier: GPL-3.0-or-later
/// \file steppers.hpp  Declares the functions that make the steppers of the backends (CPU, CUDA).
#pragma once

#include <memory>

#include "macadam/stepper.hpp"

namespace macadam::kernels {

/// Makes a stepper in precision `P` (precision.hpp), whatever the options say. `Any`: the list of laws,
/// std::variant<…>. Other arguments as for make_stepper(). Without a device in the options, uses the first one. Defined
/// in make_cpu.hpp and make_cuda.hpp, and compiled for Macadam's own laws in stepper_*.
/// @{
template <class P, class Any>
std::unique_ptr<Stepper> make_cpu_in(const Specimen& specimen, const ContactNetwork& network,
                                     const std::array<std::optional<Any>, pair_types>& laws, const Inertia& inertia,
                                     const StepperOptions& options, std::unique_ptr<Stepper> used);
template <class P, class Any>  // only in builds with CUDA
std::unique_ptr<Stepper> make_cuda_in(const Specimen& specimen, const ContactNetwork& network,
                                      const std::array<std::optional<Any>, pair_types>& laws, const Inertia& inertia,
                                      const StepperOptions& options, std::unique_ptr<Stepper> used);
/// @}

/// Returns the backend that makes a stepper: cpu or, if the program has kernels for devices (`on_device`), possibly
/// cuda; in the latter case, `options.devices` receives the numbers of the devices. \throws as select_backend();
/// RunError if a device is asked for but the program has no kernels for it; InputError for the reference, which only
/// supports Macadam's own laws.
Backend resolved(Backend asked, bool on_device, StepperOptions& options);

}  // namespace macadam::kernels
