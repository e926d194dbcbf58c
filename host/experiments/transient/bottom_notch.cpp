// SPDX-License-Identifier: GPL-3.0-or-later
// bottom_notch.cpp  Looks for the notch of a half disc or a beam.
#include "host/experiments/transient/bottom_notch.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

namespace macadam {
namespace {

/// A notch is in the middle if its distance from the middle is less than this part of the height.
constexpr double middle_of_height = 0.01;

}  // namespace

std::optional<BottomNotch> bottom_notch(const Domain& domain, std::span<const Notch> notches) {
  const double height = domain.gauge_length(2);
  if (notches.empty()) return BottomNotch{0, true, height};
  const Notch& notch = notches.front();
  const double beside = notch.position - 0.5 * domain.size.x, length = notch.high[2];
  const bool is_half_disc = std::holds_alternative<domains::HalfDisc>(domain.shape);
  const double local = is_half_disc ? std::sqrt(std::max(0.0, height * height - beside * beside)) : height;
  const bool is_through = notch.low[1] <= 0 && notch.high[1] >= domain.gauge_length(1);
  const bool is_from_bottom = notch.low[2] <= 0 && length > 0 && length < local;
  if (notches.size() > 1 || notch.axis != 0 || !is_through || !is_from_bottom) return {};
  return BottomNotch{length, std::abs(beside) < middle_of_height * height, local - length};
}

}  // namespace macadam
