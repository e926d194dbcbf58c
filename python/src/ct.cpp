// SPDX-License-Identifier: GPL-3.0-or-later
// ct.cpp  Binds `macadam ct …` (images of computed tomography). Without ITK in the build, it binds nothing.
#include <nanobind/stl/array.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "python/src/arrays.hpp"
#include "python/src/bindings.hpp"
#include "python/src/calls.hpp"
#include "python/src/choices.hpp"
#ifdef MACADAM_CT

#include "macadam/ct.hpp"
#include "macadam/lengths.hpp"
#include "macadam/phantom.hpp"
#include "macadam/thread_limit.hpp"
#include "macadam/twin.hpp"
#endif

namespace macadam::python {

#ifndef MACADAM_CT
void bind_ct(nb::module_&) {}
#else
namespace {

using Path = std::filesystem::path;
using Text = std::optional<std::string>;

/// Returns the image's voxels as a view of shape (z, y, x).
template <class T>
View<T> voxels(const Image<T>& image) {
  const auto n = [&](int axis) { return static_cast<std::size_t>(image.size[static_cast<std::size_t>(axis)]); };
  return view(image.voxels.data(), {n(2), n(1), n(0)});
}

/// Segments a scan and writes the files into `out`. Lengths are texts with a unit, as in the command's options.
std::shared_ptr<Segmentation> segment(const Path& images, const Path& out, const std::vector<std::string>& voxel,
                                      const std::string& dataset, const std::string& region, bool slices, bool rings,
                                      bool hardening, const std::string& denoise, std::optional<double> air_voids,
                                      std::optional<double> aggregate, const std::string& memory, const Text& smallest,
                                      const std::optional<Path>& gradation, const std::optional<Path>& cuts,
                                      const std::string& recipe, int facets, std::optional<int> threads,
                                      nb::object progress) {
  SegmentOptions options;
  options.slices = slices, options.rings = rings, options.hardening = hardening;
  options.denoising = choice<Denoising>(
      "denoise", denoise,
      {{"diffusion", Denoising::diffusion}, {"median", Denoising::median}, {"none", Denoising::none}});
  options.recipe =
      choice<SegmentRecipe>("recipe", recipe, {{"own", SegmentRecipe::own}, {"paper", SegmentRecipe::paper}});
  options.air_voids = in_range("air_voids", air_voids, 0.0, 0.5);
  options.aggregate = in_range("aggregate", aggregate, 0.05, 0.95);
  options.facets = in_range("facets", facets, 100, 10'000);
  if (smallest) options.smallest = length_of(*smallest, "--smallest");
  if (cuts) options.cuts = ct::read_cuts(*cuts);
  if (gradation) options.gradation = ct::read_gradation(*gradation);
  const ThreadLimit limit(in_range("threads", threads, 1, 1024));
  ct::read_region(region, options);
  ScanFile scan{images, dataset, {}};
  if (!voxel.empty()) scan.spacing = lengths_of(voxel, "--voxel");
  const double bytes = ct::memory_of(memory);
  LongCall call(std::move(progress));
  options.progress = call.progress_function();
  return call([&] {
    auto found = std::make_shared<Segmentation>(segment_file(scan, options, bytes));
    ct::write_segmentation(out, *found, options);
    return found;
  });
}

nb::list grains_of(const std::vector<ScannedGrain>& grains) {
  nb::list out;
  for (const ScannedGrain& g : grains) {
    nb::dict one;
    one["id"] = g.id;
    one["sieve"] = g.sieve;
    one["volume"] = g.measure.volume;
    one["d_long"] = g.measure.d_long;
    one["d_intermediate"] = g.measure.d_intermediate;
    one["d_short"] = g.measure.d_short;
    one["border"] = g.border;
    one["confidence"] = g.confidence;
    one["surface_error"] = g.surface_error;
    out.append(one);
  }
  return out;
}

/// Size of a synthetic scan (voxels along x, y, z), number of grains, and volume fractions of the scan.
struct PhantomNumbers {
  std::array<std::int64_t, 3> size{};
  std::size_t grains = 0;
  double aggregate = 0, mastic = 0, voids = 0;
};

/// Makes a synthetic scan of the scene's specimen and writes it into `out`.
PhantomNumbers phantom(const GivenScene& scene, const std::string& voxel, const Path& out, std::uint64_t seed,
                       const std::string& shape, const std::string& sawn, const std::string& air, int samples,
                       double blur, double noise, double cupping, double rings, double drift, double grey_air,
                       double grey_mastic, double grey_aggregate, nb::object progress) {
  PhantomSpec spec;
  spec.voxel = length_of(voxel, "--voxel");
  spec.seed = seed;
  spec.shape = choice<CoreShape>("shape", shape, {{"prism", CoreShape::prism}, {"cylinder", CoreShape::cylinder}});
  spec.sawn = length_of(sawn, "--sawn");
  spec.air = length_of(air, "--air");
  spec.samples = in_range("samples", samples, 1, 16);
  spec.blur = in_range("blur", blur, 0.0, 10.0);
  spec.noise = in_range("noise", noise, 0.0, 1.0);
  spec.cupping = in_range("cupping", cupping, 0.0, 1.0);
  spec.rings = in_range("rings", rings, 0.0, 1.0);
  spec.drift = in_range("drift", drift, 0.0, 1.0);
  spec.grey_air = in_range("grey_air", grey_air, 0.0, 65535.0);
  spec.grey_mastic = in_range("grey_mastic", grey_mastic, 0.0, 65535.0);
  spec.grey_aggregate = in_range("grey_aggregate", grey_aggregate, 0.0, 65535.0);
  LongCall call(std::move(progress));
  const GivenScene copy = scene;  // another Python thread may change the caller's scene
  return call([&] {
    const Phantom made = make_phantom(copy, spec, call.progress_function());
    write_phantom(out, made, copy, spec);
    return PhantomNumbers{made.scan.size, made.grains.size(), made.aggregate, made.mastic, made.voids};
  });
}

/// Makes a specimen from the segmented scan in `folder` and writes it into `out`. box: either empty or six lengths: x,
/// y, z of the lowest corner, then of the highest corner.
Twin twin(const Path& folder, const GivenScene& scene, const Path& out, const std::vector<std::string>& box,
          std::optional<double> porosity, const std::string& least_void, std::uint64_t seed, nb::object progress) {
  TwinSpec spec;
  spec.porosity = in_range("porosity", porosity, -1.0, 1.0);
  spec.least_void = length_of(least_void, "--least-void");
  spec.seed = seed;
  if (!box.empty()) {
    if (box.size() != 6)
      throw InputError("box: found " + std::to_string(box.size()) + " lengths, expected six: two corners");
    const auto at = [&](std::size_t i) { return length_of(box[i], "--box"); };
    spec.box = {Vec3d{at(0), at(1), at(2)}, Vec3d{at(3), at(4), at(5)}};
  }
  LongCall call(std::move(progress));
  const GivenScene copy = scene;  // another Python thread may change the caller's scene
  return call([&] {
    Twin made = make_twin(folder, copy, spec, call.progress_function());
    write_twin(out, made, copy);
    return made;
  });
}

void bind_segmentation(nb::module_& m) {
  nb::class_<Segmentation>(m, "Segmentation", "Result of a segmentation. Images are views, (z, y, x).")
      .def_prop_ro(
          "phases", [](const Segmentation& s) { return voxels(s.phases); },
          "Phase of each voxel: 0 air void, 1 mastic, 2 aggregate, 255 outside.")
      .def_prop_ro(
          "labels", [](const Segmentation& s) { return voxels(s.labels); },
          "Number of the grain of each voxel; 0: no grain.")
      .def_prop_ro(
          "confidence", [](const Segmentation& s) { return voxels(s.confidence); },
          "Confidence in the phase of each voxel, 0 to 255.")
      .def_prop_ro(
          "grey", [](const Segmentation& s) { return voxels(s.grey); }, "The corrected scan.")
      .def_prop_ro(
          "spacing", [](const Segmentation& s) { return triple(s.labels.spacing); },
          "Edges of a voxel along x, y, z [m].")
      .def_prop_ro(
          "origin", [](const Segmentation& s) { return triple(s.labels.origin); },
          "Coordinates of the first voxel's centre [m].")
      .def_prop_ro(
          "grains", [](const Segmentation& s) { return grains_of(s.grains); }, "Grains, one dictionary each; SI units.")
      .def(
          "surface",
          [](const Segmentation& s, std::int64_t i) -> const Surface& {
            if (i < 0 || i >= std::ssize(s.grains))
              throw nb::index_error(
                  ("grain: found " + std::to_string(i) + ", expected a number below " + std::to_string(s.grains.size()))
                      .c_str());
            return s.grains[static_cast<std::size_t>(i)].surface;
          },
          nb::rv_policy::reference_internal, nb::arg("grain"),
          "Returns the surface of the grain with this index in `grains`.")
      .def_ro("air_voids", &Segmentation::air_voids, "Fraction of the specimen's volume.")
      .def_ro("mastic", &Segmentation::mastic, "Fraction of the specimen's volume.")
      .def_ro("aggregate", &Segmentation::aggregate, "Fraction of the specimen's volume.")
      .def_ro("in_no_grain", &Segmentation::in_no_grain, "Fraction of the aggregate's volume that belongs to no grain.")
      .def_ro("confidence_mean", &Segmentation::confidence_mean, "Mean confidence of the specimen's voxels, 0 to 1.")
      .def_ro("block", &Segmentation::block, "Edge of a voxel of these images in voxels of the scan.")
      .def_ro("warnings", &Segmentation::warnings);
  m.def("segment", &segment, nb::arg("images"), nb::arg("out"), nb::arg("voxel"), nb::arg("dataset"), nb::arg("region"),
        nb::arg("slices"), nb::arg("rings"), nb::arg("hardening"), nb::arg("denoise"), nb::arg("air_voids").none(),
        nb::arg("aggregate").none(), nb::arg("memory"), nb::arg("smallest").none(), nb::arg("gradation").none(),
        nb::arg("cuts").none(), nb::arg("recipe"), nb::arg("facets"), nb::arg("threads").none(),
        nb::arg("progress").none());
}

}  // namespace

void bind_ct(nb::module_& m) {
  bind_segmentation(m);
  nb::class_<PhantomNumbers>(m, "Phantom", "A synthetic scan; aggregate, mastic and voids are fractions of its volume.")
      .def_ro("size", &PhantomNumbers::size, "Number of voxels along x, y, z.")
      .def_ro("grains", &PhantomNumbers::grains)
      .def_ro("aggregate", &PhantomNumbers::aggregate)
      .def_ro("mastic", &PhantomNumbers::mastic)
      .def_ro("voids", &PhantomNumbers::voids);
  const PhantomSpec usual;
  m.def("phantom", &phantom, nb::arg("scene"), nb::arg("voxel"), nb::arg("out"), nb::kw_only(),
        nb::arg("seed") = usual.seed, nb::arg("shape") = "prism", nb::arg("sawn") = "0", nb::arg("air") = "1 mm",
        nb::arg("samples") = usual.samples, nb::arg("blur") = usual.blur, nb::arg("noise") = usual.noise,
        nb::arg("cupping") = usual.cupping, nb::arg("rings") = usual.rings, nb::arg("drift") = usual.drift,
        nb::arg("grey_air") = usual.grey_air, nb::arg("grey_mastic") = usual.grey_mastic,
        nb::arg("grey_aggregate") = usual.grey_aggregate, nb::arg("progress") = nb::none());
  nb::class_<Twin>(m, "Twin", "A specimen made from a scan; aggregate, mastic and voids are fractions of the box.")
      .def_prop_ro("particles", [](const Twin& t) { return t.specimen.size(); })
      .def_prop_ro(
          "box", [](const Twin& t) { return triple(t.specimen.box.size); }, "Edge lengths of the box [m].")
      .def_prop_ro(
          "corner", [](const Twin& t) { return triple(t.corner); },
          "Lowest corner of the box in the scan's coordinates [m].")
      .def_ro("grains", &Twin::grains, "Number of grains that are in the box at least in part.")
      .def_ro("clusters", &Twin::clusters, "Number of grains that became several spheres.")
      .def_ro("lost", &Twin::lost, "Number of grains of which too little is in the box for a sphere.")
      .def_ro("aggregate", &Twin::aggregate)
      .def_ro("mastic", &Twin::mastic)
      .def_ro("voids", &Twin::voids)
      .def_ro("voids_left_out", &Twin::voids_left_out);
  m.def("twin", &twin, nb::arg("folder"), nb::arg("scene"), nb::arg("out"), nb::kw_only(), nb::arg("box"),
        nb::arg("porosity") = nb::none(), nb::arg("least_void") = "0", nb::arg("seed") = TwinSpec{}.seed,
        nb::arg("progress") = nb::none());
}
#endif

}  // namespace macadam::python
