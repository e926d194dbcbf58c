// SPDX-License-Identifier: GPL-3.0-or-later
// states.cpp  Binds the states that a stepper returns: of walls, of particles and of contacts.
#include <fmt/format.h>
#include <nanobind/stl/string.h>

#include "macadam/stepper.hpp"
#include "python/src/arrays.hpp"
#include "python/src/bindings.hpp"

namespace macadam::python {
namespace {

View<double> of_walls(const std::array<Vec3d, wall_count>& a) { return view(&a.front().x, {a.size(), 3}); }

}  // namespace

void bind_states(nb::module_& m) {
  nb::class_<Observation>(m, "Observation", "What is measured at a whole step.")
      .def("__repr__",
           [](const Observation& o) {
             return fmt::format("<macadam.Observation: step {}, {:.6g} s, top wall {:.6g} m, {:.6g} N>", o.step, o.time,
                                o.top_displacement(), o.top_force());
           })
      .def_ro("step", &Observation::step)
      .def_ro("time", &Observation::time, "[s]")
      .def_prop_ro(
          "wall_displacement", [](const Observation& o) { return of_walls(o.wall_displacement); },
          "Of -x +x -y +y -z +z [m], (6, 3).")
      .def_prop_ro(
          "wall_velocity", [](const Observation& o) { return of_walls(o.wall_velocity); },
          "Likewise, at the last half step [m/s], (6, 3).")
      .def_prop_ro(
          "wall_force", [](const Observation& o) { return of_walls(o.wall_force); },
          "On the walls by the particles [N], (6, 3).")
      .def_prop_ro("top_displacement", &Observation::top_displacement, "Of the top wall along z [m].")
      .def_prop_ro("top_force", &Observation::top_force, "On the top wall along z [N].");
  nb::class_<ParticleState>(m, "ParticleState", "Motion of all particles, in the specimen's order.")
      .def_prop_ro(
          "displacement", [](const ParticleState& s) { return view(s.displacement); }, "Since the start [m], (n, 3).")
      .def_prop_ro(
          "rotation", [](const ParticleState& s) { return view(s.rotation); }, "Since the start [rad], (n, 3).")
      .def_prop_ro(
          "velocity", [](const ParticleState& s) { return view(s.velocity); }, "At the last half step [m/s], (n, 3).")
      .def_prop_ro(
          "spin", [](const ParticleState& s) { return view(s.spin); }, "At the last half step [rad/s], (n, 3).")
      .def_prop_ro(
          "force", [](const ParticleState& s) { return view(s.force); }, "Of contacts and body forces [N], (n, 3).")
      .def_prop_ro(
          "moment", [](const ParticleState& s) { return view(s.moment); }, "About the centre [N m], (n, 3).");
  nb::class_<ContactState>(m, "ContactState", "Forces and deformation of all contacts, in the network's order.")
      .def_prop_ro(
          "force", [](const ContactState& s) { return view(s.force); },
          "On the first body, at the facet's centroid [N], (n, 3).")
      .def_prop_ro(
          "moment", [](const ContactState& s) { return view(s.moment); }, "Likewise, about that point [N m], (n, 3).")
      .def_prop_ro(
          "relative",
          [](const ContactState& s) {
            return view(s.relative.empty() ? nullptr : s.relative.front().data(), {s.relative.size(), 6});
          },
          "Opening [m], its slopes along s and t, slips along s and t [m], twist, (n, 6).")
      .def_prop_ro(
          "chain", [](const ContactState& s) { return view(s.chain); }, "States of the laws, contact by contact.")
      .def_prop_ro(
          "chain_begin", [](const ContactState& s) { return view(s.chain_begin); },
          "Where each contact's states begin, and the end.")
      .def_prop_ro(
          "broken", [](const ContactState& s) { return view(s.broken); },
          "Fraction of each contact's points that are broken, (n,); empty where no law can break.")
      .def_prop_ro(
          "point_breaks",
          [](const ContactState& s) {
            return view(reinterpret_cast<const std::uint8_t*>(s.point_breaks.data()), {s.point_breaks.size()});
          },
          "How each contact point broke, contact by contact: 0 intact, 1 in tension, 2 in shear; empty where no law "
          "can "
          "break.");
}

}  // namespace macadam::python
