// SPDX-License-Identifier: GPL-3.0-or-later
/// \file steppers.hpp  Makers of the backends' steppers in the precision that the options ask for.
#pragma once

#include <memory>

#include "macadam/stepper.hpp"

namespace macadam::kernels {

/// Other arguments as make_stepper(); `P` is the precision (precision.hpp), whatever the options say, `Any` the list of
/// laws, std::variant<…>. Without a device in the options, the first one. Defined in make_cpu.hpp and make_cuda.hpp,
/// compiled for Macadam's own laws in stepper_*.
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

/// The backend that makes a stepper: cpu, or, where the program has kernels for devices, maybe cuda; `options.devices`
/// are then their numbers. \throws as select_backend(), RunError for a device that the program has no kernels for,
/// InputError for the reference, which knows Macadam's own laws alone.
Backend resolved(Backend asked, bool on_device, StepperOptions& options);

/// Only in builds with CUDA: fills the report's devices and status, without a context on any of them.
void report_cuda_devices(BackendReport& report);
/// Only in builds with CUDA: why this device cannot run the kernels, as the one that is to; empty where it can.
std::string cuda_refusal(int device);
/// Only in builds with CUDA: whether `device` is like `first`, the two reach each other's memory, and no process, this
/// one neither, computes on it. Makes no context.
bool cuda_idle_beside(int device, int first);
/// Only in builds with CUDA: as macadam::measure_device().
DeviceSpeed measure_device(int device);

}  // namespace macadam::kernels
