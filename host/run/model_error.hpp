// SPDX-License-Identifier: GPL-3.0-or-later
/// \file model_error.hpp  Gives the error of the model: how far contact networks with rule "series" were from the
/// continuum in docs/model-error.md. This error adds to the numerical error and does not depend on the settings of a
/// run.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "macadam/simulation.hpp"

namespace macadam {

/// Largest difference between the networks of a study and the continuum, over all sphere packings that the study used
/// for one structure.
struct ModelError {
  double e_star = 0;       ///< of |E*|, relative
  double uncertainty = 0;  ///< of the continuum's |E*| itself, relative
  double phase_deg = 0;
};

/// A row of the study. The values are those of bench/results/model-error.csv, rounded up; model_error_test compares
/// them.
struct StudiedModel {
  bool voids;
  double rock;   ///< largest volume fraction of rock to which the row applies
  double ratio;  ///< modulus of the rock over |E*| of the mastic
  ModelError error;
};
inline constexpr std::array<StudiedModel, 16> studied_models{{{false, 0.20, 5, {0.012, 0.006, 0.4}},
                                                              {false, 0.20, 20, {0.022, 0.012, 0.5}},
                                                              {false, 0.20, 50, {0.028, 0.008, 0.4}},
                                                              {false, 0.20, 200, {0.032, 0.012, 0.2}},
                                                              {false, 0.40, 5, {0.020, 0.012, 1.1}},
                                                              {false, 0.40, 20, {0.056, 0.032, 1.2}},
                                                              {false, 0.40, 50, {0.074, 0.054, 2.0}},
                                                              {false, 0.40, 200, {0.148, 0.106, 0.8}},
                                                              {false, 0.55, 5, {0.007, 0.025, 0.7}},
                                                              {false, 0.55, 20, {0.042, 0.086, 3.1}},
                                                              {false, 0.55, 50, {0.196, 0.180, 5.8}},
                                                              {false, 0.55, 200, {0.616, 0.379, 6.3}},
                                                              {true, 0.40, 5, {0.069, 0.006, 0.5}},
                                                              {true, 0.40, 20, {0.056, 0.027, 1.2}},
                                                              {true, 0.40, 50, {0.016, 0.048, 2.1}},
                                                              {true, 0.40, 200, {0.184, 0.108, 0.8}}}};

/// Returns the largest error of the rows that surround a specimen: the rows of the next larger fraction of rock, and of
/// the ratios on both sides. Returns nothing outside of the studied range.
std::optional<ModelError> model_error(bool voids, double rock, double ratio);

/// The error of the model of one run.
struct ModelErrorOfRun {
  double rock = 0;                             ///< fraction of rock in the box
  double lowest_ratio = 0, highest_ratio = 0;  ///< of the moduli, over the frequencies and temperatures of the test
  bool voids = false;
  std::optional<ModelError> error = {};  ///< empty: outside of the studied range
};

/// Returns the error of the model of a run; nothing for a rule that is not "series", or a specimen without rock.
std::optional<ModelErrorOfRun> model_error_of(const Scene& scene, const Preparation& prepared);

/// Returns a sentence about the error of the model.
std::string words_of(const ModelErrorOfRun& error);

}  // namespace macadam
