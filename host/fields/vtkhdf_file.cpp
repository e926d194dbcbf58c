// SPDX-License-Identifier: GPL-3.0-or-later
// vtkhdf_file.cpp  Writes VTKHDF 2.0. Groups and arrays have the names in VTK's documentation of the format.
#include "host/fields/vtkhdf_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/fields/open_hdf5.hpp"
#include "host/files/hdf5_type.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

/// Shape of a row of an array: {} if a row is a single number, {n} if it has n numbers.
using Row = std::vector<hsize_t>;

/// Makes an array that has no rows yet and can grow. `piece` rows are stored together in the file. The rows are
/// compressed if `packed` is true.
H5::DataSet make_growing(const H5::Group& group, const std::string& name, const H5::DataType& type, const Row& row,
                         hsize_t piece, bool packed = false) {
  std::vector<hsize_t> size{0}, most{H5S_UNLIMITED}, chunk{std::max<hsize_t>(1, piece)};
  for (auto* list : {&size, &most, &chunk}) list->insert(list->end(), row.begin(), row.end());
  H5::DSetCreatPropList properties;
  properties.setChunk(static_cast<int>(chunk.size()), chunk.data());
  if (packed) properties.setShuffle(), properties.setDeflate(1);
  return group.createDataSet(name, type, H5::DataSpace(static_cast<int>(size.size()), size.data(), most.data()),
                             properties);
}

/// Replaces the rows of an array from row `from` on by `rows` other rows.
template <class T>
void put_rows(H5::DataSet& set, hsize_t from, hsize_t rows, const T* values) {
  const int rank = set.getSpace().getSimpleExtentNdims();
  std::vector<hsize_t> size(static_cast<std::size_t>(rank)), start(size.size(), 0);
  set.getSpace().getSimpleExtentDims(size.data());
  size[0] = from + rows;
  set.extend(size.data());
  if (rows == 0) return;
  start[0] = from, size[0] = rows;
  H5::DataSpace place = set.getSpace();
  place.selectHyperslab(H5S_SELECT_SET, size.data(), start.data());
  set.write(values, type_of(T()), H5::DataSpace(rank, size.data()), place);
}

/// Writes an array that does not change. Whole numbers are compressed to a fraction of their size; other numbers hardly
/// shrink and are not compressed.
template <class T>
void put(const H5::Group& group, const std::string& name, const std::vector<T>& values, const Row& row = {}) {
  const hsize_t rows = values.size() / (row.empty() ? 1 : row.front());
  constexpr hsize_t few = 64, piece = 1 << 18;
  if (std::is_integral_v<T> && rows > few) {
    H5::DataSet set = make_growing(group, name, type_of(T()), row, std::min(rows, piece), true);
    put_rows(set, 0, rows, values.data());
  } else {
    const hsize_t size[2] = {rows, row.empty() ? 1 : row.front()};
    const H5::DataSpace all(row.empty() ? 1 : 2, size);
    const H5::DataSet set = group.createDataSet(name, type_of(T()), all);
    if (rows > 0) set.write(values.data(), type_of(T()));
  }
}

void put_text(const H5::H5Object& object, const char* name, const std::string& text) {
  const H5::StrType type(H5::PredType::C_S1, std::max<std::size_t>(1, text.size()));
  object.createAttribute(name, type, H5::DataSpace()).write(type, text);
}

Row row_of(const FieldArray& array) {
  return array.components == 1 ? Row{} : Row{static_cast<hsize_t>(array.components)};
}

template <class F>
auto visit_values(const FieldArray& array, F&& f) {
  return std::visit(std::forward<F>(f), array.values);
}

std::size_t bytes_of(const std::vector<FieldArray>& arrays) {
  std::size_t out = 0;
  for (const FieldArray& a : arrays) out += visit_values(a, [](const auto& v) { return v.size() * sizeof(v[0]); });
  return out;
}

