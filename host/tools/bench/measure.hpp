// SPDX-License-Identifier: GPL-3.0-or-later
/// \file measure.hpp  Measures times of steps, of frequency-domain solutions and of preparations, with repetitions and
/// with counters that explain the times.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "host/tools/bench/cases.hpp"

namespace macadam::bench {

/// Values of the settings for which each specimen is measured. Each combination of the values gives one row.
struct BenchAxes {
  Backend backend = Backend::automatic;
  DeviceList devices;
  std::vector<int> threads{0};  ///< CPU threads; 0: all
  std::vector<ContactForm> forms{ContactForm::condensed};
  std::vector<Precision> precisions{Precision::single, Precision::mixed, Precision::double_};
  std::vector<Geometry> geometries{Geometry::fixed, Geometry::updated};
  std::vector<double> blocks{StepperOptions{}.blocks};  ///< as in StepperOptions
  std::vector<int> units{-1};                           ///< number of Kelvin units; −1: as in the laws
  bool elastic = false;                                 ///< replaces every law by a spring
  std::vector<int> multiprocessors{0};                  ///< as in StepperOptions
  std::vector<int> loads{1, 4};                         ///< numbers of frequencies solved at the same time
  bool steps = true, harmonic = true, preparation = false;
  int repetitions = 7;
  double seconds = 0.05;  ///< shortest duration of a repetition [s]
};

/// The result of one measurement.
struct BenchRow {
  std::string name, label;      ///< label: what ran, in words
  std::vector<double> seconds;  ///< time per step, solution or preparation, one value per repetition [s]
  std::int64_t iterations = 1;  ///< steps per repetition
  int threads = 1;
  std::vector<std::pair<std::string, double>> counters;
  double of(const std::string& counter) const;  ///< value of a counter; 0 if the row has no such counter
};

/// Bandwidths for comparison, measured before the rows.
struct MachineSpeed {
  double copy = 0;                   ///< copy rate of the memory that the backend uses, bytes read plus bytes written
                                     ///< [byte/s]
  std::vector<DeviceSpeed> devices;  ///< one per GPU; backend cuda only
};
/// Measures the bandwidths. `threads`: number of CPU threads; 0 means all.
MachineSpeed measure_machine(Backend backend, const DeviceList& devices, int threads);

double median(std::vector<double> list);

/// Runs all measurements of a specimen and passes each row to `told`.
void time_case(const BenchCase& timed, const BenchAxes& axes, const std::function<void(const BenchRow&)>& told);

}  // namespace macadam::bench
