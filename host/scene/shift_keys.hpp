// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shift_keys.hpp  The keys of a shift law beside those of a contact law or a model: `shift` and what it takes.
#pragma once

#include "host/scene/table.hpp"
#include "macadam/laws/shift.hpp"

namespace macadam::scene {

/// A temperature in °C. No test is as warm as the upper limit; one that is given in kelvins mostly is above it.
inline constexpr Rule celsius{[](double v) { return v > -laws::zero_celsius && v < 250; },
                              "a temperature above -273.15 and below 250 degrees C, not in kelvins"};

/// The temperatures at which a shift has a value, for messages.
std::string range_of(const laws::Shift& shift);

/// Keys to be read with others; they store here, so this must outlive Section::read. Then shift() is what they make.
class ShiftKeys {
 public:
  std::vector<Key> keys();
  /// \throws InputError for a key that is missing, or there without the shift that takes it.
  laws::Shift shift(const Section& section) const;

 private:
  std::optional<std::size_t> kind_;
  laws::Wlf wlf_;
  laws::Arrhenius arrhenius_;
  laws::ShiftTable table_;
  double reference_ = 0;
};

}  // namespace macadam::scene
