// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shift_keys.hpp  Reads the keys of a shift law, `shift` and its constants, which are among the keys of a
/// contact law or a model.
#pragma once

#include "host/scene/table.hpp"
#include "macadam/laws/shift.hpp"

namespace macadam::scene {

/// Condition on a temperature in °C. No test is as warm as the upper limit, and most temperatures in kelvins are above
/// it. A value above the limit is therefore probably in kelvins.
inline constexpr Rule celsius{[](double v) { return v > -laws::zero_celsius && v < 250; },
                              "a temperature above -273.15 and below 250 degrees C, not in kelvins"};

/// Describes, for messages, the temperatures at which a shift has a value.
std::string range_of(const laws::Shift& shift);

/// The keys of a shift law. keys() returns the keys, which are read together with other keys of a section.
/// Section::read stores their values in this object, which must outlive the call. After that, shift() returns the law.
class ShiftKeys {
 public:
  std::vector<Key> keys();
  /// Returns the shift law. \throws InputError for a key that is missing, or that belongs to another shift than the
  /// given one.
  laws::Shift shift(const Section& section) const;

 private:
  std::optional<std::size_t> kind_;
  laws::Wlf wlf_;
  laws::Arrhenius arrhenius_;
  laws::ShiftTable table_;
  double reference_ = 0;
};

}  // namespace macadam::scene
