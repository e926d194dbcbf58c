// SPDX-License-Identifier: GPL-3.0-or-later
/// \file laws.hpp  The list of this program's laws, and who makes steppers for it.
#pragma once

#include <macadam/macadam.hpp>
#include <variant>

#include "bilinear.hpp"
#include "standard_linear_solid.hpp"

/// Any one law; Macadam's own may stand beside yours.
using OwnLaw = std::variant<StandardLinearSolid, Bilinear, macadam::laws::Elastic>;
using OwnLaws = std::array<std::optional<OwnLaw>, macadam::pair_types>;

/// The kernels compiled for OwnLaw in double precision: main.cpp, on_device.cu.
std::unique_ptr<macadam::Stepper> make_own_stepper(const macadam::Specimen& specimen,
                                                   const macadam::ContactNetwork& network, const OwnLaws& laws,
                                                   const macadam::Inertia& inertia,
                                                   const macadam::StepperOptions& options);
