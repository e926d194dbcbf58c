// SPDX-License-Identifier: GPL-3.0-or-later
// shape_files.cpp  Writes the files of `macadam shapes fill` and `macadam shapes generate`.
#include "macadam/shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "host/files/result_files.hpp"
#include "host/files/result_folder.hpp"
#include "host/shapes/files/surface_files.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

std::string spheres_csv(const MultiSphere& cluster) {
  std::string text = "x,y,z,radius\n";
  for (std::size_t i = 0; i < cluster.size(); ++i) {
    const Vec3d& c = cluster.centre[i];
    text += fmt::format("{},{},{},{}\n", c.x, c.y, c.z, cluster.radius[i]);
  }
  return text;
}

/// Returns all spheres as one surface of subdivided icosahedra.
Surface drawn(const MultiSphere& cluster) {
  Surface all{"spheres", {}, {}};
  for (std::size_t i = 0; i < cluster.size(); ++i) {
    const Surface ball = subdivided_icosahedron(cluster.radius[i]);
    const auto first = static_cast<std::int32_t>(all.points.size());
    for (const Vec3d& p : ball.points) all.points.push_back(cluster.centre[i] + p);
    for (const auto& f : ball.facets) all.facets.push_back({first + f[0], first + f[1], first + f[2]});
  }
  return all;
}

/// Checks that the folder holds no surface files other than the files of these shapes. \throws InputError if it holds
/// others.
void refuse_others(const std::filesystem::path& folder, const std::vector<Surface>& shapes) {
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string file = entry.path().filename().string();
    const auto written = [&](const Surface& shape) { return file == shape.name + ".off"; };
    if (is_surface_file(entry.path()) && std::none_of(shapes.begin(), shapes.end(), written))
      throw InputError(folder.string(), 0, "folder", file,
                       "no shapes except those that this command writes; choose another folder");
  }
}

}  // namespace

Surface scale_to_radius(Surface surface, double radius) {
  if (!(radius > 0)) throw InputError(fmt::format("circumscribed: found {} m, expected a positive length", radius));
  const double factor = 2 * radius / measure_shape(surface).d_intermediate;
  for (Vec3d& p : surface.points) p = factor * p;
  return surface;
}

void write_filling(const std::filesystem::path& out, const Surface& surface, const MultiSphere& cluster) {
  const ResultFolder folder(out);
  write_whole(out / "spheres.csv", spheres_csv(cluster));
  write_surface(out / "spheres.obj", drawn(cluster));
  write_surface(out / "shape.obj", surface);
}

void write_shape_library(const std::filesystem::path& out, const std::vector<Surface>& shapes) {
  const ResultFolder folder(out);
  refuse_others(out, shapes);
  for (const Surface& shape : shapes) write_surface(out / (shape.name + ".off"), shape);
}

}  // namespace macadam
