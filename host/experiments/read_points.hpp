// SPDX-License-Identifier: GPL-3.0-or-later
/// \file read_points.hpp  Keys of several tests in `[loading]`: lists of times, frequencies and temperatures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/scene/table.hpp"

namespace macadam::scene {

/// Skips `kind`, which is known when a test reads its section.
inline Key kind_key() {
  return {"kind", Need::required, {[](const Value&) {}, {"one of"}}, "the test; it decides which keys follow"};
}

/// `poisson_ratio` in `[loading]`.
Key poisson_key(double& target);

/// \throws InputError where a key that is there has no entry, or the same one twice.
void require_once(const Section& section, const std::string& key, std::vector<double> entries, const char* unit,
                  const char* what);

/// Times or frequencies: each one, or the two ends of a range beside `points_per_decade` or `points`.
struct Points {
  std::vector<double> given;
  std::optional<int> per_decade, evenly;

  /// The keys of all.
  std::vector<Key> keys(const std::string& key, const Quantity& quantity, Need need = Need::required);
  /// Rising. \throws InputError
  std::vector<double> all(const Section& section, const std::string& key, const char* unit, const char* what) const;
};

}  // namespace macadam::scene
