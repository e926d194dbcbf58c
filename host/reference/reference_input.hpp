// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reference_input.hpp  Checks the reference stepper's input: laws, network, masses and options.
#pragma once

#include <array>
#include <optional>

#include "host/reference/reference_law.hpp"
#include "macadam/contact_network.hpp"
#include "macadam/stepper.hpp"

namespace macadam::reference {

/// The law of each pair type; empty for pairs that the network does not have.
using ReferenceLaws = std::array<std::optional<ReferenceLaw>, pair_types>;

/// Returns the laws of the pair types that the network has.
/// \throws InputError naming a pair type that has no law, or a law with an invalid parameter.
ReferenceLaws read_laws(const ContactNetwork& network, const LawTable& laws);

/// Checks the number of items. `what` is the plural name of the items ("velocities"). \throws InputError when `found`
/// is not `expected`.
void require_count(const char* what, std::size_t found, std::size_t expected);

/// Checks the contacts of a network. \throws InputError naming the first contact whose particles or points do not exist
/// or whose distance or length is not positive, or whose compliance in series is negative.
void require_network(const ContactNetwork& network, std::size_t particles);

/// Checks the masses. \throws InputError naming the first particle whose mass or moment of inertia is not positive and
/// finite.
void require_inertia(const Inertia& inertia, std::size_t particles);

/// Checks the options. \throws InputError naming the first option that the reference stepper does not support.
void require_options(const StepperOptions& options);

}  // namespace macadam::reference
