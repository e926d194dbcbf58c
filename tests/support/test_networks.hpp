// SPDX-License-Identifier: GPL-3.0-or-later
/// \file test_networks.hpp  Small hand-made networks whose numbers can be worked out on paper.
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "macadam/contact_network.hpp"
#include "macadam/laws/all.hpp"
#include "macadam/stepper.hpp"

namespace macadam::test {

using Laws = LawTable;

/// A specimen with its contacts and masses: everything that a stepper needs except the laws and the options.
struct HandMade {
  Specimen specimen;
  ContactNetwork network;
  Inertia inertia;
};

/// Returns a table with the same law for every pair type.
inline Laws same_law(const Law& law) {
  Laws out;
  out.fill(law);
  return out;
}

/// Returns the mastic–mastic constants of AM1 from Table 4 of [1], in Pa and Pa·s.
inline laws::GeneralisedKelvin mastic_am1() {
  return {1.115e10, 2.515e9, {3.799e8, 1.600e9, 4.308e10}, {8.950e9, 5.695e9, 1.114e9}, 0.10};
}
/// Returns the mastic–mastic constants of AM2 from Table 4 of [1], in Pa and Pa·s.
inline laws::GeneralisedKelvin mastic_am2() {
  return {8.909e9, 1.164e9, {1.064e10, 6.326e9, 5.776e10}, {2.854e8, 5.865e8, 5.354e9}, 0.10};
}

/// Returns the second moment Σ A_J·s² = Σ A_J·t² over the five points of a square facet. Each vertex holds a sixth of
/// the area at a distance of half a side. (The second moment of the square itself is half of that.)
inline double square_second_moment(double side) { return side * side * side * side / 6; }

/// Adds a particle of given mass; it has the moment of inertia of a solid sphere.
inline void add_particle(HandMade& made, const Vec3d& centre, double radius, double mass, Phase phase) {
  made.specimen.centre.push_back(centre);
  made.specimen.radius.push_back(radius);
  made.specimen.phase.push_back(phase);
  made.specimen.body.push_back(phase == Phase::mastic ? -1 : static_cast<std::int32_t>(made.specimen.size()) - 1);
  made.inertia.mass.push_back(mass);
  made.inertia.inertia.push_back(0.4 * mass * radius * radius);
}

/// Adds a contact over a square facet. Its points are the four vertices and then the centroid, which lies at x0 + (s0,
/// t0).
inline void add_square_contact(ContactNetwork& network, std::int32_t a, std::int32_t b, PairType pair, const Vec3d& n,
                               double arm_a, double arm_b, double side, double s0 = 0, double t0 = 0) {
  Contact contact;
  contact.a = a;
  contact.b = b;
  contact.pair = pair;
  contact.length = contact.distance = arm_a + arm_b;
  contact.area = side * side;
  contact.n = n;
  canonical_frame(n, contact.s, contact.t);
  contact.arm_a = arm_a;
  contact.arm_b = arm_b;
  contact.point_begin = static_cast<std::uint32_t>(network.point_area.size());
  const double h = side / 2;
  const double s[5] = {-h, h, h, -h, 0}, t[5] = {-h, -h, h, h, 0};
  for (int j = 0; j < 5; ++j) {
    const double area =
        // a vertex is in two of the four triangles of the fan, the centroid in all four
        contact.area / (j < 4 ? 6 : 3);
    const double ps = s0 + s[j], pt = t0 + t[j];
    network.point_s.push_back(ps);
    network.point_t.push_back(pt);
    network.point_area.push_back(area);
    AreaMoments& m = contact.moments;
    m.a += area, m.s += area * ps, m.t += area * pt;
    m.ss += area * ps * ps, m.st += area * ps * pt, m.tt += area * pt * pt;
  }
  contact.point_end = static_cast<std::uint32_t>(network.point_area.size());
  network.contacts.push_back(contact);
  ++network.count[static_cast<std::size_t>(pair)];
}

/// Lists the contacts of every particle. Call it when all contacts are there, in order of (a, b).
inline void fill_rows(ContactNetwork& network, std::size_t particles) {
  network.row_begin.assign(1, 0);
  network.rows.clear();
  for (std::size_t i = 0; i < particles; ++i) {
    for (std::size_t c = 0; c < network.contacts.size(); ++c) {
      const Contact& contact = network.contacts[c];
      if (contact.a == static_cast<std::int32_t>(i) || contact.b == static_cast<std::int32_t>(i)) {
        network.rows.push_back(static_cast<std::uint32_t>(c));
      }
    }
    network.row_begin.push_back(static_cast<std::uint32_t>(network.rows.size()));
  }
}

/// Two free mastic spheres that are joined over a square facet.
struct PairShape {
  double radius_a = 1.0e-3, radius_b = 0.8e-3;  ///< [m]
  double mass_a = 2.0e-5, mass_b = 1.0e-5;      ///< [kg]
  double distance = 1.7e-3;                     ///< [m]
  double side = 1.2e-3;                         ///< edge of the square facet [m]
  Vec3d n{0, 0, 1};                             ///< from a to b, a unit vector
  double s0 = 0, t0 = 0;                        ///< position of the centroid in the facet's frame [m]

