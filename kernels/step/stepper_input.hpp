// SPDX-License-Identifier: GPL-3.0-or-later
/// \file stepper_input.hpp  Checks the input of a stepper, for every backend.
#pragma once

#include "macadam/stepper.hpp"

namespace macadam::kernels {

/// Checks laws, contacts, boundary and start. \throws InputError naming the pair without a law, or the contact, wall,
/// particle or array that does not fit.
void require_input(std::size_t particles, const ContactNetwork& network, const FactsTable& laws,
                   const StepperOptions& options);

}  // namespace macadam::kernels
