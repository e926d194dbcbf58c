// SPDX-License-Identifier: GPL-3.0-or-later
// damaged_contacts.cpp  Sums the cracks of contact points over their contacts.
#include "host/run/damaged_contacts.hpp"

#include <fmt/format.h>

#include "host/files/result_files.hpp"

namespace macadam {

std::vector<ContactCrack> contact_cracks(const ContactNetwork& network, const std::vector<laws::PointCrack>& points) {
  std::vector<ContactCrack> out(network.contacts.size());
  for (std::size_t c = 0; c < out.size(); ++c) {
    const Contact& contact = network.contacts[c];
    ContactCrack& crack = out[c];
    double all = 0;
    for (std::uint32_t j = contact.point_begin; j < contact.point_end; ++j) {
      const double area = network.point_area[j];
      const laws::PointCrack& point = points[j];
      all += area;
      crack.opening_m += area * point.opening, crack.slip_m += area * point.slip, crack.damage += area * point.damage;
      crack.energy_j += area * point.energy, crack.friction_j += area * point.friction;
      crack.cracked_points += point.damage > 0;
    }
    if (all > 0) crack.opening_m /= all, crack.slip_m /= all, crack.damage /= all;
  }
  return out;
}

void write_damage(const std::filesystem::path& out, const Preparation& prepared,
                  const std::vector<laws::PointCrack>& points, double time_s) {
  const ContactNetwork& network = prepared.network;
  LineWriter writer(out / damage_file,
                    fmt::format("# contacts that have begun to crack, at t = {} s; opening, slip and damage are means "
                                "over the facet, and (x, y, z) is the centroid of the facet\n"
                                "contact,a,b,pair,x,y,z,nx,ny,nz,area_m2,opening_m,slip_m,damage,energy_j,friction_j,"
                                "cracked_points,points",
                                time_s));
  std::vector<ContactCrack> cracks;
  if (!points.empty()) cracks = contact_cracks(network, points);
  for (std::size_t i = 0; i < cracks.size(); ++i) {
    const ContactCrack& crack = cracks[i];
    if (crack.cracked_points == 0) continue;
    const Contact& c = network.contacts[i];
    const Vec3d x = prepared.specimen.centre[static_cast<std::size_t>(c.a)] + c.arm_a * c.n +
                    (1 / c.moments.a) * (c.moments.s * c.s + c.moments.t * c.t);
    writer.add(fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}", i, c.a, c.b, to_string(c.pair), x.x,
                           x.y, x.z, c.n.x, c.n.y, c.n.z, c.area, crack.opening_m, crack.slip_m, crack.damage,
                           crack.energy_j, crack.friction_j, crack.cracked_points, c.point_end - c.point_begin));
  }
  writer.close();
}

}  // namespace macadam
