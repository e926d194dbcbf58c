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

#include "host/tessellation/packing_check.hpp"
#include "host/scene/given_particles.hpp"
#include "macadam/macadam.hpp"
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
/// \throws InputError for arrays of wrong shape or of unequal lengths.
Specimen particles_of(const ArrayLike& box, const ArrayLike& centre, const ArrayLike& radius,
                      const std::optional<ArrayLike>& phase, const std::optional<ArrayLike>& body) {
  Specimen out;
  const std::vector<double> edges = numbers(box, "particles: box", 3);
  out.box.size = {edges[0], edges[1], edges[2]};
  out.centre = vectors(centre, "particles: centre");
  out.radius = numbers(radius, "particles: radius");
  const std::size_t n = out.radius.size();
  out.body = body ? whole_numbers(*body, "particles: body") : std::vector<std::int32_t>(n, -1);
  const auto phases = phase ? whole_numbers(*phase, "particles: phase") : std::vector<std::int32_t>(n, 1);
  if (out.radius.size() != out.size() || phases.size() != out.size() || out.body.size() != out.size()) {
    throw InputError(
        fmt::format("particles: found {} centres, {} radii, {} phases and {} bodies, expected as many of each",
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

PreparedPointer prepare_scene(const GivenScene& scene, nb::object progress) {
  LongCall call(std::move(progress));
  return call([&] {
    auto kept = std::make_shared<const GivenScene>(scene);
    Preparation made = prepare(*kept, call.progress_function());
    return std::make_shared<Prepared>(Prepared{std::move(kept), std::move(made)});
  });
}

PreparedPointer prepare_particles(const GivenScene& scene, const ArrayLike& box, const ArrayLike& centre,
                                  const ArrayLike& radius, const std::optional<ArrayLike>& phase,
                                  const std::optional<ArrayLike>& body) {
  Specimen specimen = particles_of(box, centre, radius, phase, body);
  LongCall call;
  return call([&] {
    auto kept = std::make_shared<const GivenScene>(scene);
    Preparation made = prepare(*kept, std::move(specimen), call.progress_function());
    return std::make_shared<Prepared>(Prepared{std::move(kept), std::move(made)});
  });
}

PreparedPointer prepare_to_folder(const GivenScene& scene, const std::filesystem::path& out,
                                  const std::vector<std::string>& sections, nb::object progress) {
  LongCall call(std::move(progress));
  return call([&] {
    auto kept = std::make_shared<const GivenScene>(scene);
    std::vector<SectionPlane> planes;
    for (const std::string& text : sections) planes.push_back(read_section_plane(text, scene.specimen.box));
    Preparation made = prepare_into(out, *kept, planes, call.progress_function());
    return std::make_shared<Prepared>(Prepared{std::move(kept), std::move(made)});
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
          "box", [](const Prepared& p) { return triple(p.made.specimen.box.size); }, "Edge lengths [m].")
      .def_prop_ro(
          "centre", [](const Prepared& p) { return view(p.made.specimen.centre); }, "Of each particle [m], (n, 3).")
      .def_prop_ro(
          "radius", [](const Prepared& p) { return view(p.made.specimen.radius); }, "Of each particle [m].")
      .def_prop_ro(
          "phase",
          [](const Prepared& p) {
            const auto& phase = p.made.specimen.phase;
            return view(reinterpret_cast<const std::uint8_t*>(phase.data()), {phase.size()});
          },
          "Of each particle: 0 aggregate, 1 mastic.")
      .def_prop_ro(
          "body", [](const Prepared& p) { return view(p.made.specimen.body); },
          "Number of the aggregate that each particle belongs to, -1 for mastic.")
      .def_prop_ro(
          "void_centre",
          [](const Prepared& p) {
            return member3(p.made.specimen.voids, [](const VoidSphere& v) -> const Vec3d& { return v.centre; });
          },
          "Of each void [m], (n, 3). Voids are no particles.")
      .def_prop_ro(
          "void_radius",
          [](const Prepared& p) {
            return member<double>(p.made.specimen.voids, [](const VoidSphere& v) { return &v.radius; });
          },
          "Of each void [m].");
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
    return fmt::format("<macadam.Specimen: {} particles, {} contacts, box {:.6g} × {:.6g} × {:.6g} mm>",
                       p.made.specimen.size(), p.made.network.contacts.size(), mm.x, mm.y, mm.z);
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
          "By class: counts, and volumes over that of the box, asked and reached; of a generated specimen.")
      .def_prop_ro(
          "aggregates", [](const Prepared& p) { return aggregates_of(p.made); }, "Of a generated specimen; SI units.")
      .def_prop_ro("gradation", &gradation_rows,
                   "Of a recipe by mass: sieves [m] with shares of the aggregate's mass that pass.")
      .def_prop_ro(
          "loose_particles", [](const Prepared& p) { return p.made.loose_particles; },
          "Not joined to both walls: they carry nothing.")
      .def_prop_ro(
          "spanning_clusters", [](const Prepared& p) { return p.made.spanning_clusters; },
          "Clusters of particles that touch both walls; one, usually.")
      .def_prop_ro(
          "warnings", [](const Prepared& p) { return packing_warnings(p.made.specimen, p.made.tessellation); },
          "Sentences on a packing that does not fill its box, or fills more than it.")
      .def_prop_ro(
          "relaxation_iterations", [](const Prepared& p) { return p.made.relaxation_iterations; },
          "Of a generated specimen.")
      .def_prop_ro(
          "seconds",
          [](const Prepared& p) {
            return nb::make_tuple(p.made.seconds_specimen, p.made.seconds_tessellation, p.made.seconds_network);
          },
          "What the making of particles, cells and contacts took [s].")
      .def(
          "write", &write_specimen, nb::arg("file"), nb::arg("what") = "particles", nb::arg("arrays") = nb::dict(),
          "Writes particles, contacts or cells for viewers (.vtkhdf, .vtp), or the first two as .csv. arrays: more for "
          "viewers, by name, a row a particle, a contact or a polygon.")
      .def(
          "section",
          [](const Prepared& p, const std::string& plane) {
            return cut(p.made.specimen, p.made.tessellation, read_section_plane(plane, p.made.specimen.box));
          },
          nb::arg("plane"), "The cells cut by a plane: \"x=0.025\" (metres), \"z=40 mm\".")
      .def(
          "inertia",
          [](const Prepared& p) {
            Inertia i = make_inertia(p.made.specimen, p.scene->materials.aggregate, p.scene->materials.mastic);
            return nb::make_tuple(owned(std::move(i.mass)), owned(std::move(i.inertia)));
          },
          "Masses [kg] and moments of inertia [kg m²] of the particles.");
  m.attr("given_particles") = scene::given_particles;
  m.def("prepare", &prepare_scene, nb::arg("scene"), nb::arg("progress") = nb::none());
  m.def("prepare_particles", &prepare_particles, nb::arg("scene"), nb::arg("box"), nb::arg("centre"), nb::arg("radius"),
        nb::arg("phase"), nb::arg("body"));
  m.def("prepare_into", &prepare_to_folder, nb::arg("scene"), nb::arg("out"), nb::arg("sections"),
        nb::arg("progress") = nb::none());
}

}  // namespace macadam::python
