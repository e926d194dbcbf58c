// SPDX-License-Identifier: GPL-3.0-or-later
/// \file all.hpp  Includes all drives that come with Macadam, and lists their descriptions, which a scene may name.
#pragma once

#include <variant>

#include "macadam/drives/constant_rate.hpp"
#include "macadam/drives/cyclic.hpp"
#include "macadam/drives/haversine.hpp"
#include "macadam/drives/ramp.hpp"
#include "macadam/drives/spec.hpp"
#include "macadam/drives/table.hpp"

namespace macadam::drives {

/// Any one description of a strain over time. To add a drive that scenes may name, add its description here.
using AnySpec = std::variant<HaversineSpec, TableSpec, RampSpec, ConstantRateSpec, CyclicSpec>;

namespace detail {
template <class... S>
constexpr bool all_are_specs(const std::variant<S...>* /*list*/) {
  return (DriveSpec<S> && ...);
}
}  // namespace detail
static_assert(detail::all_are_specs(static_cast<const AnySpec*>(nullptr)),
              "a description lacks a part of its contract");

}  // namespace macadam::drives
