// SPDX-License-Identifier: GPL-3.0-or-later
/// \file case.hpp  One run of bench/accuracy: every setting that it varies, and what came out.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "macadam/macadam.hpp"

namespace macadam::accuracy {

/// Settings of a run. The defaults are the base about which one factor is varied at a time.
struct Case {
  std::string study;             ///< why it was run: the figure or table that it belongs to
  std::string scene = "t8";      ///< "t8", "demo", "full", "seed N": another mixture in a smaller box, "clusters", "few
                                 ///< clusters", "grid NxNxN": spheres of all pair types jittered about a grid
  std::string mix = "AM1";       ///< binder: "AM1" or "AM2"
  std::string stiff;             ///< made stiffer: "aggregate" or "walls"; empty: nothing
  double factor = 1;             ///< by which
  double frequency = 20;         ///< [Hz]
  double density_scaling = 1;    ///< multiplies mass and inertia
  std::int64_t cycle_steps = 0;  ///< decides the density scaling where it is not 0
  double step_share = 0.95;      ///< of critical_step()
  Backend backend = Backend::cpu;
  Precision precision = Precision::mixed;
  ContactForm form = ContactForm::condensed;
  Geometry geometry = Geometry::fixed;
  Damping damping_kind = Damping::none;
  double damping = 0;  ///< χ, or β [1/s]
  Start start = Start::steady;
  double ramp_cycles = 0;
  std::vector<int> cycles{1};  ///< one run as long as the last; a line of the table after each of these
  Quadrature quadrature = Quadrature::lumped;
  std::optional<double> gap_max, area_min;
  double strain = 1e-4;             ///< amplitude over the height
  std::optional<double> tolerance;  ///< run as `[solver] tolerance`, which chooses all that is above
};

/// What came out after so many cycles.
struct Outcome {
  int cycles = 0, fit_cycles = 0;  ///< fitted: the last two of four or more, else one
  Stiffness found;
  Stiffness truth;              ///< harmonic solution of the same network at true mass
  Stiffness own;                ///< harmonic solution with the inertia and viscous damping of the run
  Stiffness model;              ///< truth of the unfiltered network with lumped quadrature
  double seconds = 0;           ///< of stepping
  double seconds_harmonic = 0;  ///< to factor and solve the harmonic solution that a steady start needs
  double seconds_by_hand = 0;   ///< of a run with a tolerance: stepping of the best settings found by hand that keep it
  double dt = 0, step_share = 0;
  std::int64_t steps = 0, bytes = 0, contacts = 0;
  std::string status = "done";  ///< or why there is no number
};

/// The CSV of all runs: one line an outcome, every setting named, flushed line by line.
class Table {
 public:
  /// `about`: lines that begin the file after "# ": machine, date.
  Table(const std::filesystem::path& file, const std::vector<std::string>& about);
  ~Table();
  Table(const Table&) = delete;
  Table& operator=(const Table&) = delete;
  void add(const Case& settings, const Outcome& outcome);

 private:
  std::FILE* file_;
};

}  // namespace macadam::accuracy
