// SPDX-License-Identifier: GPL-3.0-or-later
/// \file fit.hpp  Contact laws from measured complex moduli: docs/model.md, section 24.
///
/// A generalised Kelvin chain, 2S2P1D or Huet–Sayegh is fitted to |E*| and φ over frequency, at one temperature or,
/// with a shift law found together with it, at several. The misfit is Σ (ln |E*| − ln |E*|_measured)²/σ_E² + Σ (φ −
/// φ_measured)²/σ_φ². Standard deviations and confidence bands follow from the linearised model at the minimum.
#pragma once

#include <complex>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "macadam/laws/generalised_kelvin.hpp"
#include "macadam/laws/shift.hpp"

namespace macadam {

/// One measurement.
struct ModulusPoint {
  double frequency_hz = 0, e_star_pa = 0, phase_deg = 0;
  double temperature_c = 0;              ///< of use where ModulusData::temperatures
  double e_star_std = 0, phase_std = 0;  ///< standard deviations [Pa], [degrees], where ModulusData::deviations
  int line = 0;                          ///< of the file; 0: of none
};

/// Measurements at any frequencies and temperatures, in any order; a frequency may be measured several times.
struct ModulusData {
  std::string source;  ///< in messages
  std::vector<ModulusPoint> points;
  bool temperatures = false;          ///< each point has one
  bool deviations = false;            ///< each point has those of its measured values
  bool moduli = true, phases = true;  ///< measured values; fit_modulus() needs both
  std::vector<std::string> unused;    ///< columns of the file that were passed over
};

/// The columns that a table must have.
enum class Measured : std::uint8_t { modulus_and_phase, modulus, phase };

/// Reads a table of measured moduli with one header line: columns in any order, separated by commas, semicolons
/// (decimal commas are then allowed) or tabs. docs/laws-from-data.md lists the names, which carry their units:
/// `frequency_hz` or `omega_rad_s`; `e_star_mpa` or `g_star_pa`, for example, or real and imaginary part; `phase_deg`;
/// and if wanted `temperature_c` or `temperature_k`, `e_star_std` and `phase_std`. Other columns are passed over, and
/// so is a row of units that agrees with the names. E* = 2·(1 + ν)·G*, with Poisson's ratio ν in (−1, 0.5]. \throws
/// InputError with all that is wrong in the file (line, column), and for values that seem to be in another unit than
/// the name of their column says.
ModulusData read_modulus_data(const std::filesystem::path& file, std::optional<double> poisson = {},
                              Measured needed = Measured::modulus_and_phase);

/// 2S2P1D (Olard and Di Benedetto): two springs, two parabolic creep elements, one dashpot; Huet–Sayegh where β = ∞.
///   E*(s) = E_00 + (E_0 − E_00)/(1 + δ·(s·τ)^(−k) + (s·τ)^(−h) + (s·β·τ)^(−1)),   0 < k < h < 1
struct AnalogueModel {
  double E_00 = 0;  ///< static modulus [Pa], 0 for a fluid
  double E_0 = 0;   ///< glassy modulus [Pa]
  double k = 0, h = 0, delta = 0;
  double tau = 0;                                         ///< [s]
  double beta = std::numeric_limits<double>::infinity();  ///< dashpot η = (E_0 − E_00)·β·τ; ∞: Huet–Sayegh

