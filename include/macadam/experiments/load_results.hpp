// SPDX-License-Identifier: GPL-3.0-or-later
/// \file load_results.hpp  Defines the results that the strength tests of discs, half discs and beams have in
/// common.
#pragma once

namespace macadam::experiments {

/// Results of a curve of load over displacement. The displacement is the approach of the two loaded walls.
struct LoadResults {
  double load_n = 0;          ///< largest load
  double displacement_m = 0;  ///< displacement at the largest load
  /// Work of the load until it has fallen to 100 N, or to a tenth of its largest value if this is less, or until the
  /// test ends.
  double work_j = 0;
  double last_part = 0;  ///< load at the end of the work over the largest load
};

}  // namespace macadam::experiments
