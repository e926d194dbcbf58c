// SPDX-License-Identifier: GPL-3.0-or-later
/// \file forecast.hpp  Predicts sizes, steps, memory and time of a run without making its specimen.
#pragma once

#include <string>
#include <vector>

#include "host/specimen/census.hpp"
#include "macadam/scene.hpp"

namespace macadam {

/// Prediction for one frequency or one load history that is stepped.
struct StepForecast {
  double frequency_hz = 0;  ///< 0: the experiment has no frequency
  double dt_s = 0, steps = 0, density_scaling = 1;
  int cycles = 0;  ///< 0: the experiment has no cycles
};

struct Forecast {
  Census census;
  double contacts = 0;
  Backend backend = Backend::cpu;
  std::string reason;  ///< why this backend was chosen
  int threads = 1;
  bool stepped = false;
  Precision precision = Precision::double_;
  ContactForm form = ContactForm::condensed;
  Geometry geometry = Geometry::updated;
  std::vector<StepForecast> steps;  ///< empty: nothing is stepped
  int solutions = 0;                ///< number of solutions in the frequency domain, for the plan or as the result
  double host_bytes = 0, device_bytes = 0;
  /// Wall times [s] of making the specimen, making the network, solving in the frequency domain, and stepping.
  double specimen_s = 0, network_s = 0, harmonic_s = 0, stepping_s = 0;
  double writing_s = 0;  ///< wall time of writing all files [s]
  double seconds() const { return specimen_s + network_s + harmonic_s + stepping_s + writing_s; }
  std::vector<std::string> skips;  ///< parts that the run leaves out because the scene does not need them
  std::vector<std::string> files;  ///< names of the files that the run leaves; `*` stands for the numbers of frames
  std::vector<double> file_bytes;  ///< size of each file on disk
  double field_frames = 0;         ///< number of frames of all series of fields
  double disk_bytes() const {
    double out = 0;
    for (const double bytes : file_bytes) out += bytes;
    return out;
  }
};

/// Predicts a run of the scene. \throws InputError for a specimen, or a combination of method, backend and experiment,
/// that a run would refuse; RunError if the backend is not available.
Forecast forecast(const Scene& scene);

}  // namespace macadam
