// SPDX-License-Identifier: GPL-3.0-or-later
/// \file all.hpp  Lists the shapes of domains. To add a shape, write its header and add it to the list here.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "macadam/domains/beam.hpp"
#include "macadam/domains/box.hpp"
#include "macadam/domains/cylinder.hpp"
#include "macadam/domains/disc.hpp"
#include "macadam/domains/half_disc.hpp"
#include "macadam/domains/trapezoid.hpp"

namespace macadam::domains {

/// Any one shape.
using AnyShape = std::variant<Box, Cylinder, Disc, HalfDisc, Beam, Trapezoid>;

namespace detail {
template <class... S>
constexpr bool all_are_shapes(const std::variant<S...>* /*list*/) {
  return (DomainShape<S> && ...);
}
template <class... S>
std::vector<std::string> names_of(const std::variant<S...>* /*list*/) {
  return {S::name...};
}
template <class... S>
std::vector<std::vector<Dimension>> keys_of(const std::variant<S...>* /*list*/) {
  return {std::vector<Dimension>(S::keys.begin(), S::keys.end())...};
}
template <class... S>
std::optional<std::variant<S...>> shape_named(const std::string& name, const std::variant<S...>* /*list*/) {
  std::optional<std::variant<S...>> out;
  ((name == S::name ? static_cast<void>(out = S{}) : static_cast<void>(0)), ...);
  return out;
}
}  // namespace detail
static_assert(detail::all_are_shapes(static_cast<const AnyShape*>(nullptr)), "a shape lacks a part of its contract");

/// Returns the names of all shapes, in the order of the list.
inline std::vector<std::string> shape_names() { return detail::names_of(static_cast<const AnyShape*>(nullptr)); }

/// Returns the keys of the dimensions of all shapes, in the order of the list.
inline std::vector<std::vector<Dimension>> shape_keys() {
  return detail::keys_of(static_cast<const AnyShape*>(nullptr));
}

/// Returns the shape with a name; nothing for an unknown name.
inline std::optional<AnyShape> shape_named(const std::string& name) {
  return detail::shape_named(name, static_cast<const AnyShape*>(nullptr));
}

}  // namespace macadam::domains
