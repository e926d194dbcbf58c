// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reference_input.cpp  Checks network, masses, laws and options. Each message names the item at fault.
#include "host/reference/reference_input.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "macadam/error.hpp"

namespace macadam::reference {
namespace {

constexpr const char* source = "reference stepper";

bool positive(double value) { return std::isfinite(value) && value > 0; }

}  // namespace

ReferenceLaws read_laws(const ContactNetwork& network, const LawTable& laws) {
  ReferenceLaws out;
  for (const Contact& contact : network.contacts) {
    const auto index = static_cast<std::size_t>(contact.pair);
    if (out[index]) continue;
    const std::string pair = to_string(contact.pair);
    if (!laws[index]) {
      throw InputError(source, 0, fmt::format("contact {} – {} of pair {}", contact.a, contact.b, pair), "no law",
                       "a law for this pair");
    }
    out[index] = make_reference_law(*laws[index], pair);
  }
  return out;
}

void require_count(const char* what, std::size_t found, std::size_t expected) {
  if (found != expected) {
    throw InputError(source, 0, what, std::to_string(found), fmt::format("{}, one per particle", expected));
  }
}

void require_network(const ContactNetwork& network, std::size_t particles) {
  if (!network.cells.empty())
    throw InputError(source, 0, "rule", "\"volumetric\"",
                     "\"centres\" or \"series\", because contact points do not know the pressures of cells");
  const auto n = static_cast<std::int64_t>(particles);
  const std::size_t points = std::min({network.point_s.size(), network.point_t.size(), network.point_area.size()});
  for (std::size_t c = 0; c < network.contacts.size(); ++c) {
    const Contact& contact = network.contacts[c];
    const std::string which = fmt::format("contact {} ({} – {})", c, contact.a, contact.b);
    if (contact.a < 0 || contact.a >= n || contact.b >= n || contact.b < wall_z_hi || contact.a == contact.b) {
      throw InputError(source, 0, which, "particle numbers that are out of range",
                       fmt::format("two of the particles 0…{}, or one and a wall −1…−6", n - 1));
    }
    if (!positive(contact.distance)) {
      throw InputError(source, 0, which + ": distance", fmt::format("{}", contact.distance), "a positive length");
    }
    if (!positive(contact.length)) {
      throw InputError(source, 0, which + ": length", fmt::format("{}", contact.length), "a positive length");
    }
    if (!(std::isfinite(contact.series) && contact.series >= 0)) {
      throw InputError(source, 0, which + ": compliance in series", fmt::format("{}", contact.series),
                       "at least 0 1/Pa");
    }
    if (contact.point_begin > contact.point_end || contact.point_end > points) {
      throw InputError(source, 0, which + ": contact points",
                       fmt::format("{}…{}", contact.point_begin, contact.point_end),
                       fmt::format("a range in the network's {} points", points));
    }
  }
}

void require_inertia(const Inertia& inertia, std::size_t particles) {
  require_count("masses", inertia.mass.size(), particles);
  require_count("moments of inertia", inertia.inertia.size(), particles);
  for (std::size_t i = 0; i < particles; ++i) {
    if (!positive(inertia.mass[i]) || !positive(inertia.inertia[i])) {
      throw InputError(source, 0, fmt::format("particle {}", i),
                       fmt::format("mass {} kg, moment of inertia {} kg·m²", inertia.mass[i], inertia.inertia[i]),
                       "both positive and finite");
    }
  }
}

void require_options(const StepperOptions& options) {
  const auto require = [](bool good, const char* what, double found, const char* expected) {
    if (!good) throw InputError(source, 0, what, fmt::format("{}", found), expected);
  };
  if (options.precision != Precision::double_) {
    throw InputError(source, 0, "precision", options.precision == Precision::mixed ? "mixed" : "single", "double");
  }
  require(positive(options.dt), "time step", options.dt, "a positive time");
  require(positive(options.density_scaling), "density scaling", options.density_scaling, "a positive factor");
  require(std::isfinite(options.damping) && options.damping >= 0, "damping", options.damping, "at least 0");
}

}  // namespace macadam::reference