  /// Returns the distance of x0 from the centre of A: R − Un/2 − dv with dv of Eq. 5 of [1]. At x0 both spheres have
  /// equal power.
  double arm_a() const { return (distance * distance + radius_a * radius_a - radius_b * radius_b) / (2 * distance); }
  double arm_b() const { return distance - arm_a(); }
};

inline HandMade two_sphere_network(const PairShape& shape = {}) {
  HandMade made;
  made.specimen.box.size = {0.01, 0.01, 0.01};
  const Vec3d a{0.005, 0.005, 0.005};
  add_particle(made, a, shape.radius_a, shape.mass_a, Phase::mastic);
  add_particle(made, a + shape.distance * shape.n, shape.radius_b, shape.mass_b, Phase::mastic);
  add_square_contact(made.network, 0, 1, PairType::mm, shape.n, shape.arm_a(), shape.arm_b(), shape.side, shape.s0,
                     shape.t0);
  fill_rows(made.network, 2);
  return made;
}

/// Returns nx × ny × nz cubes of edge `side` that fill the box, each with a mastic sphere of radius side/2 at its
/// centre. Particle (i, j, k) has number (i·ny + j)·nz + k. The bottom and top walls are contacts; lateral faces are
/// free.
inline HandMade cubic_lattice_network(int nx, int ny, int nz, double side, double mass) {
  HandMade made;
  made.specimen.box.size = {nx * side, ny * side, nz * side};
  const double half = side / 2;
  const auto number = [&](int i, int j, int k) { return (i * ny + j) * nz + k; };
  for (int i = 0; i < nx; ++i) {
    for (int j = 0; j < ny; ++j) {
      for (int k = 0; k < nz; ++k) {
        add_particle(made, {(i + 0.5) * side, (j + 0.5) * side, (k + 0.5) * side}, half, mass, Phase::mastic);
        const auto join = [&](std::int32_t b, const Vec3d& n) {
          const bool wall = b < 0;
          add_square_contact(made.network, number(i, j, k), b, wall ? PairType::mw : PairType::mm, n, half,
                             wall ? 0 : half, side);
        };
        if (k == nz - 1) join(wall_z_hi, {0, 0, 1});
        if (k == 0) join(wall_z_lo, {0, 0, -1});
        if (k + 1 < nz) join(number(i, j, k + 1), {0, 0, 1});
        if (j + 1 < ny) join(number(i, j + 1, k), {0, 1, 0});
        if (i + 1 < nx) join(number(i + 1, j, k), {1, 0, 0});
      }
    }
  }
  fill_rows(made.network, made.specimen.size());
  return made;
}

}  // namespace macadam::test