std::size_t bytes_of(const FieldMesh& mesh) {
  return bytes_of(mesh.arrays) + mesh.points.size() * sizeof(float) +
         (mesh.connectivity.size() + mesh.offsets.size()) * sizeof(std::int64_t);
}

const char* data_of(const FieldMesh& mesh) {
  return mesh.shape == FieldMesh::Shape::vertices ? "PointData" : "CellData";
}

/// Returns the number of rows of each array of the mesh.
std::size_t rows_of(const FieldMesh& mesh) {
  return mesh.shape == FieldMesh::Shape::vertices ? mesh.point_count() : mesh.cell_count();
}

/// Writes everything of a file except the times.
void put_mesh(H5::H5File& file, const FieldMesh& mesh) {
  const H5::Group root = file.createGroup("VTKHDF");
  const hsize_t two = 2;
  const std::int64_t version[2] = {2, 0};
  root.createAttribute("Version", type_of(version[0]), H5::DataSpace(1, &two)).write(type_of(version[0]), version);
  put_text(root, "Type", "PolyData");
  const auto count = [](std::size_t n) { return std::vector<std::int64_t>{static_cast<std::int64_t>(n)}; };
  put(root, "NumberOfPoints", count(mesh.point_count()));
  put(root, "Points", mesh.points, {3});
  const std::vector<std::int64_t> none, zero{0};
  for (const auto& [name, shape] : {std::pair{"Vertices", std::optional(FieldMesh::Shape::vertices)},
                                    {"Lines", FieldMesh::Shape::lines},
                                    {"Polygons", FieldMesh::Shape::polygons},
                                    {"Strips", std::nullopt}}) {
    const bool here = shape == mesh.shape;
    const H5::Group group = root.createGroup(name);
    put(group, "NumberOfCells", count(here ? mesh.cell_count() : 0));
    put(group, "NumberOfConnectivityIds", count(here ? mesh.connectivity.size() : 0));
    put(group, "Connectivity", here ? mesh.connectivity : none);
    put(group, "Offsets", here ? mesh.offsets : zero);
  }
  const H5::Group data = root.createGroup(data_of(mesh));
  for (const FieldArray& array : mesh.arrays) {
    visit_values(array, [&](const auto& values) { put(data, array.name, values, row_of(array)); });
    put_text(data.openDataSet(array.name), "unit", array.unit);
  }
}

constexpr const char* path_of_steps = "VTKHDF/Steps";
constexpr hsize_t steps_a_piece = 256;

/// Names and row shapes of the arrays that say where in the file the mesh of a step begins (a step is VTK's word for a
/// frame). All steps use the same mesh, so all entries are 0. The four columns are vertices, lines, polygons and
/// strips.
const std::vector<std::pair<std::string, Row>> mesh_offsets{
    {"PartOffsets", {}}, {"PointOffsets", {}}, {"CellOffsets", {4}}, {"ConnectivityIdOffsets", {4}}};

void set_number_of_steps(H5::Group& steps, std::size_t number) {
  const auto n = static_cast<std::int64_t>(number);
  H5::Attribute a = steps.attrExists("NSteps") ? steps.openAttribute("NSteps")
                                               : steps.createAttribute("NSteps", type_of(n), H5::DataSpace());
  a.write(type_of(n), &n);
}

