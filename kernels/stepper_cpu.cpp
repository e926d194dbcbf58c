// SPDX-License-Identifier: GPL-3.0-or-later
// stepper_cpu.cpp  The step compiled for the CPU.
#include "kernels/steppers.hpp"

#include "kernels/exec_cpu.hpp"
#include "kernels/stepper_impl.hpp"

namespace macadam::kernels {

std::unique_ptr<Stepper> make_cpu_stepper(const Specimen& specimen, const ContactNetwork& network,
                                          const std::array<std::optional<Law>, pair_types>& laws,
                                          const Inertia& inertia, const StepperOptions& options) {
  return make_in_precision<ExecCpu>(options.precision, specimen, network, laws, inertia, options);
}

}  // namespace macadam::kernels
