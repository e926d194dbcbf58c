// SPDX-License-Identifier: GPL-3.0-or-later
// reduced_spectrum.cpp  Collects the laws and matrices of a reduced model: one law and its matrices for each pair type
// and, for contacts with rock in series, for each class of a pair type.
#include "host/spectrum/reduced_spectrum.hpp"

#include "host/spectrum/decay.hpp"
#include "host/spectrum/law_in_series.hpp"

namespace macadam::harmonic {

PronySeries reduced_spectrum(const ReducedModel& model, const std::array<std::optional<Law>, pair_types>& laws,
                             double to_modulus) {
  Decay decay(model.motions());
  const auto alpha_of = [](const Law& law) { return std::visit([](const auto& l) { return l.alpha; }, law); };
  for (std::size_t pair = 0; pair < pair_types; ++pair)
    if (laws[pair]) decay.add(prony_series(*laws[pair]), model.form(pair, alpha_of(*laws[pair])));
  const auto& classes = model.rock().classes();
  for (std::size_t i = 0; i < classes.size(); ++i) {
    const Law& law = laws[classes[i].pair].value();
    const double alpha = alpha_of(law), series = classes[i].series;
    decay.add(relaxation_in_series(law, series), model.rock_forms()[i].normal);
    // α·k/(1 + α·r·k): α times the law in series with a spring of compliance α·r
    if (alpha != 0) decay.add(times(alpha, relaxation_in_series(law, alpha * series)), model.rock_forms()[i].shear);
  }
  return times(to_modulus, classes.empty() ? decay.all_units() : decay.few_units());
}

}  // namespace macadam::harmonic
