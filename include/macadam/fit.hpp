// SPDX-License-Identifier: GPL-3.0-or-later
/// \file fit.hpp  Fits contact laws to measured complex moduli: docs/model.md, section 24.
///
/// A generalised Kelvin chain, 2S2P1D or Huet–Sayegh is fitted to |E*| and φ over frequency, at one temperature or,
/// together with a shift law, at several. The misfit is Σ (ln |E*| − ln |E*|_measured)²/σ_E² + Σ (φ −
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
#include "macadam/laws/law_range.hpp"
#include "macadam/laws/shift.hpp"

namespace macadam {

/// One measurement.
struct ModulusPoint {
  double frequency_hz = 0, e_star_pa = 0, phase_deg = 0;
  double temperature_c = 0;              ///< valid if ModulusData::temperatures
  double e_star_std = 0, phase_std = 0;  ///< standard deviations [Pa], [degrees]; valid if ModulusData::deviations
  int line = 0;                          ///< line in the file; 0: not from a file
};

/// Measurements at any frequencies and temperatures, in any order; a frequency may be measured several times.
struct ModulusData {
  std::string source;  ///< name used in messages
  std::vector<ModulusPoint> points;
  bool temperatures = false;          ///< whether each point has a temperature
  bool deviations = false;            ///< whether each point has standard deviations
  bool moduli = true, phases = true;  ///< which values were measured; fit_modulus() needs both
  std::vector<std::string> unused;    ///< columns of the file that were ignored
};

/// Which columns a table must have.
enum class Measured : std::uint8_t { modulus_and_phase, modulus, phase };

/// Reads a table of measured moduli with one header line. Columns may be in any order, separated by commas, semicolons
/// (decimal commas are then allowed) or tabs. docs/laws-from-data.md lists the column names, which contain the units,
/// for example `frequency_hz` or `omega_rad_s`; `e_star_mpa` or `g_star_pa`, or real and imaginary part; `phase_deg`;
/// optionally `temperature_c` or `temperature_k`, `e_star_std` and `phase_std`. Other columns are ignored, and so is a
/// row of units that agrees with the names. E* = 2·(1 + ν)·G*, with Poisson's ratio ν in (−1, 0.5].
///
/// \throws InputError listing all faults of the file (line, column), also for values that seem to be in another unit
/// than the column's name says.
ModulusData read_modulus_data(const std::filesystem::path& file, std::optional<double> poisson = {},
                              Measured needed = Measured::modulus_and_phase);

/// 2S2P1D (Olard and Di Benedetto): two springs, two parabolic creep elements, one dashpot. With β = ∞ it is the
/// Huet–Sayegh model.
///   E*(s) = E_00 + (E_0 − E_00)/(1 + δ·(s·τ)^(−k) + (s·τ)^(−h) + (s·β·τ)^(−1)),   0 < k < h < 1
struct AnalogueModel {
  double E_00 = 0;  ///< static modulus [Pa], 0 for a fluid
  double E_0 = 0;   ///< glassy modulus [Pa]
  double k = 0, h = 0, delta = 0;
  double tau = 0;                                         ///< [s]
  double beta = std::numeric_limits<double>::infinity();  ///< dashpot η = (E_0 − E_00)·β·τ; ∞: Huet–Sayegh

