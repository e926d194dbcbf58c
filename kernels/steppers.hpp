// SPDX-License-Identifier: GPL-3.0-or-later
/// \file steppers.hpp  Functions that make the steppers of the backends, and that ask about CUDA devices.
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
/// cuda; `options.devices` then holds their numbers. \throws as select_backend(); RunError if a device is asked for but
/// the program has no kernels for it; InputError for the reference, which only supports Macadam's own laws.
Backend resolved(Backend asked, bool on_device, StepperOptions& options);

/// Fills in the devices and the status of the report, without creating a context on any device. Only in builds with
/// CUDA.
void report_cuda_devices(BackendReport& report);
/// Returns why this device cannot run the kernels; empty if it can. Creates a context on it. Only in builds with CUDA.
std::string cuda_refusal(int device);
/// Returns whether `device` is of the same model as `first`, the two can access each other's memory, and no process,
/// including this one, computes on it. Creates no context. Only in builds with CUDA.
bool cuda_idle_beside(int device, int first);
/// Does the same as macadam::measure_device(). Only in builds with CUDA.
DeviceSpeed measure_device(int device);

}  // namespace macadam::kernels
