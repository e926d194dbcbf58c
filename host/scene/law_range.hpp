// SPDX-License-Identifier: GPL-3.0-or-later
/// \file law_range.hpp  Reads the range in which a law holds, and finds the range in which a test uses its laws.
#pragma once

#include <utility>
#include <vector>

#include "host/scene/table.hpp"
#include "macadam/experiments/all.hpp"
#include "macadam/laws/law_range.hpp"

namespace macadam::scene {

/// The keys of a law's range, `valid_frequencies` and `valid_temperatures`. keys() returns the keys, which are read
/// together with other keys of a section and must not outlive this object. After the keys have been read, range()
/// returns the range.
class RangeKeys {
 public:
  std::vector<Key> keys();
  /// \throws InputError for a list that is not two ascending numbers.
  laws::LawRange range(const Section& section) const;

 private:
  std::vector<double> frequencies_, temperatures_;
};

/// Returns the lowest and the highest frequency [Hz] at which a test needs its laws: the frequencies of a cyclic test
/// or a sweep, and 1/(2·pi·t) of the shortest and the longest time of other tests.
std::pair<double, double> frequencies_used(const Experiment& experiment);

}  // namespace macadam::scene
