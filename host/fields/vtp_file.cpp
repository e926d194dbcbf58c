// SPDX-License-Identifier: GPL-3.0-or-later
// vtp_file.cpp  Writes XML text followed by the raw bytes of the arrays (VTK's "appended" data in "raw" encoding).
#include "host/fields/vtp_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <fstream>
#include <iterator>

#include "host/files/result_files.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

const char* type_of(float) { return "Float32"; }
const char* type_of(std::int32_t) { return "Int32"; }
const char* type_of(std::int64_t) { return "Int64"; }

/// The text of a file and the arrays that follow it.
class VtpText {
 public:
  template <class... Arguments>
  void line(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
    text_.push_back('\n');
  }

  template <class T>
  void array(const std::string& name, const std::string& unit, int components, const std::vector<T>& values) {
    const std::string attributes =
        fmt::format(R"(type="{}" Name="{}" NumberOfComponents="{}" format="appended" offset="{}")", type_of(T()), name,
                    components, appended_.size());
    if (unit.empty()) {
      line("<DataArray {}/>", attributes);
    } else {
      line("<DataArray {}>", attributes);
      line(R"(<InformationKey name="UNITS_LABEL" location="vtkDataArray">{}</InformationKey>)", unit);
      line("</DataArray>");
    }
    const std::uint64_t bytes = values.size() * sizeof(T);
    append(&bytes, sizeof bytes);
    append(values.data(), bytes);
  }

  std::string document() const {
    return fmt::format("{}<AppendedData encoding=\"raw\">\n_{}\n</AppendedData>\n</VTKFile>\n",
                       std::string_view(text_.data(), text_.size()), appended_);
  }

 private:
  void append(const void* data, std::size_t bytes) {
    if (bytes > 0) appended_.append(static_cast<const char*>(data), bytes);
  }

  fmt::memory_buffer text_;
  std::string appended_;
};

void put_arrays(VtpText& out, const std::vector<FieldArray>& arrays) {
  for (const FieldArray& a : arrays) {
    std::visit([&](const auto& values) { out.array(a.name, a.unit, a.components, values); }, a.values);
  }
}

std::string text_of(const FieldMesh& mesh, const std::vector<FieldArray>& arrays, std::optional<double> time) {
  using Shape = FieldMesh::Shape;
  const auto count = [&](Shape shape) { return shape == mesh.shape ? mesh.cell_count() : 0; };
  static_assert(std::endian::native == std::endian::little);
  VtpText out;
  out.line(R"(<?xml version="1.0"?>)");
  out.line(R"(<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">)");
  out.line("<PolyData>");
  if (time) {
    out.line(R"(<FieldData><DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="ascii">{}</DataArray>)"
             "</FieldData>",
             *time);
  }
  out.line(R"(<Piece NumberOfPoints="{}" NumberOfVerts="{}" NumberOfLines="{}" NumberOfStrips="0" NumberOfPolys="{}">)",
           mesh.point_count(), count(Shape::vertices), count(Shape::lines), count(Shape::polygons));
  const char* data = mesh.shape == Shape::vertices ? "PointData" : "CellData";
  out.line("<{}>", data);
  put_arrays(out, mesh.arrays);
  put_arrays(out, arrays);
  out.line("</{}>", data);
  out.line("<Points>");
  out.array("Points", "m", 3, mesh.points);
  out.line("</Points>");
  const char* cells = mesh.shape == Shape::vertices ? "Verts" : mesh.shape == Shape::lines ? "Lines" : "Polys";
  out.line("<{}>", cells);
  out.array("connectivity", "", 1, mesh.connectivity);
  out.array("offsets", "", 1, std::vector(mesh.offsets.begin() + 1, mesh.offsets.end()));  // the end of each cell
  out.line("</{}>\n</Piece>\n</PolyData>", cells);
  return out.document();
}

/// A frame in the list of frames.
struct Listed {
  double time;
  std::string file;
};

constexpr std::string_view before_time = "<DataSet timestep=\"", before_file = "\" part=\"0\" file=\"",
                           after_file = "\"/>";

/// A series of one XML file per frame, and the list of the frames (.pvd).
class VtpSeries : public FieldSeries {
 public:
  VtpSeries(const std::filesystem::path& stem, FieldMesh mesh, std::optional<double> until)
      : stem_(stem), mesh_(std::move(mesh)) {
    if (until && std::filesystem::exists(list())) reopen(*until);
  }

  std::size_t size() const override { return frames_.size(); }

  void add(double time, const std::vector<FieldArray>& arrays) override {
    const std::string name = fmt::format("{}_{:06}.vtp", stem_.filename().string(), frames_.size());
    write_whole(stem_.parent_path() / name, text_of(mesh_, arrays, time));
    frames_.push_back({time, name});
    try {
      write_list();
    } catch (...) {
      frames_.pop_back();
      throw;
    }
  }

 private:
  std::filesystem::path list() const { return stem_.string() + ".pvd"; }

  void write_list() const {
    std::string text =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
        "<Collection>\n";
    for (const Listed& f : frames_) {
      text += fmt::format("{}{}{}{}{}\n", before_time, f.time, before_file, f.file, after_file);
    }
    write_whole(list(), text + "</Collection>\n</VTKFile>\n");
  }

  /// Reads the list of frames of an existing series, and removes from it the frames at time `until` and later.
  void reopen(double until) {
    std::ifstream in(list(), std::ios::binary);
    in.exceptions(std::ios::badbit);  // so that a lack of memory is not reported as a damaged file
    const auto refuse = [&](const std::string& found) {
      throw InputError(list().string(), 0, "fields to continue", found,
                       "the fields of this run; if you remove the file, the run begins a new file");
    };
    bool ended = false;
    for (std::string line; std::getline(in, line); ended = ended || line == "</VTKFile>") {
      if (!line.starts_with(before_time)) continue;
      const std::size_t file = line.find(before_file), end = line.rfind(after_file);
      char* rest = nullptr;
      const double time = std::strtod(line.c_str() + before_time.size(), &rest);
      if (file == std::string::npos || end == std::string::npos || rest != line.c_str() + file) refuse(line);
      const std::size_t name = file + before_file.size();
      if (time < until) frames_.push_back({time, line.substr(name, end - name)});
    }
    if (!ended) refuse("a list without its end");
    write_list();  // the files of removed frames are overwritten by the frames that follow
  }

  std::filesystem::path stem_;
  FieldMesh mesh_;
  std::vector<Listed> frames_;
};

}  // namespace

std::unique_ptr<FieldSeries> begin_vtp(const std::filesystem::path& stem, FieldMesh mesh, std::optional<double> until) {
  return std::make_unique<VtpSeries>(stem, std::move(mesh), until);
}

void write_vtp(const std::filesystem::path& file, const FieldMesh& mesh) { write_whole(file, text_of(mesh, {}, {})); }

}  // namespace macadam
