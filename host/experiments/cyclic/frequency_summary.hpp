// SPDX-License-Identifier: GPL-3.0-or-later
/// \file frequency_summary.hpp  Converts the result of a frequency to JSON for summary.json and to text for the
/// command's table.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "macadam/scene.hpp"

namespace macadam {

/// Returns the entry for a steady state in `results` of summary.json.
nlohmann::ordered_json frequency_json(const experiments::HarmonicFrequency& f, const Scene& scene);

/// Returns a table: a line of titles, and a line for each steady state.
std::string frequency_table(const std::vector<experiments::HarmonicFrequency>& frequencies);

/// Returns the wall time of all frequencies [s].
template <class F>
double seconds_of(const std::vector<F>& frequencies) {
  double out = 0;
  for (const F& f : frequencies) out += f.seconds;
  return out;
}

}  // namespace macadam
