// SPDX-License-Identifier: GPL-3.0-or-later
// stepper_input.cpp  Checks laws, damping, boundary and start of a stepper before any array is made.
#include "kernels/step/stepper_input.hpp"

#include <cmath>
#include <cstdio>
#include <string>

#include "macadam/error.hpp"

namespace macadam::kernels {
namespace {

std::string shown(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", x);
  return text;
}

/// Checks that a start state belongs to this network, and that laws and boundary allow such a start.
void require_start(std::size_t particles, const ContactNetwork& network, const FactsTable& laws,
                   const StepperOptions& options) {
  const StartState& start = *options.start;
  if (!options.boundary.body_force.empty())
    throw InputError(
        "start state: found body forces, expected none, because a steady state is computed without body forces");
  for (const auto& law : laws) {
    if (law && !law->linear)
      throw InputError(std::string("start state: found law ") + law->name +
                       ", which is not linear, expected linear laws");
  }
  const auto require = [](const char* what, std::size_t found, std::size_t expected) {
    if (found != expected) {
      throw InputError(std::string("start state: ") + what + ": found " + std::to_string(found) + ", expected " +
                       std::to_string(expected));
    }
  };
  require("displacements", start.displacement.size(), particles);
  require("rotations", start.rotation.size(), particles);
  require("velocities", start.velocity.size(), particles);
  require("spins", start.spin.size(), particles);
  require("number of entries of chain_begin", start.chain_begin.size(), network.contacts.size());
  std::size_t numbers = 0;
  for (std::size_t c = 0; c < network.contacts.size(); ++c) {
    require("an entry of chain_begin", start.chain_begin[c], numbers);
    numbers += 6 * static_cast<std::size_t>(1 + laws[static_cast<std::size_t>(network.contacts[c].pair)]->units);
  }
  require("number of entries of chain", start.chain.size(), numbers);
  for (const WallMotionSpec& wall : options.boundary.wall) {
    for (const WallAxis& axis : wall.axis) {
      if (axis.by == DrivenBy::force)
        throw InputError("start state: found a wall under a force, expected walls with given displacements");
      if (axis.drive && axis.drive->begins())
        throw InputError(
            "start state: found a drive that begins at step 0, such as a drive with a ramp, expected a drive that is "
            "already in motion at step 0");
    }
  }
}

/// Checks that every driven axis has a drive with the stepper's time step, and that a wall under a force has a mass.
void require_boundary(std::size_t particles, const StepperOptions& options) {
  const Boundary& boundary = options.boundary;
  const auto refuse = [](const std::string& what, const std::string& found, const std::string& expected) {
    throw InputError("boundary: " + what + ": found " + found + ", expected " + expected);
  };
  for (std::size_t w = 0; w < wall_count; ++w) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const WallAxis& a = boundary.wall[w].axis[axis];
      const std::string which = std::string("wall ") + wall_names[w] + ", axis " + "xyz"[axis];
      if (a.by == DrivenBy::rest) continue;
      if (!a.drive) refuse(which, "no drive", "a drive, because the axis is driven");
      if (!(std::abs(a.drive->dt() - options.dt) <= 1e-12 * options.dt)) {
        refuse(which + ": time step of its drive", shown(a.drive->dt()) + " s",
               shown(options.dt) + " s, the time step of the stepper");
      }
      if (a.by == DrivenBy::displacement && !options.start && a.drive->value(0) != 0) {
        refuse(which + ": displacement at the start", shown(a.drive->value(0)) + " m",
               "0, because nothing is deformed at the start");
      }
      if (a.by == DrivenBy::force && !(boundary.wall[w].mass > 0)) {
        refuse(which + ": mass of a wall under a force", shown(boundary.wall[w].mass) + " kg", "above 0");
      }
    }
  }
  for (const std::int32_t i : boundary.fixed) {
    if (i < 0 || static_cast<std::size_t>(i) >= particles) {
      refuse("fixed particle", std::to_string(i), "0 to " + std::to_string(particles - 1));
    }
  }
  if (!boundary.body_force.empty() && boundary.body_force.size() != particles) {
    refuse("body forces", std::to_string(boundary.body_force.size()),
           "none, or one per particle: " + std::to_string(particles));
  }
}

/// Checks that the laws of all contacts with rock in series support such rock. The force of a coupled law also depends
/// on the length, which must then equal the distance.
void require_series(const ContactNetwork& network, const FactsTable& laws) {
  for (std::size_t c = 0; c < network.contacts.size(); ++c) {
    const Contact& contact = network.contacts[c];
    const auto& given = laws[static_cast<std::size_t>(contact.pair)];
    if (!given || given->series) continue;
    const LawFacts& law = *given;
    const std::string where = "contact " + std::to_string(c) + " of pair " + to_string(contact.pair) + ": ";
    const std::string because =
        std::string(", because its law ") + law.name +
        (law.coupled || !law.linear ? " is not linear" : " has no step_stiffness() and no factor of advance()") +
        "; choose another law, or a [network] whose rule is not \"series\"";
    if (contact.series != 0)
      throw InputError(where + "compliance of the rock in series: found " + shown(contact.series) +
                       " 1/Pa, expected 0" + because);
    if (law.coupled && contact.length != contact.distance)
      throw InputError(where + "length: found " + shown(contact.length) + " m, expected the distance of the contact, " +
                       shown(contact.distance) + " m" + because);
  }
}

}  // namespace

void require_input(std::size_t particles, const ContactNetwork& network, const FactsTable& laws,
                   const StepperOptions& options) {
  if (!network.cells.empty())
    throw InputError(
        "rule of the network: found \"volumetric\", expected \"centres\" or \"series\", because steps do not compute "
        "the "
        "pressures of cells; the frequency domain does");
  for (int pair = 0; pair < pair_types; ++pair) {
    const auto p = static_cast<std::size_t>(pair);
    if (network.count[p] > 0 && !laws[p]) {
      throw InputError(std::string("pair ") + to_string(static_cast<PairType>(pair)) + " has " +
                       std::to_string(network.count[p]) + " contacts but no law");
    }
    if (laws[p] && laws[p]->only_units >= 0 && laws[p]->units != laws[p]->only_units) {
      throw InputError(std::string("law ") + laws[p]->name + ": found units() = " + std::to_string(laws[p]->units) +
                       ", expected its only_units = " + std::to_string(laws[p]->only_units));
    }
    if (network.count[p] > 0 && laws[p]->needs_double && options.precision == Precision::single) {
      throw InputError(std::string("precision: found single beside law ") + laws[p]->name + " of pair " +
                       to_string(static_cast<PairType>(pair)) +
                       ", whose states need double precision; expected mixed or double");
    }
  }
  require_series(network, laws);
  if (options.damping_kind == Damping::viscous && !(options.damping * options.dt < 2)) {
    throw InputError("viscous damping: found beta * dt = " + std::to_string(options.damping * options.dt) +
                     ", expected below 2 (choose a smaller time_step or less damping)");
  }
  require_boundary(particles, options);
  if (options.start) require_start(particles, network, laws, options);
}

}  // namespace macadam::kernels
