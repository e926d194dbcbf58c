// SPDX-License-Identifier: GPL-3.0-or-later
// cells.cpp  Binds the Laguerre cells, and the polygons that a plane cuts from them.
#include <fmt/format.h>
#include <nanobind/stl/string.h>

#include "macadam/cross_section.hpp"
#include "macadam/tessellation.hpp"
#include "python/src/arrays.hpp"
#include "python/src/bindings.hpp"

namespace macadam::python {
namespace {

/// Returns the vertices of one polygon as a view of shape (n, 3).
View<double> polygon(std::span<const Vec3d> vertices) {
  return view(reinterpret_cast<const double*>(vertices.data()), {vertices.size(), 3});
}

/// Returns i as an index into `of`. \throws IndexError of Python if there is no such entry.
template <class Of>
std::size_t index_of(std::int64_t i, const Of& of) {
  if (i < 0 || i >= std::ssize(of)) throw nb::index_error("no polygon of this number");
  return static_cast<std::size_t>(i);
}

}  // namespace

void bind_cells(nb::module_& m) {
  nb::class_<Tessellation>(
      m, "Cells", "The Laguerre cells inside the box. Walls stand for particles as -1 to -6: -x +x -y +y -z +z.")
      .def("__len__", [](const Tessellation& t) { return t.facets.size(); })
      .def("__repr__",
           [](const Tessellation& t) {
             return fmt::format("<macadam.Cells: {} cells, {} facets>", t.cell_volume.size(), t.facets.size());
           })
      .def_prop_ro(
          "volume", [](const Tessellation& t) { return view(t.cell_volume); },
          "Of the particles' cells, then of the voids' [m³].")
      .def_prop_ro(
          "a",
          [](const Tessellation& t) { return member<std::int32_t>(t.facets, [](const Facet& f) { return &f.a; }); },
          "Of each facet: its particle.")
      .def_prop_ro(
          "b",
          [](const Tessellation& t) { return member<std::int32_t>(t.facets, [](const Facet& f) { return &f.b; }); },
          "Of each facet: the other particle, or the wall.")
      .def_prop_ro(
          "area",
          [](const Tessellation& t) { return member<double>(t.facets, [](const Facet& f) { return &f.area; }); },
          "Of each facet [m²].")
      .def_prop_ro(
          "centroid",
          [](const Tessellation& t) {
            return member3(t.facets, [](const Facet& f) -> const Vec3d& { return f.centroid; });
          },
          "Of each facet [m], (n, 3).")
      .def_prop_ro(
          "normal",
          [](const Tessellation& t) {
            return member3(t.facets, [](const Facet& f) -> const Vec3d& { return f.normal; });
          },
          "Of each facet, from a to b, (n, 3).")
      .def(
          "polygon",
          [](const Tessellation& t, std::int64_t i) { return polygon(t.polygon(t.facets[index_of(i, t.facets)])); },
          nb::rv_policy::reference_internal, nb::arg("facet"), "Its vertices [m], (n, 3).");
  nb::class_<CrossSection>(m, "Section", "The cells that a plane cuts: polygons without gap or overlap.")
      .def("__len__", [](const CrossSection& s) { return s.cells.size(); })
      .def("__repr__",
           [](const CrossSection& s) {
             return fmt::format("<macadam.Section {} = {:.6g} m: {} polygons>", s.plane.axis, s.plane.position,
                                s.cells.size());
           })
      .def_prop_ro("axis", [](const CrossSection& s) { return std::string(1, s.plane.axis); })
      .def_prop_ro(
          "position", [](const CrossSection& s) { return s.plane.position; }, "[m]")
      .def_prop_ro(
          "particle",
          [](const CrossSection& s) {
            return member<std::int32_t>(s.cells, [](const SectionCell& c) { return &c.particle; });
          },
          "Of each polygon; from the number of particles on: voids.")
      .def_prop_ro(
          "area",
          [](const CrossSection& s) { return member<double>(s.cells, [](const SectionCell& c) { return &c.area; }); },
          "Of each polygon [m²].")
      .def(
          "polygon",
          [](const CrossSection& s, std::int64_t i) { return polygon(s.polygon(s.cells[index_of(i, s.cells)])); },
          nb::rv_policy::reference_internal, nb::arg("cell"), "Its vertices [m], (n, 3).");
}

}  // namespace macadam::python
