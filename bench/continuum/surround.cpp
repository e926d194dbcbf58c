// SPDX-License-Identifier: GPL-3.0-or-later
// surround.cpp  Makes a specimen of given aggregates and voids: each aggregate becomes one sphere or a cluster, and
// mastic fills the remaining space as in a generated specimen. Used by bench/continuum/lattice.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "host/network/rock_lengths.hpp"
#include "host/shapes/fill/fill.hpp"
#include "host/specimen/composition.hpp"
#include "host/specimen/known_aggregates.hpp"
#include "host/specimen/mastic.hpp"
#include "host/specimen/packing/shape_placement.hpp"
#include "host/spheres/size_law.hpp"

namespace {

using namespace macadam;

constexpr std::uint64_t placement_stream = 2;  // same number as in generate.cpp

/// Options of the command.
struct Options {
  std::string aggregates, voids, out;
  std::array<double, 3> box{};
  std::array<double, 2> fill{}, mastic{};
  double porosity = 0.05, fill_porosity = 0;
  std::uint64_t seed = 1;
};

/// Returns an aggregate sphere for each line of a file but the first, so that every body from 0 on exists.
Specimen bodies_of(const std::string& file) {
  std::ifstream in(file);
  const auto lines = std::count(std::istreambuf_iterator<char>(in), {}, '\n');
  Specimen out;
  for (std::int32_t body = 0; body + 1 < lines; ++body) {
    out.centre.push_back({}), out.radius.push_back(1);
    out.phase.push_back(Phase::aggregate), out.body.push_back(body);
  }
  return out;
}

/// Returns the spheres `x,y,z,radius` of a file; none without a file. \throws std::runtime_error for a faulty line.
std::vector<VoidSphere> spheres_of(const std::string& file) {
  std::vector<VoidSphere> out;
  if (file.empty()) return out;
  std::ifstream in(file);
  std::string line;
  if (!std::getline(in, line) || line != "x,y,z,radius")
    throw std::runtime_error(fmt::format("{}:1: found \"{}\", expected x,y,z,radius", file, line));
  for (int number = 2; std::getline(in, line); ++number) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream row(line);
    VoidSphere v;
    if (!(row >> v.centre.x >> v.centre.y >> v.centre.z >> v.radius))
      throw std::runtime_error(fmt::format("{}:{}: found \"{}\", expected four numbers", file, number, line));
    out.push_back(v);
  }
  return out;
}

/// Returns a closed surface of 1280 facets about the origin with the volume of a ball of diameter 1 m.
Surface ball() {
  Surface out = subdivided_icosahedron(0.5);
  for (int round = 0; round < 2; ++round) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middle;
    const auto between = [&](std::int32_t a, std::int32_t b) {
      const auto [at, is_new] = middle.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(out.points.size()));
      if (is_new) {
        const Vec3d sum = out.points[static_cast<std::size_t>(a)] + out.points[static_cast<std::size_t>(b)];
        out.points.push_back((0.5 / norm(sum)) * sum);
      }
      return at->second;
    };
    decltype(out.facets) finer;
    for (const auto& [a, b, c] : out.facets) {
      const std::int32_t ab = between(a, b), bc = between(b, c), ca = between(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    out.facets = std::move(finer);
  }
  const double scale = std::cbrt(sphere_volume(1) / shape_template(out).volume);
  for (Vec3d& p : out.points) p = scale * p;
  return out;
}

/// Fills aggregates with spheres.
class Filler {
 public:
  Filler(const Options& o, const KnownAggregates& known) : known_(known) {
    if (o.fill[1] > 0) {
      spec_ = FillSpec{o.fill[0], o.fill[1], o.fill_porosity, 8, SingleSphere::volume, 1};
      shapes_.emplace(-1, ball());
    }
  }
  /// Returns the spheres of an aggregate: the filling, or one sphere of the aggregate's volume at its centroid.
  MultiSphere spheres(const Aggregate& a) {
    if (!spec_) return {{a.centre}, {std::cbrt(a.volume / sphere_volume(2))}};
    auto shape = shapes_.find(a.surface);
    if (shape == shapes_.end())
      shape = shapes_.emplace(a.surface, known_.surfaces[static_cast<std::size_t>(a.surface)]).first;
    FillSpec spec = *spec_;
    spec.seed = static_cast<std::uint64_t>(a.body) + 1;
    const double scale = a.surface < 0 ? a.size : a.pose.scale;
    MultiSphere out = shape->second.fill(scale, spec);
    const Pose rigid{a.centre, a.surface < 0 ? std::array<double, 4>{1, 0, 0, 0} : a.pose.turn, 1};
    for (Vec3d& centre : out.centre) centre = rigid(centre);
    return out;
  }

