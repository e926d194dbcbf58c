// SPDX-License-Identifier: GPL-3.0-or-later
/// \file stepper_input.hpp  What every stepper asks of its input, whatever the backend.
#pragma once

#include "macadam/stepper.hpp"

namespace macadam::kernels {

/// \throws InputError naming the pair without a law, the wall, the particle or the array that does not fit.
void require_input(std::size_t particles, const ContactNetwork& network, const FactsTable& laws,
                   const StepperOptions& options);

}  // namespace macadam::kernels
