// SPDX-License-Identifier: GPL-3.0-or-later
// scene.cpp  Binds scenes, which are read from a file or a text, and the options that replace values of a scene.
#include "macadam/scene.hpp"

#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include "python/src/bindings.hpp"
#include "python/src/arrays.hpp"
#include "python/src/choices.hpp"
#include "python/src/pickles.hpp"

namespace macadam::python {
namespace {

using Text = std::optional<std::string>;

/// Returns the options that were given, by the names of the command's options.
nb::dict options_of(const Overrides& given) {
  nb::dict out;
  if (given.seed) out["seed"] = *given.seed;
  const auto name = [&](const char* key, const auto& value, const auto& choices) {
    for (const auto& [text, meaning] : choices)
      if (value == meaning) out[key] = text;
  };
  name("backend", given.backend, backends);
  name("precision", given.precision, precisions);
  name("method", given.method, methods);
  name("linear", given.linear, linear_methods);
  if (given.threads) out["threads"] = *given.threads;
  if (given.devices) out["device"] = nb::cast(*given.devices);
  return out;
}

/// Applies the given options to the scene and remembers them; options given earlier stay unless given again.
void override_options(GivenScene& scene, std::optional<std::uint64_t> seed, const Text& backend, const Text& precision,
                      const Text& method, const Text& linear, std::optional<int> threads, const Devices& device) {
  const Overrides now{seed,
                      choice("backend", backend, backends),
                      choice("precision", precision, precisions),
                      choice("method", method, methods),
                      choice("linear", linear, linear_methods),
                      in_range("threads", threads, 1, 1024),
                      devices_of(device)};
  apply(now, scene);
  Overrides& all = scene.instead;
  const auto replace = [](auto& to, const auto& from) {
    if (from) to = from;
  };
  replace(all.seed, now.seed), replace(all.backend, now.backend), replace(all.precision, now.precision);
  replace(all.method, now.method), replace(all.linear, now.linear), replace(all.threads, now.threads);
  replace(all.devices, now.devices);
}

/// Returns volumes, masses and densities of the scene's mix design and the sieves at which its gradation is outside the
/// envelope, or None if the scene has no recipe.
nb::object recipe_of(const GivenScene& scene) {
  if (!scene.recipe) return nb::none();
  const MixVolumes v = volumes_of(*scene.recipe);
  nb::dict out;
  for (const auto& [name, value] :
       std::initializer_list<std::pair<const char*, double>>{{"maximum_density", v.maximum_density},
                                                             {"bulk_density", v.bulk_density},
                                                             {"air_voids", v.air_voids},
                                                             {"vma", v.vma},
                                                             {"vfb", v.vfb},
                                                             {"binder", v.binder},
                                                             {"effective_binder", v.effective_binder},
                                                             {"absorbed_binder", v.absorbed_binder},
                                                             {"aggregate_mass", v.aggregate_mass},
                                                             {"aggregate_volume", v.aggregate_volume},
                                                             {"aggregate_density", v.aggregate_density},
                                                             {"mastic_mass", v.mastic_mass},
                                                             {"mastic_volume", v.mastic_volume},
                                                             {"mastic_density", v.mastic_density},
                                                             {"mastic_fine_mass", v.mastic_fine_mass},
                                                             {"mastic_filler_mass", v.mastic_filler_mass},
                                                             {"mastic_binder_mass", v.mastic_binder_mass}})
    out[name] = value;
  nb::list outside;
  for (const SievePassing& s : outside_of_envelope(*scene.recipe)) outside.append(nb::make_tuple(s.size, s.passing));
  out["outside_of_envelope"] = outside;
  return out;
}

/// Returns the list of experiments: kind, whether the experiment can be solved by time steps, and names of the result
/// files.
nb::list list_experiments() {
  nb::list out;
  for (const Experiment& experiment : all_experiments()) {
    nb::dict one;
    one["kind"] = kind_of(experiment);
    one["can_be_stepped"] = stepping_of(experiment) != experiments::Stepping::never;
    one["files"] = nb::cast(files_of(experiment));
    out.append(one);
  }
  return out;
}

}  // namespace

void bind_scene(nb::module_& m) {
  m.def("experiments", &list_experiments,
        "Returns all kinds of experiments, one dictionary each: kind, can_be_stepped, files (names of the result files "
        "that a run may write).");
  nb::class_<GivenScene> c(m, "Scene", "A scene that was read and checked.");
  pickle_scenes(c);
  c.def(
       "__init__",
       [](GivenScene* self, const std::filesystem::path& file, const Text& text, bool lines) {
         new (self) GivenScene{text ? read_scene(file, *text, lines) : read_scene(file)};
       },
       nb::arg("file"), nb::arg("text") = nb::none(), nb::arg("lines") = true)
      .def("__init__", [](GivenScene* self, const GivenScene& other) { new (self) GivenScene(other); })
      .def_static(
          "read_text", [](const std::filesystem::path& file) { return read_scene_text(file); }, nb::arg("file"),
          "Returns the text of a file, checked to be TOML.")
      .def("override", &override_options, nb::kw_only(), nb::arg("seed") = nb::none(), nb::arg("backend") = nb::none(),
           nb::arg("precision") = nb::none(), nb::arg("method") = nb::none(), nb::arg("linear") = nb::none(),
           nb::arg("threads") = nb::none(), nb::arg("device") = nb::none(),
           "Replaces values of the scene, as the command's options of these names do.")
      .def_prop_ro(
          "options", [](const GivenScene& s) { return options_of(s.instead); },
          "Options that replace values of the scene.")
      .def_prop_ro(
          "file", [](const GivenScene& s) { return s.file; }, "File that the scene was read from.")
      .def_prop_ro(
          "text", [](const GivenScene& s) { return s.text; }, "Text of the scene, TOML.")
      .def_prop_ro(
          "kind", [](const GivenScene& s) { return kind_of(s.experiment); }, "Kind of the test in `[loading]`.")
      .def_prop_ro(
          "method", [](const GivenScene& s) { return to_string(s.solver.method); },
          "Method: explicit, harmonic or quasi_static.")
      .def_prop_ro(
          "backend", [](const GivenScene& s) { return to_string(s.solver.backend); }, "Requested backend.")
      .def_prop_ro(
          "seed", [](const GivenScene& s) { return s.specimen.seed; }, "Seed of a generated specimen.")
      .def_prop_ro(
          "box", [](const GivenScene& s) { return triple(s.specimen.box.size); },
          "Edge lengths of the bounding box [m].")
      .def_prop_ro(
          "domain", [](const GivenScene& s) { return s.specimen.box.name(); },
          "Shape of the specimen, such as box or cylinder.")
      .def_prop_ro(
          "recipe", &recipe_of,
          "Properties of a recipe by mass, or None: densities [kg/m³]; air voids, VMA, VFB, binder contents, and the "
          "fractions of aggregate and mastic by mass and by volume, all from 0 to 1.")
      .def_prop_ro(
          "frequencies", [](const GivenScene& s) { return frequencies_of(s.experiment); },
          "Frequencies of the test [Hz].")
      .def_prop_ro(
          "temperatures", [](const GivenScene& s) { return temperatures_of(s.experiment); },
          "Temperatures of the test [°C].");
}

}  // namespace macadam::python
