// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reference_input.hpp  What the reference checks before it computes.
#pragma once

#include <array>
#include <optional>

#include "host/reference/reference_law.hpp"
#include "macadam/contact_network.hpp"
#include "macadam/stepper.hpp"

namespace macadam::reference {

/// One chain for each pair type; empty where the network has no such contact.
using ReferenceLaws = std::array<std::optional<ReferenceLaw>, pair_types>;

/// Reads the laws of the pair types that the network has.
/// \throws InputError naming a pair type without a law, or a law that is not one.
ReferenceLaws read_laws(const ContactNetwork& network, const LawTable& laws);

/// \throws InputError when `found` is not `expected`; `what` is plural ("velocities").
void require_count(const char* what, std::size_t found, std::size_t expected);

/// \throws InputError naming the first contact whose particles, distance or points are not there.
void require_network(const ContactNetwork& network, std::size_t particles);

/// \throws InputError naming the first particle whose mass or moment of inertia is not positive and finite.
void require_inertia(const Inertia& inertia, std::size_t particles);

/// \throws InputError naming the first option that the reference stepper cannot follow.
void require_options(const StepperOptions& options);

}  // namespace macadam::reference
