// SPDX-License-Identifier: GPL-3.0-or-later
/// \file calibration.hpp  Finds parameters of a scene's contact laws for which its specimen has the measured moduli.
///
/// The specimen is prepared once. Every iteration computes its moduli in the frequency domain, and from the same
/// solutions the derivatives with respect to all parameters (sensitivity.hpp). The method is Levenberg–Marquardt for
/// the natural logarithms of the parameters.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "macadam/fit.hpp"
#include "macadam/scene.hpp"
#include "macadam/simulation.hpp"

namespace macadam {

/// A parameter that may change: "M-A.delta", "M-M.E_1", "inner.E", "A-A.alpha"; with the rule "series", which has one
/// law for each phase, "mastic.E_m" or "aggregate.E". The names are those of Sensitivity::parameter.
struct FreeParameter {
  std::string name;
  /// Bounds, in units of the parameter. Without bounds: four decades to either side of the scene's value; if a
  /// parameter ends at such a default bound, the calibration fails.
  std::optional<double> low, high;
  std::optional<double> prior;  ///< value that is known beforehand
  double prior_deviation = 0;   ///< standard deviation of the natural logarithm of `prior`
};

/// The measured quantities that are fitted. `modulus_and_phase`: ln |E*| and φ. `parts`: E' and E''.
enum class Misfit : std::uint8_t { modulus_and_phase, modulus, phase, parts };
const char* to_string(Misfit);
/// Returns the columns that a table must have for a misfit.
Measured measured_for(Misfit);

/// Options of a calibration.
struct CalibrationOptions {
  std::vector<FreeParameter> free;
  /// Number of specimens, with the scene's seed and the seeds after it; E* is the mean over these specimens. Only
  /// generated specimens allow more than one.
  int seeds = 1;
  Misfit misfit = Misfit::modulus_and_phase;
  /// Standard deviations of |E*| (relative) and φ [degrees] for data without standard deviations; see FitOptions.
  double e_star_deviation = 0.03, phase_deviation = 1;
  /// If the targets cannot be reached, returns the nearest values and a warning instead of an error.
  bool nearest = false;
};

/// One parameter and its calibrated value.
struct CalibratedParameter {
  std::string name, unit;
  /// Calibrated value and starting value, as in a scene file: moduli and viscosities without the factor δ.
  double value = 0, start = 0;
  double deviation = 0;      ///< standard deviation, in units of the value; ∞ if the data do not determine the value
  double low = 0, high = 0;  ///< bounds
  bool at_bound = false;
};

/// A measurement, and the result of the calibrated specimen.
struct CalibratedPoint {
  ModulusPoint measured;
  std::optional<double> temperature_c;  ///< temperature of the laws; empty if neither scene nor data have one
  double e_star_pa = 0, phase_deg = 0;  ///< results of the specimen, from the mean of E* over the seeds
  double e_star_scatter = 0;            ///< standard deviation of |E*| between seeds, relative
  double phase_scatter_deg = 0;         ///< standard deviation of φ between seeds
};

/// A product of powers of the parameters that the measurements determine poorly or not at all.
struct Combination {
  std::vector<double> exponents;  ///< exponents of the parameters; the largest is 1
  /// Standard deviation of the logarithm of this product, from the measurements alone; ∞ if they do not determine the
  /// product.
  double deviation = 0;
};

/// Result of a calibration.
struct Calibration {
  CalibrationOptions options;
  std::vector<CalibratedParameter> parameters;
  /// Covariance of the parameters' natural logarithms, row by row; NaN if not determined.
  std::vector<double> covariance;
  std::vector<double> correlation;  ///< row by row; NaN as in covariance
  std::vector<Combination> combinations;
  std::vector<CalibratedPoint> points;
  FitErrors errors;
  double misfit = 0;              ///< sum of squares of the weighted residuals, without the terms of priors
  double degrees_of_freedom = 0;  ///< number of measured values minus number of parameters that are not at a bound
  bool temperatures = false, deviations = false;  ///< whether the data have temperatures, standard deviations
  bool moduli = true, phases = true;              ///< whether moduli, phases were measured; the errors are NaN if not
  std::vector<std::uint64_t> seeds;               ///< empty for a specimen from a file
  std::string solver;                             ///< description of the solver
  /// Number of solved linear systems, over all frequencies and specimens.
  int solutions = 0;
  double seconds_preparing = 0, seconds_solving = 0;
  std::vector<std::string> warnings;
  LawTable laws;  ///< the scene's laws with the calibrated values
};

/// Finds the parameters. \throws InputError for parameters, options or data that do not fit the scene or the specimen;
/// RunError if no values within the bounds reach the targets; InterruptedError. Only `progress` and `stop`
/// of the watcher are used.
Calibration calibrate(const Scene& scene, const ModulusData& data, const CalibrationOptions& options,
                      const Watcher& watcher = {});

/// Calibrates a scene and writes calibration.json, predicted.csv and scene.toml, the scene's text with the calibrated
/// values, into the folder `out`.
///
/// \throws as calibrate(). In addition, InputError if `out` holds a scene.toml that no calibration wrote (it would be
/// replaced), if another command is writing into `out`, or if the scene was not read from a file; RunError if a file
/// cannot be written, or if the written scene.toml does not give the calibrated values when it is read.
Calibration calibrate_into(const std::filesystem::path& out, const Scene& scene, const ModulusData& data,
                           const CalibrationOptions& options, const Watcher& watcher = {});

/// Returns parameters and errors of a calibration as text for people.
std::string calibration_text(const Calibration& calibration);

/// Returns the text of the scene's file with the calibrated values, for a file in `folder`; everything else in the text
/// stays. \throws InputError if the scene was not read from a file.
std::string calibrated_scene(const Scene& scene, const Calibration& calibration, const std::filesystem::path& folder);

/// Checks a calibrated scene. \throws RunError if the scene does not have the calibrated values.
void require_calibrated(const Scene& scene, const Calibration& calibration);

}  // namespace macadam
