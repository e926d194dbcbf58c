// SPDX-License-Identifier: GPL-3.0-or-later
// main.cpp  A program outside of the repository that uses the installed library: four spheres, their cells, their
// contacts, and ten time steps.
#include <macadam/macadam.hpp>

#include <array>
#include <cstdio>
#include <optional>
#include <string>

namespace {

/// Returns spheres of 1 mm diameter in two layers of two, each with a cubic cell.
macadam::Specimen make_specimen() {
  macadam::Specimen specimen;
  specimen.box = {{2e-3, 1e-3, 2e-3}};
  for (const double z : {0.5e-3, 1.5e-3}) {
    for (const double x : {0.5e-3, 1.5e-3}) {
      specimen.centre.push_back({x, 0.5e-3, z});
      specimen.radius.push_back(0.5e-3);
      specimen.phase.push_back(macadam::Phase::mastic);
      specimen.body.push_back(-1);
    }
  }
  return specimen;
}

/// Returns whether an error that the library throws is caught by its type in this program.
bool catches_errors() {
  try {
    macadam::tessellate({});
  } catch (const macadam::InputError&) { return true; }
  return false;
}

}  // namespace

int main() {
  using macadam::PairType;
  const macadam::Specimen specimen = make_specimen();
  const macadam::Tessellation tessellation = macadam::tessellate(specimen);
  const macadam::ContactNetwork network = macadam::build_network(specimen, tessellation);
  for (const macadam::Contact& c : network.contacts) {
    std::printf("%d %d %s area %.6f mm2\n", c.a, c.b, macadam::to_string(c.pair), 1e6 * c.area);
  }

  std::array<std::optional<macadam::Law>, macadam::pair_types> laws;
  laws[static_cast<std::size_t>(PairType::mm)] = macadam::laws::GeneralisedKelvin{1e9, 1e8, {2e9}, {1e8}, 0.1};
  laws[static_cast<std::size_t>(PairType::mw)] = macadam::laws::Elastic{1e9, 0};
  const macadam::Inertia inertia = macadam::make_inertia(specimen, 2630, 2110);
  macadam::StepperOptions options;
  options.dt = 0.5 * macadam::critical_step(network, laws, inertia, options).dt;
  const auto stepper = macadam::make_stepper(macadam::Backend::cpu, specimen, network, laws, inertia, options);
  stepper->advance(10);

  const bool good = network.contacts.size() == 8 && stepper->observe().step == 10 && catches_errors();
  std::printf("macadam %s: %zu contacts, %s: %s\n", macadam::version(), network.contacts.size(),
              stepper->description().c_str(), good ? "good" : "WRONG");
  return good ? 0 : 1;
}
