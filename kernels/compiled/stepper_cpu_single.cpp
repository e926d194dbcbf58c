// SPDX-License-Identifier: GPL-3.0-or-later
// stepper_cpu_single.cpp  Compiles the stepper for the CPU in single precision. Each precision has its own file, so
// that they compile in parallel.
#include "kernels/make_cpu.hpp"

namespace macadam::kernels {

template std::unique_ptr<Stepper> make_cpu_in<SinglePrecision, Law>(const Specimen&, const ContactNetwork&,
                                                                    const LawTable&, const Inertia&,
                                                                    const StepperOptions&, std::unique_ptr<Stepper>);

}  // namespace macadam::kernels
