// SPDX-License-Identifier: GPL-3.0-or-later
// fill_study.cpp  Measures the number of spheres and the dimensions of clusters for several radii of the spheres.
// Usage: fill_study DIR SURFACE…
#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "kernels/base/parallel.hpp"
#include "macadam/error.hpp"
#include "macadam/shape.hpp"

namespace macadam {
namespace {

constexpr double circumscribed = 6.295e-3;  // half the intermediate dimension of every shape [m]
constexpr std::uint64_t seeds = 3;

/// One filling of a shape, and its results.
struct Study {
  const Surface* surface;
  ShapeMeasure shape;
  FillSpec spec;
  MultiSphere cluster;
  FillReport report;
};

/// Scales a surface to the common intermediate dimension.
Surface of_common_size(Surface surface) {
  const double factor = 2 * circumscribed / measure_shape(surface).d_intermediate;
  for (Vec3d& p : surface.points) p = factor * p;
  return surface;
}

/// Returns the ranges of radii: equal spheres of five radii, then radii from 0.5 mm up to 1.5 to 4 times that.
std::vector<std::pair<double, double>> ranges() {
  std::vector<std::pair<double, double>> all;
  for (double r : {0.5e-3, 0.75e-3, 1e-3, 1.5e-3, 2e-3}) all.emplace_back(r, r);
  for (double ratio : {1.5, 2.0, 2.5, 3.0, 3.5, 4.0}) all.emplace_back(0.5e-3, ratio * 0.5e-3);
  return all;
}

void run(Study& study) {
  study.cluster = fill_shape(*study.surface, study.spec);
  study.report = measure_fill(*study.surface, study.cluster);
}

void write_table(const std::string& file, const std::vector<Study>& studies) {
  std::ofstream out(file);
  out << "shape,radius_min_mm,radius_max_mm,seed,spheres,volume_mm3,sphere_volume_mm3,covered,outside,largest_overlap,"
         "deviation_mean_mm,deviation_largest_mm,d_long_mm,d_intermediate_mm,d_short_mm,shape_d_long_mm,"
         "shape_d_intermediate_mm,shape_d_short_mm,flatness,elongation,sphericity_true,sphericity_working\n";
  for (const Study& s : studies) {
    const FillReport& r = s.report;
    out << fmt::format("{},{:.6g},{:.6g},{},{}", s.surface->name, 1e3 * s.spec.radius_min, 1e3 * s.spec.radius_max,
                       s.spec.seed, s.cluster.size());
    for (double value :
         {1e9 * s.shape.volume, 1e9 * r.sphere_volume, r.covered, r.outside, r.largest_overlap, 1e3 * r.deviation_mean,
          1e3 * r.deviation_largest, 1e3 * r.d_long, 1e3 * r.d_intermediate, 1e3 * r.d_short, 1e3 * s.shape.d_long,
          1e3 * s.shape.d_intermediate, 1e3 * s.shape.d_short, s.shape.flatness(), s.shape.elongation(),
          s.shape.sphericity_true, s.shape.sphericity_working()})
      out << fmt::format(",{:.5g}", value);
    out << '\n';
  }
  if (!out.flush()) throw RunError(file + ": cannot be written");
}

/// Writes the spheres of seed 1, for draw_fill.py.
void write_spheres(const std::string& file, const std::vector<Study>& studies) {
  std::ofstream out(file);
  out << "shape,radius_min_mm,radius_max_mm,x,y,z,radius\n";
  for (const Study& s : studies) {
    if (s.spec.seed != 1) continue;
    for (std::size_t i = 0; i < s.cluster.size(); ++i) {
      const Vec3d& c = s.cluster.centre[i];
      out << fmt::format("{},{:.6g},{:.6g},{:.5f},{:.5f},{:.5f},{:.5f}\n", s.surface->name, 1e3 * s.spec.radius_min,
                         1e3 * s.spec.radius_max, 1e3 * c.x, 1e3 * c.y, 1e3 * c.z, 1e3 * s.cluster.radius[i]);
    }
  }
  if (!out.flush()) throw RunError(file + ": cannot be written");
}

/// Fills each surface, and an icosahedron, with every range of radii and every seed, and writes the files.
int study(const std::string& folder, const std::vector<std::string>& files) {
  std::vector<Surface> surfaces;
  for (const std::string& file : files) surfaces.push_back(of_common_size(read_surface(file)));
  surfaces.push_back(of_common_size(subdivided_icosahedron()));
  std::vector<Study> studies;
  for (const Surface& surface : surfaces) {
    const ShapeMeasure shape = measure_shape(surface);
    for (const auto& [low, high] : ranges())
      for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        FillSpec spec;
        spec.radius_min = low, spec.radius_max = high, spec.seed = seed;
        studies.push_back({&surface, shape, spec, {}, {}});
      }
    write_surface(folder + "/" + surface.name + ".obj", surface);
  }
  for_each_in_parallel(studies.size(), [&](std::size_t k) { run(studies[k]); });
  write_table(folder + "/fill-study.csv", studies);
  write_spheres(folder + "/fill-spheres.csv", studies);
  return 0;
}

}  // namespace
}  // namespace macadam

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: fill_study DIR SURFACE...\n");
    return 2;
  }
  try {
    return macadam::study(argv[1], {argv + 2, argv + argc});
  } catch (const macadam::Error& error) {
    fmt::print(stderr, "fill_study: {}\n", error.what());
    return 1;
  }
}
