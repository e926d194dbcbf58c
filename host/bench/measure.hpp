// SPDX-License-Identifier: GPL-3.0-or-later
/// \file measure.hpp  Times of steps, of iterations and of preparations, repeated, with what explains them.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "host/bench/cases.hpp"

namespace macadam::bench {

/// What to time of each case: a row for every combination.
struct BenchAxes {
  Backend backend = Backend::automatic;
  DeviceList devices;
  std::vector<int> threads{0};  ///< of the CPU; 0: all
  std::vector<ContactForm> forms{ContactForm::condensed};
  std::vector<Precision> precisions{Precision::single, Precision::mixed, Precision::double_};
  std::vector<Geometry> geometries{Geometry::fixed, Geometry::updated};
  std::vector<double> blocks{StepperOptions{}.blocks};  ///< as in StepperOptions
  std::vector<int> units{-1};                           ///< Kelvin units; −1: those of the laws
  bool elastic = false;                                 ///< every law as a spring
  std::vector<int> multiprocessors{0};                  ///< as in StepperOptions
  std::vector<int> loads{1, 4};                         ///< frequencies that are solved side by side
  bool steps = true, harmonic = true, preparation = false;
  int repetitions = 7;
  double seconds = 0.05;  ///< of a repetition, at the least
};

/// One thing that was timed.
struct BenchRow {
  std::string name, label;      ///< label: what ran, in words
  std::vector<double> seconds;  ///< of each repetition, a step, a solution or a preparation
  std::int64_t iterations = 1;  ///< of these, in a repetition
  int threads = 1;
  std::vector<std::pair<std::string, double>> counters;
  double of(const std::string& counter) const;  ///< 0 for none
};

/// Bandwidths to compare with, measured before the rows.
struct MachineSpeed {
  double copy = 0;                   ///< of the memory that the backend uses, bytes read and written [byte/s]
  std::vector<DeviceSpeed> devices;  ///< backend cuda
};
MachineSpeed measure_machine(Backend backend, const DeviceList& devices, int threads);

double median(std::vector<double> list);

/// Times a case; `told` is called with each row.
void time_case(const BenchCase& timed, const BenchAxes& axes, const std::function<void(const BenchRow&)>& told);

}  // namespace macadam::bench
