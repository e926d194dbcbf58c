// SPDX-License-Identifier: GPL-3.0-or-later
/// \file make_cpu.hpp  Makes a stepper on the CPU for a list of laws.
#pragma once

#include "kernels/cpu/exec_cpu.hpp"
#include "kernels/step/stepper_impl.hpp"
#include "kernels/steppers.hpp"

namespace macadam::kernels {

template <class P, class Any>
std::unique_ptr<Stepper> make_cpu_in(const Specimen& specimen, const ContactNetwork& network,
                                     const std::array<std::optional<Any>, pair_types>& laws, const Inertia& inertia,
                                     const StepperOptions& options, std::unique_ptr<Stepper> used) {
  require_steppable(std::type_identity<Any>{});
  return make_stepper_on<ExecCpu<P, Any>>(specimen, network, laws, inertia, options, used);
}

}  // namespace macadam::kernels
