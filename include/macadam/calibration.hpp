// SPDX-License-Identifier: GPL-3.0-or-later
/// \file calibration.hpp  Parameters of a scene's contact laws such that its specimen has the measured moduli.
///
/// The specimen is prepared once; every trial is a solution of the frequency domain, whose derivatives by all
/// parameters come with it (sensitivity.hpp). Levenberg-Marquardt over the natural logarithms of the parameters.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "macadam/fit.hpp"
#include "macadam/scene.hpp"
#include "macadam/simulation.hpp"

namespace macadam {

/// What may change, "M-A.delta", "M-M.E_1", "inner.E", "A-A.alpha"; the names are those of Sensitivity::parameter.
struct FreeParameter {
  std::string name;
  /// Bounds, in units of the parameter; none: four decades to either side of the scene's value, and a value that ends
  /// there is an error.
  std::optional<double> low, high;
  std::optional<double> prior;  ///< what is known of it beforehand
  double prior_deviation = 0;   ///< standard deviation of its natural logarithm
};

/// What of a measurement counts. `modulus_and_phase`: ln |E*| and φ. `parts`: E' and E''.
enum class Misfit : std::uint8_t { modulus_and_phase, modulus, phase, parts };
const char* to_string(Misfit);
/// The columns that a table must have for a misfit.
Measured measured_for(Misfit);

struct CalibrationOptions {
  std::vector<FreeParameter> free;
  /// Specimens of the scene's seed and those after it; E* is their mean. More than one for generated specimens only.
  int seeds = 1;
  Misfit misfit = Misfit::modulus_and_phase;
  /// As FitOptions has them, where the data have none.
  double e_star_deviation = 0.03, phase_deviation = 1;
  /// Gives the nearest values there are, with a warning, where the targets cannot be reached.
  bool nearest = false;
};

struct CalibratedParameter {
  std::string name, unit;
  double value = 0, start = 0;  ///< as a scene file has them: δ is not in moduli and viscosities
  double deviation = 0;         ///< standard deviation, unit of the value; ∞ where nothing determines it
  double low = 0, high = 0;     ///< bounds
  bool at_bound = false;
};

/// A measurement and what the calibrated specimen has.
struct CalibratedPoint {
  ModulusPoint measured;
  std::optional<double> temperature_c;  ///< of the laws, where the scene or the data have one
  double e_star_pa = 0, phase_deg = 0;  ///< of the specimen; mean of E* over the seeds
  double e_star_scatter = 0;            ///< standard deviation between seeds of |E*|, relative
  double phase_scatter_deg = 0;         ///< and of φ
};

/// A product of powers of the parameters that the measurements determine poorly or not at all.
struct Combination {
  std::vector<double> exponents;  ///< of the parameters, the largest 1
  double deviation = 0;           ///< of its logarithm by the measurements alone; ∞ where they say nothing of it
};

struct Calibration {
  CalibrationOptions options;
  std::vector<CalibratedParameter> parameters;
  std::vector<double> covariance;   ///< of the natural logarithms, row by row; NaN where something is not determined
  std::vector<double> correlation;  ///< row by row, likewise
  std::vector<Combination> combinations;
  std::vector<CalibratedPoint> points;
  FitErrors errors;
  double misfit = 0;                              ///< Σ of squares, without priors
  double degrees_of_freedom = 0;                  ///< numbers measured less parameters that do not lie at a bound
  bool temperatures = false, deviations = false;  ///< whether the data have them
  bool moduli = true, phases = true;              ///< whether they were measured; the errors of others are NaN
  std::vector<std::uint64_t> seeds;               ///< empty for a specimen from a file
  std::string solver;                             ///< what was solved, in words
  int solutions = 0;                              ///< solutions of all frequencies of all specimens
  double seconds_preparing = 0, seconds_solving = 0;
  std::vector<std::string> warnings;
  LawTable laws;  ///< of the scene, calibrated
};

/// Finds the parameters. \throws InputError for parameters, options or data that do not fit scene or specimen; RunError
/// for targets that no values within the bounds reach; InterruptedError. Of the watcher, `progress` and `stop` are
/// used.
Calibration calibrate(const Scene& scene, const ModulusData& data, const CalibrationOptions& options,
                      const Watcher& watcher = {});

/// The scene's file with the calibrated values, for a folder; all else of the text stays. \throws InputError for a
/// scene that was not read from a file.
std::string calibrated_scene(const Scene& scene, const Calibration& calibration, const std::filesystem::path& folder);

/// \throws RunError where a scene does not have the calibrated values.
void require_calibrated(const Scene& scene, const Calibration& calibration);

}  // namespace macadam
