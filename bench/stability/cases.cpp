// SPDX-License-Identifier: GPL-3.0-or-later
// cases.cpp  Lists the stability cases. To add a case, write its function and add a line to this list.
#include "bench/stability/stability.hpp"

namespace macadam::stability {

const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      {"step_sweep", "Steps around the true limit", step_sweep},
      {"step_bound", "The computed step against the true limit", step_bound},
      {"stiffness_ratios", "Stiffness ratios between the phases", stiffness_ratios},
      {"size_ratios", "Size ratios", size_ratios},
      {"slivers", "Slivers and tiny facets", slivers},
      {"relaxation_times", "Relaxation times far from the step", relaxation_times},
      {"long_free", "Long free runs: energy and momenta", long_free},
      {"long_driven", "Long driven runs: E*", long_driven},
      {"strain_amplitudes", "Strain amplitudes", strain_amplitudes},
      {"recovery", "Load, hold, reversal and release", recovery},
      {"rigid_turn", "A full turn", rigid_turn},
      {"cracks", "Contacts that crack", cracks},
  };
  return all;
}

}  // namespace macadam::stability
