// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reference_stepper.hpp  The time step written a second time, for reading: per contact point, Eigen, double.
///
/// It shares no arithmetic with the kernels, so that the two can be compared. It is slow on purpose: one thread, no
/// precomputed coefficients. `StepperOptions::form` does not matter here (it always works per point, which is also why
/// only lumped area moments have a counterpart); `threads` neither.
#pragma once

#include <memory>

#include "macadam/stepper.hpp"

namespace macadam {

/// Makes the reference stepper, at rest and free of force.
/// \throws InputError for a precision other than double, and for whatever in the network, laws, masses or options
/// cannot be stepped; the contact or particle is named.
std::unique_ptr<Stepper> make_reference_stepper(const Specimen& specimen, const ContactNetwork& network,
                                                const LawTable& laws, const Inertia& inertia,
                                                const StepperOptions& options);

}  // namespace macadam
