// SPDX-License-Identifier: GPL-3.0-or-later
// fields.cpp  Writes files for viewers that contain arrays of the caller: a single file, or a series of files, one for
// each time.
#include "python/src/fields.hpp"

#include <fmt/format.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>

#include <mutex>

#include "python/src/given_arrays.hpp"

namespace macadam::python {
namespace {

using Path = std::filesystem::path;

/// The mesh of a file for viewers, and the number of rows of its arrays.
struct MeshRows {
  FieldMesh mesh;
  std::size_t rows = 0;
};

/// Returns the mesh of "particles", "contacts" or "cells"; one row per particle, contact or polygon.
MeshRows mesh_of(const Prepared& p, const std::string& what) {
  const Preparation& made = p.made;
  if (what == "particles") return {particle_mesh(made.specimen, made.aggregates), made.specimen.size()};
  if (what == "contacts") return {contact_mesh(made.specimen, made.network), made.network.contacts.size()};
  if (what == "cells") {
    FieldMesh mesh = cell_mesh(made.specimen, made.tessellation, made.aggregates);
    const std::size_t polygons = mesh.cell_count();
    return {std::move(mesh), polygons};
  }
  throw InputError("what: found \"" + what + "\", expected particles, contacts or cells");
}

FieldFormat format_of(const Path& file) {
  const Path ending = file.extension();
  if (ending == ".vtkhdf") return FieldFormat::vtkhdf;
  if (ending == ".vtp") return FieldFormat::vtp;
  throw InputError(file.string(), 0, "ending of the file", ending.string(),
                   ".vtkhdf or .vtp; .csv for particles and contacts without arrays");
}
/// Returns the path without its ending.
Path stem_of(const Path& file) { return file.parent_path() / file.stem(); }

/// Returns the arrays that the caller gives by name. Each array has `rows` rows of one number or several. Integers
/// become int32, other numbers float32. The arrays have no unit, because viewers show only the name.
std::vector<FieldArray> arrays_of(const nb::dict& given, std::size_t rows) {
  std::vector<FieldArray> out;
  for (const auto& [key, value] : given) {
    const std::string name = nb::cast<std::string>(key);
    const nb::object array =
        number_array(value, "arrays: " + name, fmt::format("numbers of shape ({0},) or ({0}, columns)", rows));
    const bool is_whole = nb::cast<std::string>(array.attr("dtype").attr("kind")) != "f";
    const auto fill = [&]<class T>(T) {
      nb::ndarray<const T, nb::c_contig, nb::device::cpu> in;
      const auto numbers = array.attr("astype")(is_whole ? "int32" : "float32", "C", is_whole ? "same_kind" : "unsafe");
      if (!nb::try_cast(numbers, in) || in.ndim() < 1 || in.ndim() > 2 || in.shape(0) != rows) {
        throw InputError(fmt::format("arrays: {0}: found shape {1}, expected ({2},) or ({2}, columns)", name,
                                     nb::repr(array.attr("shape")).c_str(), rows));
      }
      const int components = in.ndim() == 2 ? static_cast<int>(in.shape(1)) : 1;
      out.push_back({name, "", components, std::vector<T>(in.data(), in.data() + in.size())});
    };
    if (is_whole) {
      fill(std::int32_t{});
    } else {
      fill(float{});
    }
  }
  return out;
}

/// A file for viewers to which frames in time are added. Several threads may add frames; one writes at a time.
class Series {
 public:
  Series(const Prepared& p, const Path& file, const std::string& what) : name_(file.filename().string()), what_(what) {
    MeshRows of = mesh_of(p, what);
    rows_ = of.rows;
    file_ = begin_fields(stem_of(file), format_of(file), std::move(of.mesh));
  }
  void add(double time, const nb::dict& arrays) {
    const auto values = arrays_of(arrays, rows_);
    const nb::gil_scoped_release release;
    const std::scoped_lock one_at_a_time(busy_);
    file_->add(time, values);
  }
  std::size_t size() const { return file_->size(); }
  std::string text() const {
    const auto rows = what_ == "cells" ? "polygons of cells" : what_;
    return fmt::format("<macadam.FieldSeries {}: {} frames of {} {}>", name_, size(), rows_, rows);
  }

 private:
  std::unique_ptr<FieldSeries> file_;
  std::string name_, what_;
  std::size_t rows_ = 0;
  std::mutex busy_;
};

}  // namespace

nb::ndarray<nb::numpy, float> stress_of(const Preparation& made, const ContactState& state) {
  FieldArray stress = stress_array(made.tessellation, made.network, state);
  return owned(std::move(std::get<std::vector<float>>(stress.values)), {made.specimen.size(), 6});
}

void write_specimen(const Prepared& p, const Path& file, const std::string& what, const nb::dict& arrays) {
  if (file.extension() == ".csv" && arrays.size() == 0) {
    const nb::gil_scoped_release release;
    if (what == "particles") return write_specimen_csv(file, p.made.specimen);
    if (what == "contacts") return write_contacts_csv(file, p.made.network);
  }
  const FieldFormat format = format_of(file);
  MeshRows of = mesh_of(p, what);
  auto values = arrays_of(arrays, of.rows);
  const nb::gil_scoped_release release;
  write_fields(stem_of(file), format, std::move(of.mesh), std::move(values));
}

void bind_fields(nb::module_& m) {
  nb::class_<Series>(m, "FieldSeries",
                     "A file for viewers to which frames in time are added. It is complete after each frame.")
      .def(
          "__init__",
          [](Series* self, const PreparedPointer& specimen, const Path& file, const std::string& what) {
            new (self) Series(*specimen, file, what);
          },
          nb::arg("specimen"), nb::arg("file"), nb::arg("what") = "particles",
          "file: .vtkhdf, or .vtp (one file per frame and a list of them). what: particles, contacts or cells.")
      .def("add", &Series::add, nb::arg("time"), nb::arg("arrays"),
           "Adds a frame at a time [s]. arrays: arrays by name with one row per particle, contact or polygon. All "
           "frames "
           "need the same arrays as the first one.")
      .def("__len__", &Series::size, "Number of frames in the file.")
      .def("__repr__", &Series::text);
}

}  // namespace macadam::python
