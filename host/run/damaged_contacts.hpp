// SPDX-License-Identifier: GPL-3.0-or-later
/// \file damaged_contacts.hpp  Summarises the cracks of each contact: for damage.csv, and for fields.
#pragma once

#include <filesystem>
#include <vector>

#include "macadam/contact_network.hpp"
#include "macadam/simulation.hpp"
#include "macadam/stepper.hpp"

namespace macadam {

/// The name of the table of damaged contacts in the folder of the results.
inline constexpr const char* damage_file = "damage.csv";

/// Crack of a whole contact. Lengths and damage are means over the area of the facet, energies are sums.
struct ContactCrack {
  double opening_m = 0, slip_m = 0, damage = 0;
  double energy_j = 0;    ///< dissipated by damage, and stored in the crack
  double friction_j = 0;  ///< work of friction
  std::int64_t cracked_points = 0;
};

/// Returns the crack of each contact from the cracks of the points, which are in the order of the network's points.
std::vector<ContactCrack> contact_cracks(const ContactNetwork& network, const std::vector<laws::PointCrack>& points);

/// Writes damage.csv, with a row for each contact that has begun to crack, in the network's order.
/// `points`: empty if nothing has been sampled. \throws RunError.
void write_damage(const std::filesystem::path& out, const Preparation& prepared,
                  const std::vector<laws::PointCrack>& points, double time_s);

}  // namespace macadam
