// SPDX-License-Identifier: GPL-3.0-or-later
/// \file load_curve.hpp  Evaluates the curve of load over displacement of a strength test: its largest load, its work,
/// and how the load falls.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "host/experiments/transient/peak_fit.hpp"
#include "macadam/experiments/load_results.hpp"
#include "macadam/specimen.hpp"

namespace macadam {

/// The load between two walls that approach each other, over their approach. The curve begins at zero and is straight
/// between two samples.
class LoadCurve {
 public:
  /// `samples`: in the order of time; stress and strain are negative, as in every compression. `peak`: the largest
  /// stress. `domain`: its section and gauge length give load and displacement.
  LoadCurve(std::span<const StressSample> samples, const experiments::FittedPeak& peak, const Domain& domain);

  const experiments::LoadResults& results() const { return results_; }

  /// Returns the displacement at which the load, after the peak, first falls to this part of its largest value [m].
  /// Empty if the load does not fall so far.
  std::optional<double> displacement_at(double part) const;

  /// Returns the number of samples between two displacements [m], both included.
  int samples_between(double from, double to) const;

  /// Returns the steepest fall of the load after the peak [N/m]: the largest mean slope over a window of the
  /// displacement that has this width [m]. Empty if the curve ends within the first window, if the load never falls, or
  /// if the window or the displacement at the peak is not positive.
  std::optional<double> steepest_fall(double window) const;

 private:
  struct Sample {
    double displacement, load;  // [m], [N]
  };

  std::vector<Sample> samples_;  // the first one is the origin
  experiments::LoadResults results_;
};

}  // namespace macadam
