// SPDX-License-Identifier: GPL-3.0-or-later
// specimen.cpp  Binds specimens: makes one from a scene or from given particles. Its arrays are views of the library's
// memory.
#include "macadam/specimen.hpp"

#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/function.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "macadam/macadam.hpp"
#include "macadam/tessellation.hpp"
#include "python/src/arrays.hpp"
#include "python/src/bindings.hpp"
#include "python/src/calls.hpp"
#include "python/src/choices.hpp"
#include "python/src/fields.hpp"
#include "python/src/given_arrays.hpp"
#include "python/src/pickles.hpp"

namespace macadam::python {
namespace {

/// Returns a specimen of these particles. Without `phase` all are mastic; without `body` none belongs to an aggregate.
/// `domain` is the domain of the scene, whose shape is kept. \throws InputError for arrays of wrong shape or of unequal
/// lengths.
Specimen particles_of(const Domain& domain, const ArrayLike& box, const ArrayLike& centre, const ArrayLike& radius,
                      const std::optional<ArrayLike>& phase, const std::optional<ArrayLike>& body) {
  Specimen out;
  const std::vector<double> edges = numbers(box, "particles: box", 3);
  out.box = {{edges[0], edges[1], edges[2]}, domain.shape};
  out.centre = vectors(centre, "particles: centre");
  out.radius = numbers(radius, "particles: radius");
  const std::size_t n = out.radius.size();
  out.body = body ? whole_numbers(*body, "particles: body") : std::vector<std::int32_t>(n, -1);
  const auto phases = phase ? whole_numbers(*phase, "particles: phase") : std::vector<std::int32_t>(n, 1);
  if (out.radius.size() != out.size() || phases.size() != out.size() || out.body.size() != out.size()) {
    throw InputError(
        fmt::format("particles: found {} centres, {} radii, {} phases and {} bodies, expected the same number of each",
                    out.size(), n, phases.size(), out.body.size()));
  }
  for (const std::int32_t one : phases) {
    if (one != 0 && one != 1) {
      throw InputError(fmt::format("particles: particle {}: phase: found {}, expected 0 (aggregate) or 1 (mastic)",
                                   out.phase.size(), one));
    }
    out.phase.push_back(static_cast<Phase>(one));
  }
  return out;
}

/// Returns a copy of the scene. If its mastic is the specimen of another scene, computes the law of the mastic.
std::shared_ptr<const GivenScene> with_mastic_law(const GivenScene& scene, LongCall& call) {
  auto out = std::make_shared<GivenScene>(scene);
  Watcher watcher;
  watcher.progress = call.progress_function();
  compute_mastic_law(*out, watcher);
  return out;
}

PreparedPointer prepare_scene(const GivenScene& scene, nb::object progress) {
  LongCall call(std::move(progress));
  return call([&] {
    const auto copy = with_mastic_law(scene, call);
    Preparation made = prepare(*copy, call.progress_function());
    return std::make_shared<Prepared>(Prepared{copy, std::move(made)});
  });
}

PreparedPointer prepare_particles(const GivenScene& scene, const ArrayLike& box, const ArrayLike& centre,
                                  const ArrayLike& radius, const std::optional<ArrayLike>& phase,
                                  const std::optional<ArrayLike>& body) {
  Specimen specimen = particles_of(scene.specimen.box, box, centre, radius, phase, body);
  LongCall call;
  return call([&] {
    const auto copy = with_mastic_law(scene, call);
    Preparation made = prepare(*copy, std::move(specimen), call.progress_function());
    return std::make_shared<Prepared>(Prepared{copy, std::move(made)});
  });
}

PreparedPointer prepare_to_folder(const GivenScene& scene, const std::filesystem::path& out,
                                  const std::vector<std::string>& sections, nb::object progress) {
  LongCall call(std::move(progress));
  return call([&] {
    const auto copy = with_mastic_law(scene, call);
    std::vector<SectionPlane> planes;
    for (const std::string& text : sections) planes.push_back(read_section_plane(text, scene.specimen.box));
    Preparation made = prepare_into(out, *copy, planes, call.progress_function());
    return std::make_shared<Prepared>(Prepared{copy, std::move(made)});
  });
}

nb::dict fractions_of(const Preparation& p) {
  nb::dict out;
  for (const CompositionRow& row : p.composition) {
    nb::dict one;
    one["count_asked"] = row.count_asked;
    one["count"] = row.count;
    one["fraction_asked"] = row.fraction_asked;
    one["fraction"] = row.fraction;
    out[row.name.c_str()] = one;
  }
  return out;
}

nb::list aggregates_of(const Preparation& p) {
  nb::list out;
  for (const Aggregate& a : p.aggregates) {
    nb::dict one;
    one["body"] = a.body;
    one["class"] = p.composition[static_cast<std::size_t>(a.size_class)].name;
    one["shape"] = a.shape;
    one["size"] = a.size;
    one["d_long"] = a.d_long;
    one["d_short"] = a.d_short;
    one["volume"] = a.volume;
    one["spheres"] = a.spheres;
    one["x"] = a.centre.x;
    one["y"] = a.centre.y;
    one["z"] = a.centre.z;
    out.append(one);
  }
  return out;
}

nb::list gradation_rows(const Prepared& p) {
  nb::list out;
  if (!p.scene->recipe) return out;
  for (const GradationRow& row : gradation_of(*p.scene->recipe, p.made.composition)) {
    nb::dict one;
    one["sieve"] = row.size;
    one["asked"] = row.asked;
    one["reached"] = row.reached;
    out.append(one);
  }
  return out;
}

void bind_particles(nb::class_<Prepared>& c) {
  c.def("__len__", [](const Prepared& p) { return p.made.specimen.size(); })
      .def_prop_ro(
          "box", [](const Prepared& p) { return triple(p.made.specimen.box.size); },
          "Edge lengths of the bounding box [m].")
      .def_prop_ro(
          "domain", [](const Prepared& p) { return p.made.specimen.box.name(); }, "Shape, such as box or cylinder.")
      .def_prop_ro(
          "volume", [](const Prepared& p) { return p.made.specimen.box.volume(); }, "Volume of the domain [m³].")
      .def_prop_ro(
          "section_area", [](const Prepared& p) { return section_area(p.made.specimen); },
          "Area of the section perpendicular to the load [m²].")
      .def_prop_ro(
          "centre", [](const Prepared& p) { return view(p.made.specimen.centre); },
          "Centres of the particles [m], (n, 3).")
      .def_prop_ro(
          "radius", [](const Prepared& p) { return view(p.made.specimen.radius); }, "Radii of the particles [m], (n,).")
      .def_prop_ro(
          "phase",
          [](const Prepared& p) {
            const auto& phase = p.made.specimen.phase;
            return view(reinterpret_cast<const std::uint8_t*>(phase.data()), {phase.size()});
          },
          "Phase of each particle, (n,): 0 aggregate, 1 mastic.")
      .def_prop_ro(
          "body", [](const Prepared& p) { return view(p.made.specimen.body); },
          "Number of the aggregate of each particle, (n,); -1 for mastic.")
      .def_prop_ro(
          "void_centre",
          [](const Prepared& p) {
            return member3(p.made.specimen.voids, [](const VoidSphere& v) -> const Vec3d& { return v.centre; });
          },
          "Centres of the voids [m], (n, 3). Voids are not particles.")
      .def_prop_ro(
          "void_radius",
          [](const Prepared& p) {
            return member<double>(p.made.specimen.voids, [](const VoidSphere& v) { return &v.radius; });
          },
          "Radii of the voids [m], (n,).");
}

}  // namespace

void bind_specimen(nb::module_& m) {
  nb::class_<Prepared> c(m, "Specimen",
                         "Particles, cells and contacts of a scene. Arrays are views of the library's own memory: they "
                         "cannot be written to, and keep the specimen alive.");
  bind_particles(c);
  pickle_specimens(c);
  c.def("__repr__", [](const Prepared& p) {
    const Vec3d mm = 1e3 * p.made.specimen.box.size;
    return fmt::format("<macadam.Specimen: {} particles, {} contacts, {} {:.6g} × {:.6g} × {:.6g} mm>",
                       p.made.specimen.size(), p.made.network.contacts.size(), p.made.specimen.box.name(), mm.x, mm.y,
                       mm.z);
  });
  c.def_prop_ro("scene", [](const Prepared& p) { return *p.scene; })
      .def_prop_ro(
          "cells", [](const Prepared& p) -> const Tessellation& { return p.made.tessellation; },
          nb::rv_policy::reference_internal, "The Laguerre cells.")
      .def_prop_ro(
          "contacts", [](const Prepared& p) -> const ContactNetwork& { return p.made.network; },
          nb::rv_policy::reference_internal, "The contact network.")
      .def_prop_ro(
          "composition", [](const Prepared& p) { return fractions_of(p.made); },
          "Requested and reached composition of a generated specimen, by class: number, and volume over the volume of "
          "the "
          "box.")
      .def_prop_ro(
          "aggregates", [](const Prepared& p) { return aggregates_of(p.made); },
          "Aggregates of a generated specimen; SI units.")
      .def_prop_ro(
          "gradation", &gradation_rows,
          "Gradation of a recipe by mass: sieves [m] and fractions of the aggregate's mass that pass, requested and "
          "reached.")
      .def_prop_ro(
          "loose_particles", [](const Prepared& p) { return p.made.loose_particles; },
          "Number of particles that are not connected to both walls and carry no load.")
      .def_prop_ro(
          "spanning_clusters", [](const Prepared& p) { return p.made.spanning_clusters; },
          "Number of clusters of particles that touch both walls; usually 1.")
      .def_prop_ro(
          "warnings", [](const Prepared& p) { return packing_warnings(p.made.specimen, p.made.tessellation); },
          "Warnings about spheres that do not fill the box, or fill more than the box.")
      .def_prop_ro(
          "relaxation_iterations", [](const Prepared& p) { return p.made.relaxation_iterations; },
          "Number of iterations of the generator.")
      .def_prop_ro(
          "seconds",
          [](const Prepared& p) {
            return nb::make_tuple(p.made.seconds_specimen, p.made.seconds_tessellation, p.made.seconds_network);
          },
          "Wall times of making particles, cells and contacts [s].")
      .def("write", &write_specimen, nb::arg("file"), nb::arg("what") = "particles", nb::arg("arrays") = nb::dict(),
           "Writes particles, contacts or cells for viewers (.vtkhdf, .vtp); particles or contacts also as .csv. "
           "arrays: "
           "additional arrays for viewers, by name, with one row per particle, contact or polygon.")
      .def(
          "plot",
          [](const nb::object& self, const std::optional<std::string>& what) {
            return nb::borrow<nb::any>(nb::module_::import_("macadam._plot").attr("plot_specimen")(self, what));
          },
          nb::arg("what") = nb::none(),
          "Returns a matplotlib figure, which a notebook shows. what: \"block\" (the default), \"section\" or "
          "\"aggregates\"; \"3d\" shows the particles with PyVista in a window or in the notebook.")
      .def(
          "section",
          [](const Prepared& p, const std::string& plane) {
            return cut(p.made.specimen, p.made.tessellation, read_section_plane(plane, p.made.specimen.box));
          },
          nb::arg("plane"), "Returns the cells cut by a plane: \"x=0.025\" (metres), \"z=40 mm\".")
      .def(
          "inertia",
          [](const Prepared& p) {
            Inertia i = make_inertia(p.made.specimen, p.scene->materials.aggregate, p.scene->materials.mastic);
            return nb::make_tuple(owned(std::move(i.mass)), owned(std::move(i.inertia)));
          },
          "Returns masses [kg] and moments of inertia [kg m²] of the particles, (n,) each.");
  m.attr("given_particles") = given_particles;
  m.def("prepare", &prepare_scene, nb::arg("scene"), nb::arg("progress") = nb::none());
  m.def("prepare_particles", &prepare_particles, nb::arg("scene"), nb::arg("box"), nb::arg("centre"), nb::arg("radius"),
        nb::arg("phase"), nb::arg("body"));
  m.def("prepare_into", &prepare_to_folder, nb::arg("scene"), nb::arg("out"), nb::arg("sections"),
        nb::arg("progress") = nb::none());
}

}  // namespace macadam::python
