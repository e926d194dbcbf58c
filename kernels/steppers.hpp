// SPDX-License-Identifier: GPL-3.0-or-later
/// \file steppers.hpp  Makers of the backends' steppers, and the choice of precision.
#pragma once

#include <memory>
#include <utility>

#include "kernels/precision.hpp"
#include "macadam/stepper.hpp"

namespace macadam::kernels {

template <class P>
class ExecCpu;
template <class P>
class ExecCuda;  // only in builds with CUDA

/// The stepper of one executor; arguments as make_stepper(). Defined in stepper_impl.hpp, compiled in stepper_*.
template <class Exec>
std::unique_ptr<Stepper> make_stepper_on(const Specimen& specimen, const ContactNetwork& network,
                                         const std::array<std::optional<Law>, pair_types>& laws, const Inertia& inertia,
                                         const StepperOptions& options, std::unique_ptr<Stepper> used);

/// The stepper of a family of executors in the precision that the options ask for.
template <template <class> class Exec>
std::unique_ptr<Stepper> make_in_precision(const Specimen& specimen, const ContactNetwork& network,
                                           const std::array<std::optional<Law>, pair_types>& laws,
                                           const Inertia& inertia, const StepperOptions& options,
                                           std::unique_ptr<Stepper> used) {
  switch (options.precision) {
    case Precision::single:
      return make_stepper_on<Exec<SinglePrecision>>(specimen, network, laws, inertia, options, std::move(used));
    case Precision::mixed:
      return make_stepper_on<Exec<MixedPrecision>>(specimen, network, laws, inertia, options, std::move(used));
    default:
      return make_stepper_on<Exec<DoublePrecision>>(specimen, network, laws, inertia, options, std::move(used));
  }
}

/// Only in builds with CUDA: fills the report's devices and status, without a context on any of them.
void report_cuda_devices(BackendReport& report);
/// Only in builds with CUDA: why this device cannot run the kernels, as the one that is to; empty where it can.
std::string cuda_refusal(int device);

}  // namespace macadam::kernels