/// Makes the group of steps (frames), still without steps, and the arrays that change from frame to frame.
void make_steps(H5::H5File& file, const FieldMesh& mesh, const std::vector<FieldArray>& arrays) {
  H5::Group steps = file.createGroup(path_of_steps);
  set_number_of_steps(steps, 0);
  make_growing(steps, "Values", type_of(0.0), {}, steps_a_piece);
  const auto whole = type_of(std::int64_t{});
  make_growing(steps, "NumberOfParts", whole, {}, steps_a_piece);
  for (const auto& [name, row] : mesh_offsets) make_growing(steps, name, whole, row, steps_a_piece);
  const H5::Group offsets = steps.createGroup(std::string(data_of(mesh)) + "Offsets");
  for (const FieldArray& a : mesh.arrays) make_growing(offsets, a.name, whole, {}, steps_a_piece);
  const H5::Group data = file.openGroup("VTKHDF").openGroup(data_of(mesh));
  for (const FieldArray& a : arrays) {
    make_growing(offsets, a.name, whole, {}, steps_a_piece);
    visit_values(a, [&](const auto& values) {
      const hsize_t rows = values.size() / static_cast<std::size_t>(a.components);
      put_text(make_growing(data, a.name, type_of(values[0]), row_of(a), rows), "unit", a.unit);
    });
  }
}

/// A series in one VTKHDF file. The mesh is written once; every frame appends rows to the arrays that change.
class VtkHdfSeries : public FieldSeries {
 public:
  VtkHdfSeries(const std::filesystem::path& file, FieldMesh mesh, std::optional<double> until)
      : name_(file), mesh_(std::move(mesh)) {
    if (until && std::filesystem::exists(file)) reopen(*until);
  }

  std::size_t size() const override { return steps_; }

  void add(double time, const std::vector<FieldArray>& arrays) override {
    if (!open_ && steps_ > 0) reopen(time);  // the file was closed because the frame before this one failed
    const bool first = !open_;
    try {
      if (first) {
        open_.emplace(name_, OpenHdf5::Begin::anew);
        open_->write(bytes_of(mesh_), [&](H5::H5File& file) {
          put_mesh(file, mesh_);
          make_steps(file, mesh_, arrays);
        });
      }
      open_->write(bytes_of(arrays), [&](H5::H5File& file) { put_frame(file, arrays); });
      // set_steps() is called last, so that a reader finds only complete steps, even if the program is killed
      set_steps(steps_ + 1, &time);
      if (first) open_->keep();
    } catch (const RunError&) {
      open_.reset();  // closes the file; a file that has no frame yet is removed
      if (first) steps_ = 0;
      throw;
    }
  }

  void end() override {
    if (open_) open_->end();
    open_.reset();
  }

 private:
  /// Sets the number of steps and the list of times in one write, so that the two always agree. VTK allocates memory
  /// for the number of steps and reads all times of the list into it.
  void set_steps(std::size_t number, const double* last_time) {
    open_->write(0, [&](H5::H5File& file) {
      H5::Group steps = file.openGroup(path_of_steps);
      set_number_of_steps(steps, number);
      H5::DataSet times = steps.openDataSet("Values");
      const hsize_t one = last_time ? 1 : 0;
      put_rows(times, number - one, one, last_time);
    });
    steps_ = number;
  }

  /// Appends the rows of a frame to all arrays that change.
  void put_frame(H5::H5File& file, const std::vector<FieldArray>& arrays) {
    const H5::Group steps = file.openGroup(path_of_steps);
    const auto add_row = [&](const H5::Group& group, const std::string& name, const auto& row) {
      H5::DataSet set = group.openDataSet(name);
      put_rows(set, steps_, 1, row);
    };
    const std::int64_t one = 1, none[4] = {};
    add_row(steps, "NumberOfParts", &one);
    for (const auto& [name, row] : mesh_offsets) add_row(steps, name, none);
    const H5::Group offsets = steps.openGroup(std::string(data_of(mesh_)) + "Offsets");
    for (const FieldArray& a : mesh_.arrays) add_row(offsets, a.name, none);
    const H5::Group data = file.openGroup("VTKHDF").openGroup(data_of(mesh_));
    for (const FieldArray& a : arrays) {
      visit_values(a, [&](const auto& values) {
        const hsize_t rows = values.size() / static_cast<std::size_t>(a.components);
        const auto begin = static_cast<std::int64_t>(rows * steps_);
        add_row(offsets, a.name, &begin);
        H5::DataSet set = data.openDataSet(a.name);
        put_rows(set, rows * steps_, rows, values.data());
      });
    }
  }

