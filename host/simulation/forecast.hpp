// SPDX-License-Identifier: GPL-3.0-or-later
/// \file forecast.hpp  What a run of a scene will be, without making its specimen: sizes, steps, memory and time.
#pragma once

#include <string>
#include <vector>

#include "host/specimen/census.hpp"
#include "macadam/scene.hpp"

namespace macadam {

/// Of one frequency or load history that is stepped.
struct StepForecast {
  double frequency_hz = 0;  ///< 0: the test has none
  double dt_s = 0, steps = 0, density_scaling = 1;
  int cycles = 0;  ///< 0: the test has none
};

struct Forecast {
  Census census;
  double contacts = 0;
  Backend backend = Backend::cpu;
  std::string reason;  ///< why this one
  int threads = 1;
  bool stepped = false;
  Precision precision = Precision::double_;
  ContactForm form = ContactForm::condensed;
  Geometry geometry = Geometry::updated;
  std::vector<StepForecast> steps;  ///< empty: nothing is stepped
  int solutions = 0;                ///< in the frequency domain, for the plan or as the result
  double host_bytes = 0, device_bytes = 0;
  double specimen_s = 0, network_s = 0, harmonic_s = 0, stepping_s = 0;  ///< of preparing, solving, stepping
  double writing_s = 0;                                                  ///< of all files
  double seconds() const { return specimen_s + network_s + harmonic_s + stepping_s + writing_s; }
  std::vector<std::string> skips;  ///< what the scene does not need
  std::vector<std::string> files;  ///< that the run leaves; `*` stands for the numbers of frames
  std::vector<double> file_bytes;  ///< of each, on disk
  double field_frames = 0;         ///< of all series of fields
  double disk_bytes() const {
    double out = 0;
    for (const double bytes : file_bytes) out += bytes;
    return out;
  }
};

/// \throws InputError for a specimen, or a combination of method, backend and test, that a run would refuse; RunError
/// for a backend that is not there.
Forecast forecast(const Scene& scene);

}  // namespace macadam
