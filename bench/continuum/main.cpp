// SPDX-License-Identifier: GPL-3.0-or-later
// main.cpp  Computes |E*|, phase angle and Poisson's ratio of specimens of mastic, rock and voids with voxel finite
// elements: the continuum that the contact network stands for. Shares no code with the network, its contacts or its
// solvers.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <optional>
#include <tuple>

#include "bench/continuum/sampling.hpp"
#include "host/tools/ct/continuum/compression.hpp"
#include "host/tools/ct/continuum/extrapolation.hpp"
#include "host/tools/ct/continuum/mixing.hpp"
#include "host/tools/ct/continuum/scan.hpp"

namespace {

namespace continuum = macadam::continuum;
using continuum::Material;
using continuum::Mixing;

/// The options of the command.
struct Options {
  std::string balls, aggregates, shapes = "examples/shapes", cells, layers, scan, voids;
  std::vector<double> box, voxels, rock{60e9, 0, 0.28};
  std::vector<std::tuple<double, double, double>> mastics;
  double tolerance = 1e-6;
};

void add_options(CLI::App& app, Options& o) {
  auto* source = app.add_option_group("specimen")->require_option(1);
  source->add_option("--balls", o.balls, "balls of rock in mastic: CSV with x,y,z,radius [m]");
  source->add_option("--aggregates", o.aggregates,
                     "library shapes in mastic: CSV with body,shape,size,x,y,z,qw,qx,qy,qz [m]");
  source->add_option("--cells", o.cells, "Laguerre cells of a specimen.csv, each with the phase of its sphere");
  source->add_option("--scan", o.scan, "phases.mha or labels.mha of macadam ct segment; needs no --box");
  source->add_option("--layers", o.layers, "x, y or z: the half with larger coordinates is rock (exact solutions)")
      ->check(CLI::IsMember({"x", "y", "z"}));
  app.add_option("--shapes", o.shapes, "folder of the shapes of --aggregates [examples/shapes]");
  app.add_option("--voids", o.voids, "balls of air in the specimen: CSV with x,y,z,radius [m]");
  app.add_option("--box", o.box, "edges of the specimen [m]")->expected(3);
  app.add_option("--voxel", o.voxels,
                 "edges of the voxels [m]; several are extrapolated to 0; the edges of the specimen must be multiples")
      ->required()
      ->check(CLI::PositiveNumber);
  app.add_option("--mastic", o.mastics,
                 "mastic: modulus [Pa], phase angle [degrees], Poisson's ratio; repeated for several frequencies")
      ->required();
  app.add_option("--rock", o.rock, "rock: modulus [Pa], phase angle [degrees], Poisson's ratio [60e9 0 0.28]")
      ->expected(3);
  app.add_option("--tolerance", o.tolerance,
                 "residual at which the solver stops, divided by the residual of a strain along z alone [1e-6]");
}

/// Checks the constants of a phase. \throws std::runtime_error naming the option and the value.
Material material(const char* option, double modulus, double phase, double poisson) {
  if (!(modulus > 0))
    throw std::runtime_error(fmt::format("{}: found a modulus of {} Pa, expected > 0", option, modulus));
  if (!(phase >= 0 && phase < 90))
    throw std::runtime_error(fmt::format("{}: found a phase angle of {} degrees, expected 0 to 90", option, phase));
  if (!(poisson > -1 && poisson < 0.5))
    throw std::runtime_error(fmt::format("{}: found Poisson's ratio {}, expected -1 to 0.5", option, poisson));
  return {modulus, phase, poisson};
}

/// Returns a function that computes the fractions for an edge of the voxels. Files are read once.
std::function<continuum::PhaseFractions(double)> specimen_of(const Options& o) {
  if (!o.scan.empty()) {
    if (!o.voids.empty()) throw std::runtime_error("--voids: cannot be used with --scan, whose voids are in the image");
    const auto scan = std::make_shared<continuum::Scan>(continuum::read_scan(o.scan));
    return [scan](double voxel) { return continuum::of_scan(*scan, voxel); };
  }
  if (o.box.empty()) throw std::runtime_error("--box: missing; only --scan needs no edges of the specimen");
  const continuum::Point box{o.box[0], o.box[1], o.box[2]};
  std::vector<continuum::Body> rock, voids;
  if (!o.balls.empty()) rock = continuum::read_balls(o.balls);
  if (!o.aggregates.empty()) rock = continuum::read_aggregates(o.aggregates, o.shapes);
  if (!o.voids.empty()) voids = continuum::read_balls(o.voids);
  return [=](double voxel) {
    auto out = !o.cells.empty()    ? continuum::of_cells(o.cells, box, voxel)
               : !o.layers.empty() ? continuum::of_layers(o.layers[0] - 'x', box, voxel)
                                   : continuum::mastic_in(box, voxel);
    continuum::place_bodies(out, voxel, rock, voids);
    return out;
  };
}

constexpr double degrees = 180 / std::numbers::pi;

void print(const Material& m, const std::string& voxel, const char* mixing, const continuum::PhaseFractions& of,
           continuum::Complex modulus, continuum::Complex poisson, const std::string& remainder) {
  fmt::print("{:g},{:g},{},{},{:.5f},{:.5f},{:.10g},{:.6f},{:.8f},{:.5f},{}\n", m.modulus, m.phase, voxel, mixing,
             of.mean_rock(), of.mean_voids(), std::abs(modulus) * m.modulus, std::arg(modulus) * degrees,
             std::abs(poisson), std::arg(poisson) * degrees, remainder);
  std::cout.flush();
}

void run(const Options& o) {
  std::vector<Material> mastics;
  for (const auto& [modulus, phase, poisson] : o.mastics)
    mastics.push_back(material("--mastic", modulus, phase, poisson));
  const Material rock = material("--rock", o.rock[0], o.rock[1], o.rock[2]);
  const auto specimen = specimen_of(o);
  std::vector<double> voxels = o.voxels;
  std::sort(voxels.rbegin(), voxels.rend());
  voxels.erase(std::unique(voxels.begin(), voxels.end()), voxels.end());
  fmt::print(
      "mastic_pa,mastic_deg,voxel_m,mixing,rock_fraction,void_fraction,e_star_pa,phase_deg,poisson_ratio,"
      "poisson_phase_deg,iterations,seconds,e_star_uncertainty_pa,phase_uncertainty_deg\n");
  std::vector<std::vector<continuum::Sizes>> values(mastics.size(), std::vector<continuum::Sizes>(2));
  continuum::PhaseFractions fractions;
  for (const double voxel : voxels) {
    fractions = specimen(voxel);
    for (const Mixing mixing : {Mixing::stiff, Mixing::soft}) {
      continuum::Field<double> u;  // each frequency starts from the displacement at the previous frequency
      for (std::size_t m = 0; m < mastics.size(); ++m) {
        const auto begin = std::chrono::steady_clock::now();
        const auto result =
            continuum::compress(grid_of(fractions, mastics[m], rock, mixing), fractions.area, o.tolerance, u);
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        const bool stiff = mixing == Mixing::stiff;
        print(mastics[m], fmt::format("{:g}", voxel), stiff ? "stiff" : "soft", fractions, result.modulus,
              result.poisson, fmt::format("{},{:.1f},,", result.iterations, seconds));
        values[m][stiff ? 0 : 1].push_back({voxel, result.modulus, result.poisson});
      }
    }
  }
  for (std::size_t m = 0; voxels.size() > 1 && m < mastics.size(); ++m) {
    const auto limit = continuum::extrapolated(values[m][0], values[m][1]);
    print(mastics[m], "0", "extrapolated", fractions, limit.modulus, limit.poisson,
          fmt::format(",,{:.3g},{:.3g}", limit.uncertainty * mastics[m].modulus, limit.phase_uncertainty * degrees));
  }
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app("Voxel finite elements of a specimen of mastic, rock and voids between frictionless platens.");
  Options options;
  add_options(app, options);
  CLI11_PARSE(app, argc, argv);
  run(options);
} catch (const std::exception& error) {
  std::cerr << "continuum: " << error.what() << '\n';
  return 1;
}
