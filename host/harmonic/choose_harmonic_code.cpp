// SPDX-License-Identifier: GPL-3.0-or-later
// choose_harmonic_code.cpp  Returns the frequency domain's functions (a table of function pointers) for the processor
// generation that is also used for time steps.
#include "host/backends/processor_code.hpp"
#include "host/harmonic/harmonic_code.hpp"

namespace macadam::harmonic {

extern "C" {
extern const HarmonicCode macadam_harmonic_code_base;
#ifdef MACADAM_ALL_PROCESSORS
extern const HarmonicCode macadam_harmonic_code_v3, macadam_harmonic_code_v4;
#endif
}

const HarmonicCode& harmonic_code() {
  switch (processor_generation()) {
#ifdef MACADAM_ALL_PROCESSORS
    case ProcessorGeneration::v4:
      return macadam_harmonic_code_v4;
    case ProcessorGeneration::v3:
      return macadam_harmonic_code_v3;
#endif
    default:
      return macadam_harmonic_code_base;
  }
}

}  // namespace macadam::harmonic
