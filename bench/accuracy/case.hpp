// SPDX-License-Identifier: GPL-3.0-or-later
/// \file case.hpp  Defines one run of bench/accuracy: all settings that the study varies, and the result.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "macadam/macadam.hpp"

namespace macadam::accuracy {

/// Settings of a run. The defaults are the base case, from which one setting is varied at a time.
struct Case {
  std::string study;             ///< study to which the run belongs; also the name of its figure or table
  std::string scene = "t8";      ///< specimen: "t8", "demo", "full", "seed N" (another mixture in a smaller box),
                                 ///< "clusters", "few clusters", "grid NxNxN" (spheres of all pair types at jittered
                                 ///< grid points)
  std::string mix = "AM1";       ///< binder: "AM1" or "AM2"
  std::string stiff;             ///< stiffened part: "aggregate" or "walls"; empty: none
  double factor = 1;             ///< factor by which the stiffness of this part is multiplied
  double frequency = 20;         ///< [Hz]
  double density_scaling = 1;    ///< multiplies mass and inertia
  std::int64_t cycle_steps = 0;  ///< steps per cycle; if not 0, it determines the density scaling
  double step_share = 0.95;      ///< time step divided by critical_step()
  Backend backend = Backend::cpu;
  Precision precision = Precision::mixed;
  ContactForm form = ContactForm::condensed;
  Geometry geometry = Geometry::fixed;
  Damping damping_kind = Damping::none;
  double damping = 0;  ///< χ of local damping, or β of viscous damping [1/s]
  Start start = Start::steady;
  double ramp_cycles = 0;
  std::vector<int> cycles{1};  ///< numbers of cycles after which the result is evaluated. There is one run, up to the
                               ///< last of them; each number gives one line of the table.
  Quadrature quadrature = Quadrature::lumped;
  std::optional<double> gap_max, area_min;
  double strain = 1e-4;             ///< amplitude of the strain
  std::optional<double> tolerance;  ///< `[solver] tolerance` of the run, which then chooses the settings above
};

/// The result after a number of cycles.
struct Outcome {
  int cycles = 0, fit_cycles = 0;  ///< fit_cycles: number of the last cycles that are fitted; two if there are four or
                                   ///< more, otherwise one
  Stiffness found;
  Stiffness truth;              ///< frequency-domain solution of the same network with true mass
  Stiffness own;                ///< frequency-domain solution with the inertia and viscous damping of the run
  Stiffness model;              ///< frequency-domain solution with true mass of the unfiltered network with lumped
                                ///< quadrature
  double seconds = 0;           ///< time of the stepping
  double seconds_harmonic = 0;  ///< time of the frequency-domain solution that a steady start needs, with its
                                ///< factorisation
  double seconds_by_hand = 0;   ///< for a run with a tolerance: stepping time of the fastest settings that
                                ///< meet the tolerance
  double dt = 0, step_share = 0;
  std::int64_t steps = 0, bytes = 0, contacts = 0;
  std::string status = "done";  ///< "done", or the reason why the run failed
};

/// Writes the CSV of all runs: one line per outcome, with every setting in a column of its own. Each line is flushed.
class Table {
 public:
  /// `about` are lines such as machine and date; each is written at the top of the file after "# ".
  Table(const std::filesystem::path& file, const std::vector<std::string>& about);
  ~Table();
  Table(const Table&) = delete;
  Table& operator=(const Table&) = delete;
  void add(const Case& settings, const Outcome& outcome);

 private:
  std::FILE* file_;
};

}  // namespace macadam::accuracy
