// SPDX-License-Identifier: GPL-3.0-or-later
// reduced_spectrum.cpp  Collects the laws and matrices of a reduced model: one law and its matrices for each pair type
// and, for contacts with rock in series, for each class of a pair type.
#include "host/spectrum/reduced_spectrum.hpp"

#include <algorithm>
#include <type_traits>

#include "host/spectrum/decay.hpp"

namespace macadam::harmonic {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Units of a class with a modulus below this fraction of its instantaneous modulus are left out.
constexpr double no_modulus = 1e-14;

/// Returns the relaxation of a law with a spring of compliance `series` [1/Pa] in series: the stiffness of the law's
/// own spring is reduced.
PronySeries relaxation_in_series(Law law, double series) {
  std::visit(
      [&]<class L>(L& l) {
        if constexpr (std::is_base_of_v<laws::GeneralisedKelvin, L>)
          l.E_m /= 1 + series * l.E_m;
        else
          l.E /= 1 + series * l.E;
      },
      law);
  PronySeries out = prony_series(law);
  const double least = no_modulus * out.instantaneous();
  std::erase_if(out.units, [&](const PronySeries::Unit& u) { return !(u.modulus > least); });
  return out;
}

/// Returns a series whose moduli are multiplied by `factor`.
PronySeries times(double factor, PronySeries series) {
  series.long_term *= factor;
  for (PronySeries::Unit& u : series.units) u.modulus *= factor;
  return series;
}

}  // namespace

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
