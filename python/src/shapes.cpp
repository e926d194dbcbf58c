// SPDX-License-Identifier: GPL-3.0-or-later
// shapes.cpp  Binds the functions on surfaces of aggregates: read, check, repair, measure, fill with spheres, generate.
#include <nanobind/stl/array.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "macadam/shape.hpp"
#include "python/src/arrays.hpp"
#include "python/src/bindings.hpp"
#include "python/src/calls.hpp"
#include "python/src/choices.hpp"
#include "python/src/given_arrays.hpp"

namespace macadam::python {
namespace {

/// Returns a surface of these points and facets. \throws InputError if a facet refers to a point that does not exist.
Surface surface_of(const std::string& name, const ArrayLike& points, const ArrayLike& facets) {
  Surface out{name, vectors(points, "points"), whole_triples(facets, "facets")};
  const auto n = static_cast<std::int64_t>(out.points.size());
  for (std::size_t i = 0; i < out.facets.size(); ++i) {
    for (const std::int32_t k : out.facets[i]) {
      if (k < 0 || k >= n)
        throw InputError(fmt::format("{}: facet {}: found point {}, expected one of 0 to {}", name, i, k, n - 1));
    }
  }
  return out;
}

/// Calls f without the interpreter's lock.
template <class F>
auto without_lock(F&& f) {
  const nb::gil_scoped_release release;
  return f();
}

void bind_surface(nb::module_& m) {
  nb::class_<Surface>(m, "Surface", "A triangulated surface [m].")
      .def(
          "__init__",
          [](Surface* self, const ArrayLike& points, const ArrayLike& facets, const std::string& name) {
            new (self) Surface(surface_of(name, points, facets));
          },
          nb::arg("points"), nb::arg("facets"), nb::arg("name") = "surface")
      .def_ro("name", &Surface::name)
      .def_ro("reading", &Surface::reading, "Changes made on reading, in words; empty if nothing was changed.")
      .def_prop_ro(
          "points", [](const Surface& s) { return view(s.points); }, "Points [m], (n, 3).")
      .def_prop_ro(
          "facets",
          [](const Surface& s) {
            return view(s.facets.empty() ? nullptr : s.facets.front().data(), {s.facets.size(), 3});
          },
          "Point numbers of each facet, counter-clockwise seen from outside, (n, 3).")
      .def("__repr__", [](const Surface& s) {
        return fmt::format("<macadam Surface {}: {} points, {} facets>", s.name, s.points.size(), s.facets.size());
      });
  nb::class_<SurfaceVerdict>(m, "Verdict",
                             "Faults of a surface: lists of facet numbers; only the first list has point numbers.")
      .def_prop_ro("good", &SurfaceVerdict::good, "True if the surface can be measured and filled.")
      .def_ro("stray", &SurfaceVerdict::stray)
      .def_ro("degenerate", &SurfaceVerdict::degenerate)
      .def_ro("non_manifold", &SurfaceVerdict::non_manifold)
      .def_ro("open", &SurfaceVerdict::open)
      .def_ro("misoriented", &SurfaceVerdict::misoriented)
      .def_ro("self_intersecting", &SurfaceVerdict::self_intersecting)
      .def_ro("pieces", &SurfaceVerdict::pieces)
      .def_ro("inner", &SurfaceVerdict::inner,
              "Number of pieces inside the piece of the largest volume (closed pores).")
      .def_ro("inside_out", &SurfaceVerdict::inside_out)
      .def("__bool__", &SurfaceVerdict::good)
      .def("__str__", &SurfaceVerdict::text);
  m.def("read_surface", &read_surface, nb::arg("file"), nb::arg("scale") = 1.0,
        "Reads STL, OFF, PLY or OBJ. scale: metres per unit of the file, 1e-3 for millimetres.");
  m.def("write_surface", &write_surface, nb::arg("file"), nb::arg("surface"), nb::arg("scale") = 1.0,
        "Writes .off, .stl, .ply or .obj. scale: metres per unit of the file.");
  m.def(
      "check_surface", [](const Surface& s) { return without_lock([&] { return check_surface(s); }); },
      nb::arg("surface"), "Checks a surface for all faults of a Verdict.");
  m.def(
      "repair_surface",
      [](const Surface& s, bool wrap) {
        SurfaceRepair repair;
        Surface out = without_lock([&] { return repair_surface(s, &repair, {}, wrap); });
        return nb::make_tuple(nb::cast(std::move(out)), repair.what + "; " + repair.changes());
      },
      nb::arg("surface"), nb::arg("wrap") = false, "Returns the repaired surface and a text about the changes.");
}

void bind_measures(nb::module_& m) {
  nb::class_<ShapeMeasure>(m, "ShapeMeasure", "Dimensions and indices of a shape (docs/shapes.md). Lengths in m.")
      .def_ro("points", &ShapeMeasure::points)
      .def_ro("facets", &ShapeMeasure::facets)
      .def_ro("d_long", &ShapeMeasure::d_long, "D^L [m].")
      .def_ro("d_intermediate", &ShapeMeasure::d_intermediate, "D^I [m], the size by which sieves separate.")
      .def_ro("d_short", &ShapeMeasure::d_short, "D^S [m].")
      .def_prop_ro("axis_long", [](const ShapeMeasure& s) { return triple(s.axis_long); })
      .def_prop_ro("axis_intermediate", [](const ShapeMeasure& s) { return triple(s.axis_intermediate); })
      .def_prop_ro("axis_short", [](const ShapeMeasure& s) { return triple(s.axis_short); })
      .def_ro("volume", &ShapeMeasure::volume, "Volume [m³].")
      .def_ro("area", &ShapeMeasure::area, "Area of the surface [m²].")
      .def_prop_ro(
          "centroid", [](const ShapeMeasure& s) { return triple(s.centroid); }, "Centroid of the volume [m].")
      .def_ro("radius_bounding", &ShapeMeasure::radius_bounding, "Radius of the smallest enclosing sphere [m].")
      .def_ro("sphericity_true", &ShapeMeasure::sphericity_true)
      .def_prop_ro("sphericity_working", &ShapeMeasure::sphericity_working)
      .def_prop_ro("shape_index", &ShapeMeasure::shape_index)
      .def_prop_ro("flatness", &ShapeMeasure::flatness)
      .def_prop_ro("elongation", &ShapeMeasure::elongation)
      .def_prop_ro("flakiness", &ShapeMeasure::flakiness);
  m.def("write_shape_tables", &write_shape_tables, nb::arg("out"), nb::arg("names"), nb::arg("measures"));
  m.def(
      "measure_shape", [](const Surface& s) { return without_lock([&] { return measure_shape(s); }); },
      nb::arg("surface"));
}

MultiSphere fill(const Surface& surface, double radius_min, double radius_max, double porosity, std::int64_t least,
                 const std::string& single, std::uint64_t seed) {
  FillSpec spec{radius_min,
                radius_max,
                in_range("porosity", porosity, -0.5, 1.0),
                in_range<std::int64_t>("least", least, 1, 1'000'000),
                SingleSphere::intermediate,
                seed};
  spec.single = choice<SingleSphere>("single", single,
                                     {{"intermediate", SingleSphere::intermediate},
                                      {"circumscribed", SingleSphere::circumscribed},
                                      {"volume", SingleSphere::volume}});
  return without_lock([&] { return fill_shape(surface, spec); });
}

void bind_filling(nb::module_& m) {
  const FillSpec usual;
  nb::class_<MultiSphere>(m, "Spheres", "Spheres that fill one aggregate.")
      .def("__len__", &MultiSphere::size)
      .def_prop_ro(
          "centre", [](const MultiSphere& s) { return view(s.centre); }, "Centres [m], (n, 3).")
      .def_prop_ro(
          "radius", [](const MultiSphere& s) { return view(s.radius); }, "Radii [m], (n,).");
  nb::class_<FillReport>(m, "FillReport", "Comparison of the filling spheres with their shape.")
      .def_ro("sphere_volume", &FillReport::sphere_volume, "Sum of the spheres' volumes [m³].")
      .def_ro("covered", &FillReport::covered, "Fraction of the shape's volume inside a sphere.")
      .def_ro("outside", &FillReport::outside, "Volume of the spheres outside the shape over the volume of the shape.")
      .def_ro("largest_overlap", &FillReport::largest_overlap,
              "Largest overlap of two spheres over the sum of their radii.")
      .def_ro("deviation_mean", &FillReport::deviation_mean, "Mean distance between the surfaces [m].")
      .def_ro("deviation_largest", &FillReport::deviation_largest, "Largest distance between the surfaces [m].")
      .def_ro("d_long", &FillReport::d_long, "D^L of the spheres together [m].")
      .def_ro("d_intermediate", &FillReport::d_intermediate, "D^I of the spheres together [m].")
      .def_ro("d_short", &FillReport::d_short, "D^S of the spheres together [m].");
  m.def("fill_shape", &fill, nb::arg("surface"), nb::arg("radius_min"), nb::arg("radius_max"),
        nb::arg("porosity") = usual.porosity, nb::arg("least") = usual.least, nb::arg("single") = "intermediate",
        nb::arg("seed") = usual.seed);
  m.def(
      "measure_fill",
      [](const Surface& s, const MultiSphere& c) { return without_lock([&] { return measure_fill(s, c); }); },
      nb::arg("surface"), nb::arg("spheres"), "Compares spheres with their shape.");
  m.def("scale_shape", &scale_to_radius, nb::arg("surface"), nb::arg("circumscribed"));
  m.def("write_filling", &write_filling, nb::arg("out"), nb::arg("surface"), nb::arg("spheres"));
  m.def("write_shape_library", &write_shape_library, nb::arg("out"), nb::arg("shapes"));
  m.def("surface_files_in", &surface_files_in, nb::arg("folder"));
  m.def("shape_library", &shape_library, "Returns the 82 aggregates that come with the program.");
  m.def(
      "generate_shape_library",
      [](std::uint64_t seed, int count) { return without_lock([&] { return generate_shape_library(seed, count); }); },
      nb::arg("seed") = 1, nb::arg("count") = 82, "Generates crushed aggregates with the statistics of the 82.");
  m.def("subdivided_icosahedron", &subdivided_icosahedron, nb::arg("radius") = 1.0,
        "Returns the subdivided icosahedron (42 points, 80 facets) of a radius [m].");
}

}  // namespace

void bind_shapes(nb::module_& m) {
  bind_surface(m);
  bind_measures(m);
  bind_filling(m);
}

}  // namespace macadam::python
