// SPDX-License-Identifier: GPL-3.0-or-later
// stepper_cpu_double.cpp  The step compiled for the CPU in one precision: a file each, so that they compile side by
// side.
#include "kernels/exec_cpu.hpp"
#include "kernels/stepper_impl.hpp"

namespace macadam::kernels {

template std::unique_ptr<Stepper> make_stepper_on<ExecCpu<DoublePrecision>>(
    const Specimen&, const ContactNetwork&, const std::array<std::optional<Law>, pair_types>&, const Inertia&,
    const StepperOptions&, std::unique_ptr<Stepper>);

}  // namespace macadam::kernels
