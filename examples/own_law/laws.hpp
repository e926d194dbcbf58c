// SPDX-License-Identifier: GPL-3.0-or-later
/// \file laws.hpp  The list of this program's laws.
#pragma once

#include <macadam/macadam.hpp>
#include <variant>

#include "bilinear.hpp"
#include "standard_linear_solid.hpp"

/// Any one law; Macadam's own may stand beside yours.
using OwnLaw = std::variant<StandardLinearSolid, Bilinear, macadam::laws::Elastic>;
using OwnLaws = std::array<std::optional<OwnLaw>, macadam::pair_types>;

/// Whether this program has the kernels for CUDA devices too: on_device.cu.
#ifdef OWN_LAW_ON_DEVICE
inline constexpr bool on_device = true;
#else
inline constexpr bool on_device = false;
#endif
