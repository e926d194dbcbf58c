// SPDX-License-Identifier: GPL-3.0-or-later
/// \file table.hpp  Defines a drive by values at given times, for example measured ones, connected by straight lines.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "macadam/drives/drive.hpp"
#include "macadam/drives/spec.hpp"
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

/// Description of a strain by its values at given times. The strain is 0 at time 0, so the first row may be left out.
struct TableSpec {
  static constexpr const char* name = "table";
  std::vector<double> times;    ///< [s]
  std::vector<double> strains;  ///< one for each time

  template <class F>
  void each_key(F&& f) {
    f("times", times, ValueKind::pause, ValueNeed::optional, "times of the strains, ascending");
    f("strains", strains, ValueKind::strain, ValueNeed::optional, "strains at the times, connected by straight lines");
  }
  std::optional<SpecFault> fault(double) const {
    const std::string rows = std::to_string(times.size()) + " times and " + std::to_string(strains.size()) + " strains";
    if (times.size() != strains.size() || times.empty()) return SpecFault{"strains", rows, "one strain for each time"};
    if (static_cast<double>(times.size()) > most_pieces) return SpecFault{"times", rows, "at most 1000000 rows"};
    const auto row = [&](std::size_t i) {
      return "time " + shown(times[i]) + " s and strain " + shown(strains[i]) + " in row " + std::to_string(i + 1);
    };
    for (std::size_t i = 0; i < times.size(); ++i) {
      if (i > 0 && !(times[i] > times[i - 1])) return SpecFault{"times", row(i), "times that ascend"};
    }
    if (times.front() == 0 && strains.front() != 0)
      return SpecFault{"strains", row(0), "a strain of 0 at time 0, when the test begins"};
    if (times.size() == 1 && times.front() == 0) return SpecFault{"times", rows, "a time after 0"};
    return {};
  }
  StrainRange range(double) const {
    const auto [low, high] = std::minmax_element(strains.begin(), strains.end());
    return {std::min(0.0, *low), std::max(0.0, *high)};
  }
  double shortest_time(double) const {
    double out = std::numeric_limits<double>::infinity(), before = 0;
    for (const double t : times) {
      if (t > before) out = std::min(out, t - before);
      before = t;
    }
    return out;
  }
  double step(double largest, double duration) const { return dividing_step({duration}, largest); }
  std::shared_ptr<const Drive> drive(double unit, double dt, double) const {
    std::vector<double> at, values;
    if (times.front() > 0) at.push_back(0), values.push_back(0);
    at.insert(at.end(), times.begin(), times.end());
    for (const double strain : strains) values.push_back(unit * strain);
    return std::make_shared<Table>(dt, std::move(at), std::move(values));
  }
  std::vector<RatePiece> pieces(double duration) const {
    std::vector<RatePiece> out;
    double begin = 0, strain = 0;
    for (std::size_t i = 0; i < times.size(); ++i) {
      if (times[i] == 0) continue;
      if (!append_piece(out, times[i], duration, {{(strains[i] - strain) / (times[i] - begin), 0}})) return out;
      begin = times[i], strain = strains[i];
    }
    append_piece(out, duration, duration, {});
    return out;
  }

 private:
  static std::string shown(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
  }
};

}  // namespace macadam::drives
