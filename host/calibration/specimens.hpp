// SPDX-License-Identifier: GPL-3.0-or-later
/// \file specimens.hpp  The specimens of a calibration, prepared once, and their moduli for any laws.
#pragma once

#include <complex>
#include <memory>
#include <string>
#include <vector>

#include "host/calibration/parameters.hpp"
#include "host/harmonic/reduced_model.hpp"

namespace macadam::calibration {

/// E* of one measurement's frequency and temperature.
struct Predicted {
  std::complex<double> modulus;                      ///< mean over the specimens [Pa]
  std::vector<std::complex<double>> by;              ///< its change per unit of the logarithm of each free parameter
  double e_star_scatter = 0, phase_scatter_deg = 0;  ///< standard deviation between specimens
};

/// The temperature of each measurement, where scene or data have one. \throws InputError where the scene has no laws
/// for what was measured.
std::vector<std::optional<double>> temperatures_of(const Scene& scene, const ModulusData& data);

class Specimens {
 public:
  /// Scene, data and watcher must outlive it. \throws InputError, RunError as prepare() does, and for measurements of
  /// which the scene does not say how they are solved.
  Specimens(const Scene& scene, const ModulusData& data, int seeds, const Watcher& watcher);

  /// E* of every measurement with other laws: solutions of the frequency domain, whose motions are kept for estimates.
  /// \throws RunError where there is no solution; InterruptedError; InputError for a parameter that changes nothing in
  /// the specimen.
  std::vector<Predicted> solve(const LawTable& laws, const std::vector<Parameter>& free);

  /// The same by the motions of the solutions so far: exact, with its derivatives, at the laws of each, and near
  /// between them. Takes milliseconds. \throws RunError, InterruptedError.
  std::vector<Predicted> estimate(const LawTable& laws, const std::vector<Parameter>& free) const;

  const std::vector<std::uint64_t>& seeds() const { return seeds_; }
  const std::string& solver() const { return solver_; }

 private:
  struct Place {
    double frequency, density_scaling;
    std::optional<double> temperature;
  };
  struct Body {
    Specimen specimen;
    ContactNetwork network;
    Inertia inertia;
    std::unique_ptr<harmonic::ReducedModel> seen;  ///< of the motions of all solutions
  };
  struct Answer {
    std::complex<double> modulus;
    std::vector<std::complex<double>> by;
  };
  using Answers = std::vector<Answer>;  ///< by place

  double density_scaling_at(double frequency) const;
  HarmonicLoad load_of(const Place& place) const { return {place.frequency, place.density_scaling, viscous_}; }
  LawTable laws_of(const Place& place, const LawTable& laws) const {
    return place.temperature ? laws_at(scene_, *place.temperature, laws) : laws;
  }
  Answer answer_of(const ModulusParts& parts, const LawTable& laws, const HarmonicLoad& load,
                   const std::vector<Parameter>& free) const;
  Answers solve(Body& body, const LawTable& laws, const std::vector<Parameter>& free) const;
  std::vector<Predicted> mean_of(const std::vector<Answers>& by_body, std::size_t free) const;

  Scene scene_;
  const ModulusData& data_;
  const Watcher& watcher_;
  Backend backend_;
  bool inertia_;
  double viscous_;
  std::string solver_;
  std::vector<Place> places_;
  std::vector<std::size_t> place_of_;                ///< by measurement
  std::vector<std::vector<std::size_t>> isotherms_;  ///< places of one temperature
  std::vector<std::uint64_t> seeds_;
  std::vector<std::unique_ptr<Body>> bodies_;
  int solutions_ = 0;
};

}  // namespace macadam::calibration
