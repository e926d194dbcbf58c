// SPDX-License-Identifier: GPL-3.0-or-later
// contacts.cpp  Binds the contact network. Its arrays are views of the library's memory.
#include "macadam/contact_network.hpp"

#include <fmt/format.h>
#include <nanobind/stl/string.h>

#include "python/src/arrays.hpp"
#include "python/src/bindings.hpp"

namespace macadam::python {

void bind_contacts(nb::module_& m) {
  const auto moments = [](const ContactNetwork& n) {
    static_assert(sizeof(AreaMoments) == 6 * sizeof(double));
    const auto stride = static_cast<std::int64_t>(sizeof(Contact) / sizeof(double));
    return view(n.contacts.empty() ? nullptr : &n.contacts.front().moments.a, {n.contacts.size(), 6}, {stride, 1});
  };
  nb::class_<ContactNetwork>(
      m, "Contacts", "The contacts of a specimen, in order of (a, b). Arrays are views with one entry per contact.")
      .def("__len__", [](const ContactNetwork& n) { return n.contacts.size(); })
      .def("__repr__",
           [](const ContactNetwork& n) {
             std::string out = fmt::format("<macadam.Contacts: {}", n.contacts.size());
             const char* before = ": ";
             for (std::size_t pair = 0; pair < n.count.size(); ++pair) {
               if (n.count[pair] == 0) continue;
               out += fmt::format("{}{} {}", before, n.count[pair], to_string(static_cast<PairType>(pair)));
               before = ", ";
             }
             return out + ">";
           })
      .def_prop_ro(
          "a",
          [](const ContactNetwork& n) {
            return member<std::int32_t>(n.contacts, [](const Contact& c) { return &c.a; });
          },
          "Number of the first particle, (n,).")
      .def_prop_ro(
          "b",
          [](const ContactNetwork& n) {
            return member<std::int32_t>(n.contacts, [](const Contact& c) { return &c.b; });
          },
          "Number of the second particle, or of a wall: -1 to -6 for -x +x -y +y -z +z, (n,).")
      .def_prop_ro(
          "pair",
          [](const ContactNetwork& n) {
            return member<std::uint8_t>(
                n.contacts, [](const Contact& c) { return reinterpret_cast<const std::uint8_t*>(&c.pair); });
          },
          "Index into `pair_names`, (n,).")
      .def_prop_ro(
          "area",
          [](const ContactNetwork& n) { return member<double>(n.contacts, [](const Contact& c) { return &c.area; }); },
          "Area [m²], (n,).")
      .def_prop_ro(
          "distance",
          [](const ContactNetwork& n) {
            return member<double>(n.contacts, [](const Contact& c) { return &c.distance; });
          },
          "Distance between the centres, or from a centre to the wall [m], (n,).")
      .def_prop_ro(
          "normal",
          [](const ContactNetwork& n) {
            return member3(n.contacts, [](const Contact& c) -> const Vec3d& { return c.n; });
          },
          "Unit vector from a to b, (n, 3).")
      .def_prop_ro(
          "s",
          [](const ContactNetwork& n) {
            return member3(n.contacts, [](const Contact& c) -> const Vec3d& { return c.s; });
          },
          "First unit vector in the facet, (n, 3).")
      .def_prop_ro(
          "t",
          [](const ContactNetwork& n) {
            return member3(n.contacts, [](const Contact& c) -> const Vec3d& { return c.t; });
          },
          "Second unit vector in the facet, s × t = normal, (n, 3).")
      .def_prop_ro(
          "arm_a",
          [](const ContactNetwork& n) { return member<double>(n.contacts, [](const Contact& c) { return &c.arm_a; }); },
          "Distance from the centre of a to the facet along the normal [m], (n,).")
      .def_prop_ro(
          "arm_b",
          [](const ContactNetwork& n) { return member<double>(n.contacts, [](const Contact& c) { return &c.arm_b; }); },
          "Distance from the facet to the centre of b along the normal [m], (n,); 0 at a wall.")
      .def_prop_ro("moments", moments, "Integrals of 1, s, t, s², s·t and t² over the facet [m² to m⁴], (n, 6).")
      .def_prop_ro(
          "point_begin",
          [](const ContactNetwork& n) {
            return member<std::uint32_t>(n.contacts, [](const Contact& c) { return &c.point_begin; });
          },
          "Index of the first contact point, (n,).")
      .def_prop_ro(
          "point_end",
          [](const ContactNetwork& n) {
            return member<std::uint32_t>(n.contacts, [](const Contact& c) { return &c.point_end; });
          },
          "Index after the last contact point, (n,).")
      .def_prop_ro(
          "point_s", [](const ContactNetwork& n) { return view(n.point_s); },
          "Coordinate along s of each contact point [m], (points,).")
      .def_prop_ro(
          "point_t", [](const ContactNetwork& n) { return view(n.point_t); },
          "Coordinate along t of each contact point [m], (points,).")
      .def_prop_ro(
          "point_area", [](const ContactNetwork& n) { return view(n.point_area); },
          "Area of each contact point [m²], (points,).")
      .def_prop_ro(
          "dropped", [](const ContactNetwork& n) { return nb::make_tuple(n.dropped_gap, n.dropped_area); },
          "Numbers of facets that gap_max and area_min excluded: (gap, area).")
      .def_prop_ro(
          "notches",
          [](const ContactNetwork& n) {
            nb::list out;
            for (const NotchCut& cut : n.notches) {
              nb::dict one;
              one["axis"] = std::string(1, "xyz"[cut.notch.axis]);
              one["at"] = cut.notch.position;
              one["removed"] = cut.removed, one["shortened"] = cut.shortened;
              one["cut_area"] = cut.cut_area, one["ligament"] = cut.ligament;
              out.append(one);
            }
            return out;
          },
          "The effect of each notch: axis, at [m], numbers of removed and shortened contacts, cut_area and ligament "
          "[m²].")
      .def_prop_ro(
          "count",
          [](const ContactNetwork& n) {
            nb::dict out;
            for (int pair = 0; pair < pair_types; ++pair) {
              const auto i = static_cast<std::size_t>(pair);
              if (n.count[i] > 0) out[to_string(static_cast<PairType>(pair))] = n.count[i];
            }
            return out;
          },
          "Number of contacts by pair.");
  nb::list names;
  for (int pair = 0; pair < pair_types; ++pair) names.append(to_string(static_cast<PairType>(pair)));
  m.attr("pair_names") = nb::tuple(names);
}

}  // namespace macadam::python
