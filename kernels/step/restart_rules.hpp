// SPDX-License-Identifier: GPL-3.0-or-later
/// \file restart_rules.hpp  Decides whether a stepper can be started again with other options and laws.
#pragma once

#include <algorithm>
#include <string_view>
#include <tuple>

#include "macadam/stepper.hpp"

namespace macadam::kernels {

/// Returns whether two tables of laws have states of the same kinds and sizes, and act on the same components with the
/// same factor α of the shear stiffness.
inline bool keep_alike(const FactsTable& a, const FactsTable& b) {
  const auto kind = [](const LawFacts& f) {
    return std::tuple(std::string_view(f.name), f.alpha, f.units, f.only_units, f.memoryless, f.linear, f.blocks,
                      f.coupled);
  };
  return std::ranges::equal(a, b, [&](const auto& x, const auto& y) {
    return x && y ? kind(*x) == kind(*y) : x.has_value() == y.has_value();
  });
}

/// Returns whether the options on which the arrays of contacts depend are the same.
inline bool keep_alike(const StepperOptions& a, const StepperOptions& b) {
  const auto kept = [](const StepperOptions& o) {
    return std::tie(o.form, o.geometry, o.skip_shear, o.skip_rotations, o.threads, o.devices, o.multiprocessors,
                    o.ranks);
  };
  return kept(a) == kept(b);
}

}  // namespace macadam::kernels
