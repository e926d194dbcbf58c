// SPDX-License-Identifier: GPL-3.0-or-later
// read_cyclic.cpp  Reads `[loading]` of the cyclic test.
#include <fmt/format.h>

#include "host/experiments/experiment.hpp"
#include "host/experiments/read_points.hpp"
#include "host/scene/shift_keys.hpp"

namespace macadam {

using namespace scene;

const char* to_string(Start start) {
  switch (start) {
    case Start::rest:
      return "rest";
    case Start::steady:
      return "steady";
  }
  return "unknown";
}

template <>
experiments::Cyclic ExperimentOf<experiments::Cyclic>::read(const Section& section) {
  // at a strain below 1e-20 the increments of a step are outside the range of single precision; such a strain is also
  // far below the rounding errors of the geometry
  constexpr Rule strain{[](double v) { return v >= 1e-20 && v < 1; }, "a strain from 1e-20 to below 1"};
  constexpr std::int64_t most = 1'000'000;
  constexpr Rule ramp{[](double v) { return v >= 0 && v <= most; }, "0 to 1,000,000 cycles"};
  experiments::Cyclic spec;
  section.read(
      {kind_key(),
       {"frequencies", Need::required, into(spec.frequencies, frequency, positive),
        "frequencies of the load, one test each"},
       {"temperatures", Need::optional, into(spec.temperatures, temperature, celsius),
        "temperatures at which every frequency is tested; they replace temperature in [materials]", "none"},
       {"strain_amplitude", Need::optional, into(spec.strain_amplitude, ratio, strain),
        "amplitude of the strain: displacement of the top wall divided by the height of the specimen"},
       {"start", Need::optional, into<Start>(spec.start, {{"rest", Start::rest}, {"steady", Start::steady}}),
        "start from zero displacement, or in the steady state of the harmonic solution",
        "\"rest\"; \"steady\" if tolerance is given"},
       {"cycles", Need::optional, into(spec.cycles, 1, most), "number of periods of each test",
        "5; 1 from a steady start; 4 or more from rest if tolerance is given"},
       {"ramp_cycles", Need::optional, into(spec.ramp_cycles, ratio, ramp),
        "number of periods over which the load grows smoothly", "0; 1 from rest if tolerance is given"},
       {"fit_cycles", Need::optional, into(spec.fit_cycles, 1, most), "number of last periods that are fitted",
        "2 if there are four cycles or more, else 1"},
       {"samples_per_cycle", Need::optional, into(spec.samples_per_cycle, 8, most),
        "number of samples per period; each sample is a line of response.csv; not used by method \"quasi_static\", "
        "whose samples are the ends of the increments"}});
  require_once(section, "frequencies", spec.frequencies, "Hz", "frequency");
  require_once(section, "temperatures", spec.temperatures, "degrees C", "temperature");
  if (spec.start == Start::steady && spec.ramp_cycles.value_or(0) > 0) {
    section.refuse("ramp_cycles", fmt::format("{} with start = \"steady\"", *spec.ramp_cycles),
                   "0, because a steady start is already in motion");
  }
  if (spec.cycles && spec.fit_cycles.value_or(1) > *spec.cycles) {
    section.refuse("fit_cycles", fmt::format("{}", *spec.fit_cycles),
                   fmt::format("at most the number of cycles, {}", *spec.cycles));
  }
  if (spec.cycles && spec.ramp_cycles) {
    const int fitted = spec.fitted(*spec.cycles);
    if (*spec.ramp_cycles > *spec.cycles - fitted) {
      section.refuse("ramp_cycles", fmt::format("{}", *spec.ramp_cycles),
                     fmt::format("at most {}, because the last {} of {} cycles are fitted", *spec.cycles - fitted,
                                 fitted, *spec.cycles));
    }
  }
  return spec;
}

}  // namespace macadam
