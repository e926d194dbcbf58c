// SPDX-License-Identifier: GPL-3.0-or-later
/// \file volumetric_spectrum.hpp  Computes the relaxation of networks with the rule "volumetric".
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "macadam/spectrum.hpp"

namespace macadam {

/// E* of a specimen for one complex modulus of its mastic [Pa].
struct MasticSample {
  std::complex<double> mastic, specimen;
};

/// E* as a function of the modulus k of the mastic: a constant, and a sum of bars of mastic in series with a spring.
/// All numbers are at least 0.
struct BarsOfMastic {
  struct Bar {
    double stiffness;  ///< p of the spring [Pa]; infinite for a bar without a spring
    double weight;     ///< the bar adds weight·k·p/(k + p) to E*
  };
  double constant = 0;  ///< [Pa]
  std::vector<Bar> bars;

  std::complex<double> modulus(std::complex<double> mastic) const;
  /// Returns the relaxation of the specimen for a law of the mastic.
  PronySeries relaxation(const Law& mastic) const;
};

/// Fits bars to samples. The constant is used only if the largest relative error without it is above `enough`.
/// \throws InputError if `samples` is empty.
BarsOfMastic fit_bars(std::span<const MasticSample> samples, double enough);

/// Returns the relaxation of a specimen with the rule "volumetric"; the conditions are those of spectrum_of().
Spectrum volumetric_spectrum(const Specimen& specimen, const ContactNetwork& network, const LawTable& laws,
                             const SpectrumOptions& options);

}  // namespace macadam
