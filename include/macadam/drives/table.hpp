// SPDX-License-Identifier: GPL-3.0-or-later
/// \file table.hpp  Defines a drive by values at given times, for example measured ones, connected by straight lines.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "macadam/drives/drive.hpp"
#include "macadam/error.hpp"

namespace macadam::drives {

/// Values between the given times are interpolated linearly. Before the first time the drive has the first value, and
/// after the last time it has the last value.
class Table final : public Drive {
 public:
  /// `times` [s]: at least two, ascending. `values` [m] or [N]: one for each time. \throws InputError naming the row.
  Table(double step, std::vector<double> times, std::vector<double> values)
      : step_(step), times_(std::move(times)), values_(std::move(values)) {
    if (times_.size() != values_.size() || times_.size() < 2) {
      throw InputError("table of a drive: found " + std::to_string(times_.size()) + " times and " +
                       std::to_string(values_.size()) + " values, expected the same number of each, at least two");
    }
    for (std::size_t i = 0; i < times_.size(); ++i) {
      if (!std::isfinite(times_[i]) || !std::isfinite(values_[i]) || (i > 0 && !(times_[i] > times_[i - 1]))) {
        throw InputError("table of a drive, row " + std::to_string(i + 1) + ": found time " +
                         std::to_string(times_[i]) + " s and value " + std::to_string(values_[i]) +
                         ", expected numbers, and times that ascend");
      }
    }
    for (std::size_t i = 1; i < times_.size(); ++i) {
      const double span = times_[i] - times_[i - 1];
      shortest_ = std::min(shortest_, span);
      fastest_ = std::max(fastest_, std::abs(values_[i] - values_[i - 1]) / span);
    }
  }

  double dt() const override { return step_; }
  double shortest_time() const override { return shortest_; }
  double fastest() const override { return fastest_; }
  double value(std::int64_t k) const override {
    const double t = static_cast<double>(k) * step_;
    if (t <= times_.front()) return values_.front();
    if (t >= times_.back()) return values_.back();
    const auto i = static_cast<std::size_t>(std::upper_bound(times_.begin(), times_.end(), t) - times_.begin());
    const double share = (t - times_[i - 1]) / (times_[i] - times_[i - 1]);
    return values_[i - 1] + share * (values_[i] - values_[i - 1]);
  }

 private:
  double step_, shortest_ = std::numeric_limits<double>::infinity(), fastest_ = 0;
  std::vector<double> times_, values_;
};

}  // namespace macadam::drives
