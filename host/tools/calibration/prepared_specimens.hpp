// SPDX-License-Identifier: GPL-3.0-or-later
/// \file prepared_specimens.hpp  Prepares the specimens of a calibration once, and computes their moduli for any laws.
#pragma once

#include <complex>
#include <memory>
#include <string>
#include <vector>

#include "host/tools/calibration/parameters.hpp"
#include "host/harmonic/reduced_model.hpp"

namespace macadam::calibration {

/// E* at the frequency and temperature of one measurement.
struct Predicted {
  std::complex<double> modulus;          ///< mean over the specimens [Pa]
  std::vector<std::complex<double>> by;  ///< derivatives by the logarithms of the free parameters [Pa]
  /// Standard deviations between specimens, of ln |E*| and of the phase.
  double e_star_scatter = 0, phase_scatter_deg = 0;
};

/// Returns the temperature at which the laws are evaluated for each measurement, empty if neither scene nor data have
/// one. If all shifts of the scene are WLF or Arrhenius laws, this temperature is the reading itself, otherwise the
/// temperature of the reading's isotherm. \throws InputError if the scene has no valid laws at a measured temperature,
/// or does not say which of its temperatures is meant.
std::vector<std::optional<double>> temperatures_of(const Scene& scene, const ModulusData& data);

/// The specimens, one per seed. Each has a reduced model: its equations of motion, restricted to combinations of the
/// motions of all solutions so far.
class Specimens {
 public:
  /// Prepares the specimens. Scene, data and watcher must outlive this object. \throws InputError, RunError as
  /// prepare(), and InputError if the scene does not determine how a measurement is solved.
  Specimens(const Scene& scene, const ModulusData& data, int seeds, const Watcher& watcher);

  /// Returns E* of every measurement with the given laws, from solutions in the frequency domain. The motions of the
  /// solutions are kept for estimate(). \throws RunError if no solution is found; InterruptedError; InputError for a
  /// parameter that has no effect in the specimen.
  std::vector<Predicted> solve(const LawTable& laws, const std::vector<Parameter>& free);

  /// Returns estimates of E* of every measurement from the motions of all solutions so far. At the laws of a solution
  /// the estimates and their derivatives are exact; elsewhere they are approximate. Takes milliseconds. \throws
  /// RunError, InterruptedError.
  std::vector<Predicted> estimate(const LawTable& laws, const std::vector<Parameter>& free) const;

  const std::vector<std::uint64_t>& seeds() const { return seeds_; }
  const std::string& solver() const { return solver_; }

 private:
  /// A frequency [Hz] and temperature [°C] at which the specimens are solved.
  struct Place {
    double frequency, density_scaling;
    std::optional<double> temperature;
  };
  /// One specimen with its network.
  struct Body {
    Specimen specimen;
    ContactNetwork network;
    Inertia inertia;
    std::unique_ptr<harmonic::ReducedModel> seen;  ///< reduced model with the motions of all solutions
    /// For each frequency and temperature, E* of the last solution over its estimate. It differs from 1 by the error of
    /// the classes of contacts with rock in series.
    std::vector<std::complex<double>> correction;
    double rock = 1;  ///< compliance of the rock in the network, over its compliance in the scene
  };
  /// E* at one frequency and temperature, with its derivatives by the logarithms of the free parameters.
  struct Answer {
    std::complex<double> modulus;
    std::vector<std::complex<double>> by;
  };
  using Answers = std::vector<Answer>;  ///< one per frequency and temperature, as places_

  /// Returns the density scaling of a run at a frequency; 0 without inertia. \throws InputError if the scene has none
  /// for this frequency.
  double density_scaling_at(double frequency) const;
  HarmonicLoad load_of(const Place& place) const { return {place.frequency, place.density_scaling, viscous_}; }
  LawTable laws_of(const Place& place, const LawTable& laws) const {
    return place.temperature ? laws_at(scene_, *place.temperature, laws) : laws;
  }
  /// Returns E* and its derivatives from the parts of E*.
  Answer answer_of(const ModulusParts& parts, const LawTable& laws, const HarmonicLoad& load,
                   const std::vector<Parameter>& free) const;
  /// Solves one specimen at every frequency and temperature in places_, and adds the motions found to the reduced model
  /// of this specimen.
  Answers solve(Body& body, const LawTable& laws, const std::vector<Parameter>& free) const;
  /// Gives the contacts of a specimen the compliance of rock that belongs to the laws.
  void set_rock(Body& body, const LawTable& laws) const;
  /// Makes the estimates for these laws equal to their solutions `solved`.
  void correct(Body& body, const LawTable& laws, const Answers& solved) const;
  /// Returns means and standard deviations over the specimens, for every measurement. `free`: number of free
  /// parameters.
  std::vector<Predicted> mean_of(const std::vector<Answers>& by_body, std::size_t free) const;

  Scene scene_;
  const ModulusData& data_;
  const Watcher& watcher_;
  Backend backend_;
  bool inertia_;
  double viscous_;
  std::string solver_;
  std::vector<Place> places_;
  std::vector<std::size_t> place_of_;                ///< for each measurement the index of its place in places_
  std::vector<std::vector<std::size_t>> isotherms_;  ///< for each temperature the indices of its places
  std::vector<std::uint64_t> seeds_;
  std::vector<std::unique_ptr<Body>> bodies_;
  int solutions_ = 0;
};

}  // namespace macadam::calibration
