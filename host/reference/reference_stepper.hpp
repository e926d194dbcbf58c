// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reference_stepper.hpp  Defines the reference implementation of the time step, written to be read: per contact
/// point, with Eigen, in double precision.
///
/// It shares no arithmetic with the kernels, so that the results of kernels can be checked against it. It is written
/// for clarity, not for speed: it uses one thread and no precomputed coefficients. `StepperOptions::form` and `threads`
/// have no effect. The reference stepper always works per contact point, so its results can be compared only with runs
/// whose area moments are lumped in points.
#pragma once

#include <memory>

#include "macadam/stepper.hpp"

namespace macadam {

/// Returns a reference stepper, at rest and free of force.
/// \throws InputError for a precision other than double, and for network, laws, masses or options that cannot be
/// stepped; the message names the contact or particle.
std::unique_ptr<Stepper> make_reference_stepper(const Specimen& specimen, const ContactNetwork& network,
                                                const LawTable& laws, const Inertia& inertia,
                                                const StepperOptions& options);

}  // namespace macadam