  /// Opens an existing file. Removes the frames at time `until` and later, and the remains of a frame that could not be
  /// written.
  void reopen(double until) {
    const auto refuse = [&](const std::string& found) {
      throw InputError(name_.string(), 0, "fields to continue", found,
                       "the fields of this run; if you remove the file, the run begins a new file");
    };
    std::vector<double> times;
    std::int64_t points = -1;
    try {
      open_.emplace(name_, OpenHdf5::Begin::as_it_is);
      with_hdf5(name_, [&] {
        H5::Group steps = open_->hdf5().openGroup(path_of_steps);
        std::int64_t number = 0;
        steps.openAttribute("NSteps").read(type_of(number), &number);
        const H5::DataSet values = steps.openDataSet("Values");
        times.resize(static_cast<std::size_t>(values.getSpace().getSimpleExtentNpoints()));
        if (!times.empty()) values.read(times.data(), type_of(0.0));
        times.resize(std::min(times.size(), static_cast<std::size_t>(std::max<std::int64_t>(0, number))));
        open_->hdf5().openDataSet("VTKHDF/NumberOfPoints").read(&points, type_of(points));
      });
    } catch (const RunError& error) { refuse("data that cannot be read (" + std::string(error.what()) + ")"); }
    if (points != static_cast<std::int64_t>(mesh_.point_count())) {
      refuse(fmt::format("{} points, not {}", points, mesh_.point_count()));
    }
    const auto kept = std::lower_bound(times.begin(), times.end(), until) - times.begin();
    if (kept == 0) {
      open_.reset();  // no frame is left, so a new file will replace this one
      steps_ = 0;
    } else {
      set_steps(static_cast<std::size_t>(kept), nullptr);
      open_->write(0, [&](H5::H5File& file) { cut(file); });
    }
  }

  /// Removes the rows of all arrays that lie beyond the last step.
  void cut(H5::H5File& file) const {
    const H5::Group steps = file.openGroup(path_of_steps);
    const auto shorten = [&](const H5::Group& group, const std::string& name, hsize_t rows) {
      H5::DataSet set = group.openDataSet(name);
      put_rows<double>(set, rows, 0, nullptr);
    };
    shorten(steps, "NumberOfParts", steps_);
    for (const auto& [name, row] : mesh_offsets) shorten(steps, name, steps_);
    const H5::Group offsets = steps.openGroup(std::string(data_of(mesh_)) + "Offsets");
    const H5::Group data = file.openGroup("VTKHDF").openGroup(data_of(mesh_));
    for (hsize_t i = 0; i < offsets.getNumObjs(); ++i) {
      const std::string name = offsets.getObjnameByIdx(i);
      shorten(offsets, name, steps_);
      const bool changes =
          std::none_of(mesh_.arrays.begin(), mesh_.arrays.end(), [&](const FieldArray& a) { return a.name == name; });
      if (changes) shorten(data, name, steps_ * rows_of(mesh_));
    }
  }

  std::filesystem::path name_;
  FieldMesh mesh_;
  std::optional<OpenHdf5> open_;
  std::size_t steps_ = 0;
};

}  // namespace

std::unique_ptr<FieldSeries> begin_vtkhdf(const std::filesystem::path& file, FieldMesh mesh,
                                          std::optional<double> until) {
  return std::make_unique<VtkHdfSeries>(file, std::move(mesh), until);
}

void write_vtkhdf(const std::filesystem::path& file, const FieldMesh& mesh) {
  OpenHdf5 open(file, OpenHdf5::Begin::anew);
  open.write(bytes_of(mesh), [&](H5::H5File& hdf5) { put_mesh(hdf5, mesh); });
  open.end();
  open.keep();
}

}  // namespace macadam
