// SPDX-License-Identifier: GPL-3.0-or-later
/// \file all.hpp  Lists the shapes of domains. To add a shape, write its header and add it to the list here.
#pragma once

#include <variant>

#include "macadam/domains/box.hpp"
#include "macadam/domains/cylinder.hpp"

namespace macadam::domains {

/// Any one shape.
using AnyShape = std::variant<Box, Cylinder>;

namespace detail {
template <class... S>
constexpr bool all_are_shapes(const std::variant<S...>* /*list*/) {
  return (DomainShape<S> && ...);
}
}  // namespace detail
static_assert(detail::all_are_shapes(static_cast<const AnyShape*>(nullptr)), "a shape lacks a part of its contract");

}  // namespace macadam::domains