  std::complex<double> stiffness(std::complex<double> s) const;  ///< complex modulus [Pa] for motions e^(s·t)
  std::complex<double> stiffness(double) const = delete;         // deleted, so that ω cannot be passed instead of iω
};

/// A model and its shift law, as read_analogue() returns them.
struct ShiftedAnalogue {
  AnalogueModel model;
  laws::Shift shift;
};

/// Reads a TOML file with `model` ("2s2p1d" or "huet_sayegh"), the parameters under their names in AnalogueModel and,
/// optionally, the shift keys of a contact law. \throws InputError naming file, line and key.
ShiftedAnalogue read_analogue(const std::filesystem::path& file);

/// A chain that approximates another model over a range of frequencies.
struct KelvinConversion {
  laws::GeneralisedKelvin law;
  double largest_error = 0;  ///< largest |E*_chain − E*|/|E*| at 100 frequencies per decade of the range
};

/// Returns the Kelvin chain with the fewest units whose relative error |E*_chain − E*|/|E*| is at most `largest_error`
/// from `lowest_hz` to `highest_hz`. It has a dashpot in series if the model flows, that is if E_00 = 0 and β is
/// finite. \throws InputError for an impossible range or error, and if GeneralisedKelvin::max_units do not suffice.
KelvinConversion to_kelvin(const AnalogueModel& model, double lowest_hz, double highest_hz, double largest_error);

/// The model that is fitted.
enum class FitModel : std::uint8_t { kelvin, two_s2p1d, huet_sayegh };
enum class ShiftKind : std::uint8_t { none, wlf, arrhenius, free };  ///< free: one factor for each temperature
/// Information criterion that chooses the number of units of a chain: corrected Akaike, or Bayes.
enum class Criterion : std::uint8_t { aicc, bic };
const char* to_string(FitModel);
const char* to_string(ShiftKind);
const char* to_string(Criterion);

/// Options of a fit.
struct FitOptions {
  FitModel model = FitModel::kelvin;
  std::optional<int> units;  ///< Kelvin units; empty: the criterion chooses
  int most_units = 12;       ///< largest number of units that the criterion may choose
  std::optional<bool> flow;  ///< whether a dashpot is in series with the chain; empty: the criterion chooses
  Criterion criterion = Criterion::aicc;
  ShiftKind shift = ShiftKind::none;
  /// Reference temperature [°C]; if empty, the middle one of the measured temperatures. If the shift is free, it must
  /// be a measured temperature. The choice of this temperature only rescales time.
  std::optional<double> reference_temperature;
  /// Used for data without standard deviations: relative standard deviation of |E*|, and standard deviation of φ
  /// [degrees]. Only their ratio matters: the covariance is scaled by the misfit.
  double e_star_deviation = 0.03, phase_deviation = 1;
};

/// A fitted parameter.
struct FitParameter {
  std::string name, unit;
  double value = 0;
  double deviation = 0;     ///< standard deviation, in units of the value; ∞ if the data do not determine it
  bool logarithmic = true;  ///< whether the covariance is given for the natural logarithm of the parameter
};

/// A measurement, and the values of the fitted model at the same frequency and temperature.
struct FittedPoint {
  ModulusPoint measured;
  double log10_a_T = 0;
  double e_star_pa = 0, phase_deg = 0;  ///< values of the fitted model
};

/// A chain that was fitted and compared.
struct FitCandidate {
  int units = 0;
  bool flow = false;
  int parameters = 0;
  double misfit = 0;        ///< sum of squares
  double criterion = 0;     ///< the chain with the smallest value is chosen
  bool determined = false;  ///< whether no parameter is at a bound; a chain with a parameter at a bound is chosen only
                            ///< if every chain has one
};

/// Errors of a fit against the measurements.
struct FitErrors {
  double e_star_rms = 0, e_star_largest = 0;        ///< |E*|/|E*|_measured − 1
  double phase_rms_deg = 0, phase_largest_deg = 0;  ///< φ − φ_measured
};

/// Result of a fit.
struct Fit {
  FitOptions options;
  std::variant<laws::GeneralisedKelvin, AnalogueModel> model;  ///< at the reference temperature
  laws::Shift shift;
  bool temperatures = false;  ///< whether the data have temperatures
  bool deviations = false;    ///< whether the data have standard deviations
  std::vector<FitParameter> parameters;
  /// Covariance of parameters or their logarithms (FitParameter::logarithmic), by rows.
  std::vector<double> covariance;
  std::vector<FittedPoint> points;
  std::vector<FitCandidate> candidates;  ///< chains only
  std::size_t chosen = 0;                ///< index in `candidates`
  FitErrors errors;
  double misfit = 0;              ///< sum of squares
  double degrees_of_freedom = 0;  ///< 2·points − parameters
  std::vector<std::string> warnings;

  std::complex<double> stiffness(std::complex<double> s) const;  ///< complex modulus at the reference temperature [Pa]
  std::complex<double> stiffness(double) const = delete;         // deleted, so that ω cannot be passed instead of iω
  /// Returns the smallest and the largest f·a_T of the data [Hz].
  std::pair<double, double> reduced_range() const;
  /// Returns the range of the data: reduced frequencies and, if the data have them, temperatures.
  laws::LawRange range() const;
};

/// Fits a model to measurements. If the data have no standard deviations, the covariance is multiplied by the misfit
/// over the degrees of freedom. \throws InputError for options or data that cannot be fitted; RunError if no starting
/// point of the least squares has a finite misfit.
Fit fit_modulus(const ModulusData& data, const FitOptions& options = {});

/// A chain that approximates a curve of moduli.
struct CurveChain {
  laws::GeneralisedKelvin law;
  double largest_difference = 0;  ///< largest |E*_chain/E* − 1| at the points of the curve
};

/// Returns a chain of at most GeneralisedKelvin::max_units units that approximates a computed curve of moduli and
/// phases without temperatures. The chain is first derived from a 2S2P1D model of the curve. If this chain differs from
/// the curve by more than 2 %, a second chain is fitted to the points of the curve, and the better of the two chains is
/// returned. \throws InputError for data that cannot be fitted; RunError if no chain can be derived or fitted.
CurveChain chain_of_curve(const ModulusData& curve);

/// A point of the fitted curve at the reference temperature, with pointwise confidence limits.
struct BandPoint {
  double frequency_hz = 0;
  double e_star_pa = 0, e_star_low = 0, e_star_high = 0;
  double phase_deg = 0, phase_low = 0, phase_high = 0;
};

/// Returns limits of ln |E*| and of φ at a confidence level in (0, 1). Uses the normal distribution if the data have
/// standard deviations, and Student's t distribution if the standard deviations are computed from the misfit. \throws
/// InputError for an impossible level or frequency.
std::vector<BandPoint> confidence_bands(const Fit& fit, const std::vector<double>& frequencies_hz, double level = 0.95);

}  // namespace macadam