 private:
  const KnownAggregates& known_;
  std::optional<FillSpec> spec_;
  std::map<std::int32_t, ShapeFiller> shapes_;
};

void run(const Options& o) {
  const KnownAggregates known = read_aggregates_csv(o.aggregates, bodies_of(o.aggregates));
  const std::vector<VoidSphere> voids = spheres_of(o.voids);
  SpecimenSpec spec;
  spec.source = "surround";
  spec.seed = o.seed;
  spec.box.size = {o.box[0], o.box[1], o.box[2]};

  Filler filler(o, known);
  std::vector<MultiSphere> spheres;
  double smallest = std::min({o.box[0], o.box[1], o.box[2]}), largest_void = 0, rock = 0, air = 0;
  for (const Aggregate& a : known.aggregates) {
    spheres.push_back(filler.spheres(a));
    rock += a.volume;
    for (const double r : spheres.back().radius) smallest = std::min(smallest, r);
  }
  for (const VoidSphere& v : voids) largest_void = std::max(largest_void, v.radius), air += sphere_volume(2 * v.radius);

  Specimen out;
  out.box = spec.box;
  out.source = spec.source;
  // the true surfaces need the clusters, which are placed below
  std::optional<RockSurfaces> surfaces;
  const auto taken = [&surfaces](const Vec3d& point) { return surfaces->contains(point); };
  Placement placement(out, smallest, spec.attempts, RandomStream(o.seed, placement_stream), Origin(spec), taken,
                      largest_void);
  for (std::size_t k = 0; k < spheres.size(); ++k)
    for (std::size_t i = 0; i < spheres[k].size(); ++i)
      placement.add_aggregate(spheres[k].centre[i], spheres[k].radius[i], known.aggregates[k].body);
  surfaces.emplace(out, known.aggregates, known.surfaces);
  // voids are treated as aggregates while the mastic relaxes, as in a generated specimen
  const std::size_t first_void = out.size();
  auto body = static_cast<std::int32_t>(known.aggregates.size());
  for (const VoidSphere& v : voids) placement.add_aggregate(v.centre, v.radius, body++);
  const std::size_t end_of_voids = out.size();
  spec.mastic = MasticSpec{o.mastic[0], o.mastic[1], 1 - (1 - o.porosity) * (1 - air / spec.box.volume()), {}, 0};
  for (const Population& p : compose_mastic(spec, rock)) placement.place_mastic(p);
  settle_mastic(out, placement, true, Origin(spec), {}, {});
  part_voids(first_void, end_of_voids, out);
  validate(out, out.source);
  write_specimen_csv(o.out, out);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Fills the space around given aggregates with mastic spheres, and writes a specimen.");
  Options o;
  app.add_option("--aggregates", o.aggregates,
                 "aggregates: CSV with body,shape,size,x,y,z and qw,qx,qy,qz, bodies from 0")
      ->required();
  app.add_option("--voids", o.voids, "balls of air: CSV with x,y,z,radius [m]");
  app.add_option("--box", o.box, "edges of the specimen [m]")->required();
  app.add_option("--fill", o.fill, "radii of the spheres inside an aggregate [m]; without it each is one sphere");
  app.add_option("--fill-porosity", o.fill_porosity, "porosity of the filling");
  app.add_option("--mastic", o.mastic, "radii of the mastic spheres [m]")->required();
  app.add_option("--porosity", o.porosity, "1 - volume of aggregates and mastic spheres / (box - voids)");
  app.add_option("--seed", o.seed, "seed of the mastic");
  app.add_option("--out", o.out, "specimen.csv")->required();
  CLI11_PARSE(app, argc, argv);
  try {
    run(o);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
