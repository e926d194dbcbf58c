// SPDX-License-Identifier: GPL-3.0-or-later
// states.cpp  Binds the states of walls, particles and contacts that a stepper returns.
#include <fmt/format.h>
#include <nanobind/stl/string.h>

#include <algorithm>
#include <vector>

#include "macadam/stepper.hpp"
#include "python/src/arrays.hpp"
#include "python/src/bindings.hpp"

namespace macadam::python {
namespace {

/// Returns the length of the longest of these vectors; 0 if there are none.
double longest(const std::vector<Vec3d>& vectors) {
  double out = 0;
  for (const Vec3d& v : vectors) out = std::max(out, norm(v));
  return out;
}

View<double> of_walls(const std::array<Vec3d, wall_count>& a) { return view(&a.front().x, {a.size(), 3}); }

}  // namespace

void bind_states(nb::module_& m) {
  nb::class_<Observation>(m, "Observation", "Displacements and forces of the walls at a whole step.")
      .def("__repr__",
           [](const Observation& o) {
             return fmt::format("<macadam.Observation: step {}, {:.6g} s, top wall {:.6g} m, {:.6g} N>", o.step, o.time,
                                o.top_displacement(), o.top_force());
           })
      .def_ro("step", &Observation::step)
      .def_ro("time", &Observation::time, "Time [s].")
      .def_prop_ro(
          "wall_displacement", [](const Observation& o) { return of_walls(o.wall_displacement); },
          "Displacements of the walls -x +x -y +y -z +z [m], (6, 3).")
      .def_prop_ro(
          "wall_velocity", [](const Observation& o) { return of_walls(o.wall_velocity); },
          "Velocities of the walls at the last half step [m/s], (6, 3).")
      .def_prop_ro(
          "wall_force", [](const Observation& o) { return of_walls(o.wall_force); },
          "Forces of the particles on the walls [N], (6, 3).")
      .def_prop_ro("top_displacement", &Observation::top_displacement, "Displacement of the top wall along z [m].")
      .def_prop_ro("top_force", &Observation::top_force, "Force on the top wall along z [N].");
  nb::class_<ParticleState>(m, "ParticleState", "Motion of all particles, in the specimen's order.")
      .def("__len__", [](const ParticleState& s) { return s.displacement.size(); })
      .def("__repr__",
           [](const ParticleState& s) {
             return fmt::format(
                 "<macadam.ParticleState: {} particles, displacement up to {:.4g} m, velocity up to {:.4g} m/s>",
                 s.displacement.size(), longest(s.displacement), longest(s.velocity));
           })
      .def_prop_ro(
          "displacement", [](const ParticleState& s) { return view(s.displacement); },
          "Displacement since the start [m], (n, 3).")
      .def_prop_ro(
          "rotation", [](const ParticleState& s) { return view(s.rotation); },
          "Rotation since the start [rad], (n, 3).")
      .def_prop_ro(
          "velocity", [](const ParticleState& s) { return view(s.velocity); },
          "Velocity at the last half step [m/s], (n, 3).")
      .def_prop_ro(
          "spin", [](const ParticleState& s) { return view(s.spin); },
          "Angular velocity at the last half step [rad/s], (n, 3).")
      .def_prop_ro(
          "force", [](const ParticleState& s) { return view(s.force); },
          "Sum of contact forces and body force [N], (n, 3).")
      .def_prop_ro(
          "moment", [](const ParticleState& s) { return view(s.moment); },
          "Sum of moments about the centre [N m], (n, 3).");
  nb::class_<ContactState>(m, "ContactState", "Forces and deformation of all contacts, in the network's order.")
      .def("__len__", [](const ContactState& s) { return s.force.size(); })
      .def("__repr__",
           [](const ContactState& s) {
             return fmt::format("<macadam.ContactState: {} contacts, force up to {:.4g} N>", s.force.size(),
                                longest(s.force));
           })
      .def_prop_ro(
          "force", [](const ContactState& s) { return view(s.force); },
          "Force on the first particle at the facet's centroid [N], (n, 3).")
      .def_prop_ro(
          "moment", [](const ContactState& s) { return view(s.moment); },
          "Moment on the first particle about the facet's centroid [N m], (n, 3).")
      .def_prop_ro(
          "relative",
          [](const ContactState& s) {
            return view(s.relative.empty() ? nullptr : s.relative.front().data(), {s.relative.size(), 6});
          },
          "Relative motion of the two particles, (n, 6): opening [m], slopes of the opening along s and t, slips along "
          "s and t "
          "[m], twist [rad].")
      .def_prop_ro(
          "chain", [](const ContactState& s) { return view(s.chain); },
          "States of the laws of all contacts, one contact after the other.")
      .def_prop_ro(
          "chain_begin", [](const ContactState& s) { return view(s.chain_begin); },
          "Index of each contact's first state in `chain`, and the number of states, (n + 1,).")
      .def_prop_ro(
          "broken", [](const ContactState& s) { return view(s.broken); },
          "Fraction of each contact's points that are broken, (n,); empty if no law can break.")
      .def_prop_ro(
          "point_breaks",
          [](const ContactState& s) {
            return view(reinterpret_cast<const std::uint8_t*>(s.point_breaks.data()), {s.point_breaks.size()});
          },
          "State of each contact point, one contact after the other: 0 intact, 1 broken in tension, 2 broken in shear; "
          "empty if no law can break.")
      .def_prop_ro(
          "point_cracks",
          [](const ContactState& s) {
            static_assert(sizeof(laws::PointCrack) == 5 * sizeof(double), "a row of the array is one PointCrack");
            return view(s.point_cracks.empty() ? nullptr : &s.point_cracks.front().opening, {s.point_cracks.size(), 5});
          },
          "Crack of each contact point, one contact after the other, (points, 5): opening and slip [m], damage from 0 "
          "to "
          "1, crack energy and work of friction per area [J/m²]; empty if no law has a crack.");
}

}  // namespace macadam::python
