// SPDX-License-Identifier: GPL-3.0-or-later
// cases.cpp  Turns texts of the command line into specimens.
#include "host/tools/bench/cases.hpp"

#include <cstdlib>

#include "macadam/error.hpp"

namespace macadam::bench {

BenchCase case_of(const std::string& text) {
  const std::string word = "lattice:";
  if (text.starts_with(word)) {
    char* end = nullptr;
    const double particles = std::strtod(text.c_str() + word.size(), &end);
    if (end == text.c_str() + word.size() || *end != '\0' || !(particles >= 100 && particles <= 1e9))
      throw InputError("scene: found \"" + text + "\", expected lattice: and a number of particles from 100 to 1e9");
    BenchCase out = lattice(static_cast<std::size_t>(particles), true);
    out.name = text;
    return out;
  }
  const std::size_t sign = text.find('=');
  Scene scene = read_scene(text.substr(0, sign));
  if (sign != std::string::npos) scene.specimen.file = text.substr(sign + 1);
  Preparation prepared = prepare(scene);
  const std::filesystem::path file = std::filesystem::absolute(scene.file).lexically_normal();
  BenchCase out;
  out.name = (file.stem() == "scene" ? file.parent_path().filename() : file.stem()).string();
  out.inertia = make_inertia(prepared.specimen, scene.materials.aggregate, scene.materials.mastic);
  out.specimen = std::move(prepared.specimen);
  out.network = std::move(prepared.network);
  out.laws = scene.laws;
  return out;
}

LawTable elastic(LawTable laws) {
  for (auto& law : laws) {
    if (!law) continue;
    law = std::visit([](const auto& l) { return laws::Elastic{l.instantaneous(), facts_of(l).alpha}; }, *law);
  }
  return laws;
}

LawTable with_units(LawTable laws, int units) {
  for (auto& law : laws) {
    auto* kelvin = law ? std::get_if<laws::GeneralisedKelvin>(&*law) : nullptr;
    if (!kelvin || kelvin->E.empty()) continue;
    kelvin->E.assign(static_cast<std::size_t>(units), units * kelvin->E.front());
    kelvin->C.assign(static_cast<std::size_t>(units), units * kelvin->C.front());
  }
  return laws;
}

}  // namespace macadam::bench
