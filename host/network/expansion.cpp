// SPDX-License-Identifier: GPL-3.0-or-later
// expansion.cpp  Computes the openings of contacts that expand freely, and the reduced time of a law whose temperature
// changes.
#include <array>
#include <cmath>

#include "macadam/temperature.hpp"

namespace macadam {
namespace {

/// Largest change of log10 a_T in a panel of the quadrature. The error of the quadrature is then below 1e-12.
constexpr double gauss_panel = 0.25;
/// Nodes and weights of Gauss's quadrature with five points on −1 … 1.
constexpr std::array<double, 5> gauss_nodes{-0.906179845938664, -0.5384693101056831, 0, 0.5384693101056831,
                                            0.906179845938664};
constexpr std::array<double, 5> gauss_weights{0.23692688505618908, 0.47862867049936647, 0.5688888888888889,
                                              0.47862867049936647, 0.23692688505618908};

double relaxation_rate(const laws::Shift& shift, double temperature) {
  return std::pow(10.0, -laws::log10_shift(shift, temperature));
}

/// Returns the times between `from` and `to` at which the history has a corner, or a temperature at which the shift has
/// one.
std::vector<double> corners_between(const laws::Shift& shift, const TemperatureHistory& history, double from,
                                    double to) {
  std::vector<double> out;
  const auto add = [&](double time) {
    if (time > from && time < to) out.push_back(time);
  };
  for (std::size_t i = 0; i < history.times.size(); ++i) {
    add(history.times[i]);
    const auto* table = std::get_if<laws::ShiftTable>(&shift);
    if (!table || i == 0) continue;
    const double begin = history.times[i - 1], change = history.temperatures[i] - history.temperatures[i - 1];
    for (const double t : table->temperatures) {
      const double part = (t - history.temperatures[i - 1]) / change;
      if (part > 0 && part < 1) add(begin + part * (history.times[i] - begin));
    }
  }
  out.push_back(to);
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace

double reduced_time(const laws::Shift& shift, const TemperatureHistory& history, double from, double to) {
  if (history.empty() || std::holds_alternative<laws::NoShift>(shift)) return to - from;
  double out = 0, begin = from;
  for (const double end : corners_between(shift, history, from, to)) {
    const double first = history.at(begin), last = history.at(end);
    if (first == last) {
      out += (end - begin) * relaxation_rate(shift, first);
    } else {
      const double change = std::abs(laws::log10_shift(shift, last) - laws::log10_shift(shift, first));
      if (std::isnan(change)) return change;
      const auto panels = static_cast<int>(1 + change / gauss_panel);
      const double half = 0.5 * (end - begin) / panels;
      for (int p = 0; p < panels; ++p) {
        const double centre = begin + (2 * p + 1) * half;
        for (std::size_t k = 0; k < gauss_nodes.size(); ++k)
          out += half * gauss_weights[k] * relaxation_rate(shift, history.at(centre + half * gauss_nodes[k]));
      }
    }
    begin = end;
  }
  return out;
}

// A particle is rigid in the model. If the material expands by ε = α·ΔT everywhere, the centres move by ε·x, and the
// relative displacement of the two particles of a contact is ε·(x_b − x_a) = ε·d·n at every point of the facet: a pure
// opening, because the facets of the tessellation are normal to the lines of centres. Two phases with different
// coefficients open the contact by the sum over both sides. The lever arms have signs, so the sum is right even if the
// facet does not lie between the centres.
std::vector<double> free_openings(const ContactNetwork& network, const Specimen& specimen, const Expansion& expansion) {
  std::vector<double> out;
  out.reserve(network.contacts.size());
  for (const Contact& c : network.contacts) {
    const auto of = [&](std::int32_t end) { return expansion.of(specimen.phase[static_cast<std::size_t>(end)]); };
    if (!has_laws_of_phases(network.rule)) {
      const double a = of(c.a), b = c.b < 0 ? a : of(c.b);
      out.push_back(a == b ? a * c.distance : a * c.arm_a + b * c.arm_b);
      continue;
    }
    const bool of_rock = c.pair == PairType::inner || c.pair == PairType::aw;
    const double rock = of_rock ? c.distance : c.series * c.length * network.rock_modulus;
    out.push_back(expansion.mastic * (c.distance - rock) + expansion.aggregate * rock);
  }
  return out;
}

}  // namespace macadam