  std::complex<double> stiffness(std::complex<double> s) const;  ///< [Pa], for motions as e^(s·t)
  std::complex<double> stiffness(double) const = delete;         // iω, not ω
};

/// A model and its shift law, as `read_analogue` finds them.
struct ShiftedAnalogue {
  AnalogueModel model;
  laws::Shift shift;
};

/// Reads a TOML file with `model` ("2s2p1d" or "huet_sayegh"), the parameters under their names in AnalogueModel and,
/// if wanted, the shift keys of a contact law. \throws InputError naming file, line and key.
ShiftedAnalogue read_analogue(const std::filesystem::path& file);

/// A chain that stands for another model over a range of frequencies.
struct KelvinConversion {
  laws::GeneralisedKelvin law;
  double largest_error = 0;  ///< |E*_chain − E*|/|E*|, the largest at 100 frequencies a decade of the range
};

/// The chain of the fewest units that misses a model by at most `largest_error` of |E*| (as a complex number) from
/// `lowest_hz` to `highest_hz`. A dashpot in series stands in it where the model flows: E_00 = 0 and β finite.
/// \throws InputError for a range or an error that makes no sense, and where GeneralisedKelvin::max_units do not
/// suffice.
KelvinConversion to_kelvin(const AnalogueModel& model, double lowest_hz, double highest_hz, double largest_error);

enum class FitModel : std::uint8_t { kelvin, two_s2p1d, huet_sayegh };
enum class ShiftKind : std::uint8_t { none, wlf, arrhenius, free };  ///< free: a factor for each temperature
enum class Criterion : std::uint8_t { aicc, bic };
const char* to_string(FitModel);
const char* to_string(ShiftKind);
const char* to_string(Criterion);

/// What is fitted and how.
struct FitOptions {
  FitModel model = FitModel::kelvin;
  std::optional<int> units;  ///< Kelvin units; empty: the criterion chooses
  int most_units = 12;       ///< that the criterion may choose
  std::optional<bool> flow;  ///< a dashpot in series with the chain; empty: the criterion chooses
  Criterion criterion = Criterion::aicc;
  ShiftKind shift = ShiftKind::none;
  /// [°C]; empty: the measured one in the middle. One that was measured where the shift is free. It rescales time only.
  std::optional<double> reference_temperature;
  /// Where the data have none: relative standard deviation of |E*| and that of φ [degrees]. Their ratio matters; their
  /// size is then taken from the misfit.
  double e_star_deviation = 0.03, phase_deviation = 1;
};

/// A fitted number.
struct FitParameter {
  std::string name, unit;
  double value = 0;
  double deviation = 0;     ///< standard deviation, unit of the value; ∞ where the data do not determine it
  bool logarithmic = true;  ///< whether its natural logarithm stands in the covariance, in place of itself
};

/// A measurement and what the fit says of it.
struct FittedPoint {
  ModulusPoint measured;
  double log10_a_T = 0;
  double e_star_pa = 0, phase_deg = 0;  ///< fitted
};

/// A chain that was tried.
struct FitCandidate {
  int units = 0;
  bool flow = false;
  int parameters = 0;
  double misfit = 0;        ///< the sum of squares
  double criterion = 0;     ///< the smallest one is taken
  bool determined = false;  ///< no parameter ran to the bounds of sense; others are not taken unless all are so
};

/// Errors of a fit against the measurements.
struct FitErrors {
  double e_star_rms = 0, e_star_largest = 0;        ///< |E*|/|E*|_measured − 1
  double phase_rms_deg = 0, phase_largest_deg = 0;  ///< φ − φ_measured
};

/// Outcome of a fit.
struct Fit {
  FitOptions options;
  std::variant<laws::GeneralisedKelvin, AnalogueModel> model;  ///< at the reference temperature
  laws::Shift shift;
  bool temperatures = false;  ///< whether the data have any
  bool deviations = false;    ///< whether the data have standard deviations
  std::vector<FitParameter> parameters;
  std::vector<double> covariance;  ///< of the parameters (see FitParameter::logarithmic), row by row
  std::vector<FittedPoint> points;
  std::vector<FitCandidate> candidates;  ///< of a chain
  std::size_t chosen = 0;                ///< of the candidates
  FitErrors errors;
  double misfit = 0;              ///< Σ of squares
  double degrees_of_freedom = 0;  ///< 2·points − parameters
  std::vector<std::string> warnings;

  std::complex<double> stiffness(std::complex<double> s) const;  ///< at the reference temperature [Pa]
  std::complex<double> stiffness(double) const = delete;         // iω, not ω
  /// The least and the greatest f·a_T of the data [Hz].
  std::pair<double, double> reduced_range() const;
};

/// Fits a model to measurements. Where the data have no standard deviations, the covariance is scaled with the misfit
/// over the degrees of freedom. \throws InputError for options or data that cannot be fitted; RunError where no start
/// of the least squares has a finite misfit.
Fit fit_modulus(const ModulusData& data, const FitOptions& options = {});

/// The fitted curve at the reference temperature, with pointwise confidence limits.
struct BandPoint {
  double frequency_hz = 0;
  double e_star_pa = 0, e_star_low = 0, e_star_high = 0;
  double phase_deg = 0, phase_low = 0, phase_high = 0;
};

/// Limits of ln |E*| and of φ at a confidence level in (0, 1): normal where the data have standard deviations,
/// Student's t where these come from the misfit. \throws InputError for a level or frequency that makes no sense.
std::vector<BandPoint> confidence_bands(const Fit& fit, const std::vector<double>& frequencies_hz, double level = 0.95);

}  // namespace macadam
