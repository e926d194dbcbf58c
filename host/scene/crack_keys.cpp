// SPDX-License-Identifier: GPL-3.0-or-later
// crack_keys.cpp  Reads the values of a crack, fills in those that are left out, and checks that they fit together.
#include "host/scene/crack_keys.hpp"

#include <fmt/format.h>

namespace macadam::scene {
namespace {

using laws::Crack;
using laws::Softening;

// Numbers without a unit must be plausible in SI units, because MPa and kJ/m2 are easily forgotten.
constexpr Rule in_pascals{[](double v) { return v >= 1000; },
                          "1000 Pa or more; a strength in another unit is text with the unit"};
constexpr Rule in_joules{[](double v) { return v >= 1; },
                         "1 J/m2 or more; an energy in another unit, or a smaller one, is text with the unit"};
constexpr Rule coefficient{[](double v) { return v >= 0 && v <= 5; },
                           "a coefficient of friction from 0 to 5, not an angle"};

/// Stores the kink of the bilinear curve. \throws InputError if the curve does not fall from the kink to zero.
void set_kink(const Section& section, const std::vector<double>& kink, Crack& crack) {
  const auto refuse = [&](const std::string& expected) {
    section.refuse("kink", fmt::format("[{}]", fmt::join(kink, ", ")), expected);
  };
  if (crack.softening != Softening::bilinear) {
    section.refuse("kink", fmt::format("this key with softening = \"{}\"", to_string(crack.softening)),
                   "this key only with softening = \"bilinear\"");
  }
  if (kink.size() != 2) refuse("two numbers: opening over G_f/f_t, and stress over f_t");
  crack.kink_opening = kink[0], crack.kink_stress = kink[1];
  if (!(kink[0] > 0 && kink[0] < 2 && kink[1] > 0 && kink[1] < 1 && (2 - kink[0]) / kink[1] > kink[0]))
    refuse("an opening above 0 and below 2, and a stress above 0 and below 1, from which the curve falls to 0");
}

}  // namespace

Crack read_crack(const Section& section, TemperatureTables& tables) {
  Crack out;
  std::optional<double> strength, energy, shear_strength, shear_energy, residual_friction;
  std::optional<std::vector<double>> kink;
  section.read(
      {{"tensile_strength", Need::required, at_temperature(strength, modulus, in_pascals, tables),
        "f_t, tensile stress at which a contact point begins to crack"},
       {"fracture_energy", Need::optional, at_temperature(energy, fracture_energy, in_joules, tables),
        "G_f, energy per area that a tensile crack takes", "none; required unless softening is \"brittle\""},
       {"shear_strength", Need::optional, at_temperature(shear_strength, modulus, in_pascals, tables),
        "c_0, shear stress at which a contact point that carries no pressure begins to crack",
        "twice tensile_strength"},
       {"shear_fracture_energy", Need::optional, at_temperature(shear_energy, fracture_energy, in_joules, tables),
        "G_f2, energy per area that a shear crack takes", "fracture_energy"},
       {"softening", Need::optional,
        into<Softening>(out.softening, {{"linear", Softening::linear},
                                        {"bilinear", Softening::bilinear},
                                        {"exponential", Softening::exponential},
                                        {"brittle", Softening::brittle}}),
        "curve of the cohesive stress over the opening"},
       {"kink",
        Need::optional,
        {[&](const Value& value) { kink = value.numbers(ratio, positive); },
         {"list of numbers", &ratio, positive.words}},
        "kink of the bilinear curve: opening over G_f/f_t, and stress over f_t",
        "[0.8, 0.3333]"},
       {"friction", Need::optional, into(out.friction, ratio, coefficient),
        "coefficient of friction of shut faces at the beginning of cracking"},
       {"residual_friction", Need::optional, into(residual_friction, ratio, coefficient),
        "coefficient of friction of shut faces after separation", "friction"}});
  const bool brittle = out.softening == Softening::brittle;
  for (const char* key : {"fracture_energy", "shear_fracture_energy"}) {
    if (brittle && section.has(key))
      section.refuse(key, "this key with softening = \"brittle\"", "no fracture energy, or another softening");
  }
  if (!brittle && !energy) {
    section.refuse("fracture_energy", "nothing",
                   "this key, or softening = \"brittle\", which needs no fracture energy");
  }
  out.tensile_strength = *strength;
  out.fracture_energy = energy.value_or(0);
  out.shear_fracture_energy = shear_energy.value_or(out.fracture_energy);
  out.shear_strength = shear_strength.value_or(2 * out.tensile_strength);
  out.residual_friction = residual_friction.value_or(out.friction);
  if (out.residual_friction > out.friction) {
    section.refuse("residual_friction", fmt::format("{}", out.residual_friction),
                   fmt::format("at most friction = {}", out.friction));
  }
  if (kink) set_kink(section, *kink, out);
  return out;
}

Law with_crack(Law law, const Crack& crack) {
  return std::visit(
      [&]<class L>(L& chain) -> Law {
        if constexpr (can_have_crack<L>)
          return laws::Cracked<L>{std::move(chain), crack};
        else
          return std::move(chain);
      },
      law);
}

Key crack_key(std::optional<Crack>& target, TemperatureTables& tables) {
  return {"crack", Need::optional,
          section_by([&target, &tables](const Value& value) { target = read_crack(value.section(), tables); }),
          "cohesive crack in series with the law at every contact point of the pair", "contacts that never crack"};
}

void require_particles(const Section& section, PairType pair) {
  if (pair != PairType::aw && pair != PairType::mw) return;
  section.refuse("crack", fmt::format("this key for {}, a pair with a wall", to_string(pair)),
                 "this key only for pairs of two particles, because contacts with a wall do not crack");
}

}  // namespace macadam::scene
