// SPDX-License-Identifier: GPL-3.0-or-later
/// \file laws.hpp  The list of the contact laws of this program.
#pragma once

#include <macadam/macadam.hpp>
#include <variant>

#include "bilinear.hpp"
#include "standard_linear_solid.hpp"

/// Any one of the contact laws of this program. The list may also contain laws of Macadam, such as Elastic here.
using OwnLaw = std::variant<StandardLinearSolid, Bilinear, macadam::laws::Elastic>;
using OwnLaws = std::array<std::optional<OwnLaw>, macadam::pair_types>;

/// Whether this program also has kernels for GPUs, which on_device.cu compiles.
#ifdef OWN_LAW_ON_DEVICE
inline constexpr bool on_device = true;
#else
inline constexpr bool on_device = false;
#endif
