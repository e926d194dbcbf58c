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

/// Returns i as an index into `polygons`. \throws IndexError of Python if i is out of range.
template <class Polygons>
std::size_t index_of(std::int64_t i, const Polygons& polygons) {
  if (i < 0 || i >= std::ssize(polygons))
    throw nb::index_error(
        fmt::format("polygon: found {}, expected a number from 0 to {}", i, std::ssize(polygons) - 1).c_str());
  return static_cast<std::size_t>(i);
}

}  // namespace

void bind_cells(nb::module_& m) {
  nb::class_<Tessellation>(
      m, "Cells", "The Laguerre cells inside the box. The numbers -1 to -6 denote the walls -x +x -y +y -z +z.")
      .def("__len__", [](const Tessellation& t) { return t.facets.size(); })
      .def("__repr__",
           [](const Tessellation& t) {
             return fmt::format("<macadam.Cells: {} cells, {} facets>", t.cell_volume.size(), t.facets.size());
           })
      .def_prop_ro(
          "volume", [](const Tessellation& t) { return view(t.cell_volume); },
          "Volumes of the cells of all particles, followed by the cells of all voids [m³], (n,).")
      .def_prop_ro(
          "a",
          [](const Tessellation& t) { return member<std::int32_t>(t.facets, [](const Facet& f) { return &f.a; }); },
          "Number of the first particle of each facet, (n,).")
      .def_prop_ro(
          "b",
          [](const Tessellation& t) { return member<std::int32_t>(t.facets, [](const Facet& f) { return &f.b; }); },
          "Number of the second particle or of the wall of each facet, (n,).")
      .def_prop_ro(
          "area",
          [](const Tessellation& t) { return member<double>(t.facets, [](const Facet& f) { return &f.area; }); },
          "Area of each facet [m²], (n,).")
      .def_prop_ro(
          "centroid",
          [](const Tessellation& t) {
            return member3(t.facets, [](const Facet& f) -> const Vec3d& { return f.centroid; });
          },
          "Area centroid of each facet [m], (n, 3).")
      .def_prop_ro(
          "normal",
          [](const Tessellation& t) {
            return member3(t.facets, [](const Facet& f) -> const Vec3d& { return f.normal; });
          },
          "Unit normal of each facet from a to b, (n, 3).")
      .def(
          "polygon",
          [](const Tessellation& t, std::int64_t i) { return polygon(t.polygon(t.facets[index_of(i, t.facets)])); },
          nb::rv_policy::reference_internal, nb::arg("facet"), "Vertices of a facet [m], (n, 3).");
  nb::class_<CrossSection>(m, "Section", "The cells cut by a plane: polygons without gap or overlap.")
      .def("__len__", [](const CrossSection& s) { return s.cells.size(); })
      .def("__repr__",
           [](const CrossSection& s) {
             return fmt::format("<macadam.Section {} = {:.6g} m: {} polygons>", s.plane.axis, s.plane.position,
                                s.cells.size());
           })
      .def_prop_ro("axis", [](const CrossSection& s) { return std::string(1, s.plane.axis); })
      .def_prop_ro(
          "position", [](const CrossSection& s) { return s.plane.position; }, "Coordinate of the plane [m].")
      .def_prop_ro(
          "particle",
          [](const CrossSection& s) {
            return member<std::int32_t>(s.cells, [](const SectionCell& c) { return &c.particle; });
          },
          "Number of the particle of each polygon, (n,). Voids are numbered after the particles.")
      .def_prop_ro(
          "area",
          [](const CrossSection& s) { return member<double>(s.cells, [](const SectionCell& c) { return &c.area; }); },
          "Area of each polygon [m²], (n,).")
      .def(
          "polygon",
          [](const CrossSection& s, std::int64_t i) { return polygon(s.polygon(s.cells[index_of(i, s.cells)])); },
          nb::rv_policy::reference_internal, nb::arg("cell"), "Vertices of a polygon [m], (n, 3).");
}

}  // namespace macadam::python
