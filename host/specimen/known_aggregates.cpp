// SPDX-License-Identifier: GPL-3.0-or-later
// known_aggregates.cpp  Reads aggregates.csv, the table of bodies, shapes, sizes, centres and rotations.
#include "host/specimen/known_aggregates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <system_error>

#include "host/base/in_quotes.hpp"
#include "host/specimen/packing/shape_placement.hpp"
#include "host/spheres/size_law.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

/// Splits a line into its fields, which commas separate. Text in double quotes may contain commas, and a double quote
/// as two of them.
std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> out(1);
  bool quoted = false;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const char c = line[k];
    if (c == '"' && quoted && k + 1 < line.size() && line[k + 1] == '"') {
      out.back() += line[++k];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      out.emplace_back();
    } else {
      out.back() += c;
    }
  }
  return out;
}

/// Reads one file. Keeps the line that is being read for messages.
class AggregatesReader {
 public:
  AggregatesReader(const std::filesystem::path& file, const Specimen& specimen) : file_(file) {
    for (std::size_t i = 0; i < specimen.size(); ++i)
      if (specimen.phase[i] == Phase::aggregate) bodies_.insert(specimen.body[i]);
  }

  KnownAggregates read() {
    std::ifstream in(file_, std::ios::binary);
    if (!in) fail("file of aggregates", "a file that cannot be read", "a readable CSV file");
    for (std::string text; std::getline(in, text);) {
      ++line_;
      if (text.ends_with('\r')) text.pop_back();
      if (text.empty()) continue;
      if (column_.empty())
        read_header(fields_of(text));
      else
        read_row(fields_of(text));
    }
    if (column_.empty()) fail("first line", "nothing", "the names of the columns body,shape,size,x,y,z");
    return std::move(out_);
  }

 private:
  /// The surface of a shape in the list of surfaces, and its measures.
  struct Shape {
    std::int32_t surface = -1;
    double size = 0, volume = 0;  ///< D^I [m] and volume [m³] of the listed surface
  };

  [[noreturn]] void fail(const std::string& what, const std::string& found, const std::string& expected) const {
    throw InputError(file_.string(), line_, what, found, expected);
  }

  void read_header(const std::vector<std::string>& names) {
    for (std::size_t k = 0; k < names.size(); ++k) column_.emplace(names[k], k);
    columns_ = names.size();
    for (const char* name : {"body", "shape", "size", "x", "y", "z"})
      if (!column_.contains(name))
        fail("first line", std::string("no column ") + name, "the columns body,shape,size,x,y,z");
  }

  const std::string& text(const char* name) const { return row_[column_.at(name)]; }

  double number(const char* name) const {
    const std::string& word = text(name);
    double out = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), out);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(out))
      fail(std::string("column ") + name, in_quotes(word), "a number");
    return out;
  }

  void read_row(std::vector<std::string> row) {
    row_ = std::move(row);
    if (row_.size() != columns_)
      fail("row", fmt::format("{} fields", row_.size()), fmt::format("{}, one per column", columns_));
    Aggregate a;
    const double body = number("body");
    if (body != std::floor(body) || std::abs(body) > 2e9 || !bodies_.contains(static_cast<std::int32_t>(body)))
      fail("column body", in_quotes(text("body")), "a body of the specimen that consists of aggregate spheres");
    a.body = static_cast<std::int32_t>(body);
    if (!seen_.insert(a.body).second) fail("column body", in_quotes(text("body")) + " again", "each body once");
    a.shape = text("shape");
    a.size = number("size");
    if (!(a.size > 0)) fail("column size", in_quotes(text("size")), "a positive length in metres");
    a.centre = {number("x"), number("y"), number("z")};
    if (a.shape == "sphere") {
      a.volume = column_.contains("volume") ? number("volume") : sphere_volume(a.size);
    } else {
      const Shape& shape = shape_of(a.shape);
      a.surface = shape.surface;
      a.pose = {a.centre, turn(), a.size / shape.size};
      a.volume = shape.volume * std::pow(a.pose.scale, 3);
    }
    out_.aggregates.push_back(std::move(a));
  }

  /// Returns the rotation as a unit quaternion. Digits of a text are rounded, so it is normalised.
  std::array<double, 4> turn() const {
    for (const char* name : {"qw", "qx", "qy", "qz"})
      if (!column_.contains(name))
        fail("first line", std::string("no column ") + name,
             "the columns qw,qx,qy,qz, because not every shape is \"sphere\"");
    std::array<double, 4> q{number("qw"), number("qx"), number("qy"), number("qz")};
    const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
    if (!(std::abs(length - 1) < 1e-3))
      fail("columns qw,qx,qy,qz", fmt::format("a quaternion of length {:.6g}", length), "length 1");
    for (double& part : q) part /= length;
    return q;
  }

  const Shape& shape_of(const std::string& name) {
    if (const auto known = shapes_.find(name); known != shapes_.end()) return known->second;
    const ShapeTemplate made = shape_template(surface_named(name));
    Shape shape{static_cast<std::int32_t>(out_.surfaces.size()), made.d_intermediate, made.volume};
    out_.surfaces.push_back(made.surface);
    return shapes_.emplace(name, shape).first->second;
  }

  Surface surface_named(const std::string& name) {
    if (library_.empty()) {
      library_ = shape_library();
      library_.push_back(subdivided_icosahedron());
    }
    for (const Surface& surface : library_)
      if (surface.name == name) return surface;
    const std::filesystem::path place = file_.parent_path() / name;
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(place, ignored))
      fail("column shape", in_quotes(name), "\"sphere\", a shape of the program, or the file of a surface");
    return read_surface(place);
  }

  std::filesystem::path file_;
  std::set<std::int32_t> bodies_, seen_;
  int line_ = 0;
  std::map<std::string, std::size_t> column_;
  std::size_t columns_ = 0;
  std::vector<std::string> row_;
  std::map<std::string, Shape> shapes_;
  std::vector<Surface> library_;
  KnownAggregates out_;
};

}  // namespace

KnownAggregates read_aggregates_csv(const std::filesystem::path& file, const Specimen& specimen) {
  return AggregatesReader(file, specimen).read();
}

}  // namespace macadam
