// SPDX-License-Identifier: GPL-3.0-or-later
// main.cpp  Computes |E*|, phase angle and Poisson's ratio of two-phase specimens with voxel finite elements: the
// continuum that the contact network stands for. Shares no code with the network, its contacts or its solvers.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <iostream>
#include <numbers>

#include "bench/continuum/compression.hpp"
#include "bench/continuum/rock_fractions.hpp"

namespace {

using continuum::Complex;

/// A phase: a modulus [Pa] with a phase angle [degrees], and Poisson's ratio.
struct Material {
  double modulus = 0, phase = 0, poisson = 0;
  Complex lambda() const { return young() * poisson / ((1 + poisson) * (1 - 2 * poisson)); }
  Complex mu() const { return young() / (2 * (1 + poisson)); }
  Complex young() const { return std::polar(modulus, phase * std::numbers::pi / 180); }
};

/// Returns a constant of a voxel that both phases share. `stiff`: the mean of the constants of the phases (upper
/// bound); otherwise the inverse of the mean of their inverses (lower bound).
Complex mixed(Complex a, Complex b, double fraction_of_b, bool stiff) {
  if (stiff) return (1 - fraction_of_b) * a + fraction_of_b * b;
  return 1.0 / ((1 - fraction_of_b) / a + fraction_of_b / b);
}

continuum::Grid<double> grid_of(const continuum::RockFractions& rock, const Material& mastic, const Material& stone,
                                bool stiff) {
  continuum::Grid<double> out;
  // Empty columns are added at the sides, so that the numbers of columns along x and y are multiples of 8, as the
  // coarser grids require.
  const auto rounded = [](int n) { return (n + 7) / 8 * 8; };
  out.size = {rounded(rock.size.x), rounded(rock.size.y), rock.size.z};
  out.lambda.assign(out.size.elements(), {});
  out.mu = out.lambda;
  const auto bulk = [](const Material& m) { return m.lambda() + 2.0 / 3 * m.mu(); };
  for (int k = 0; k < rock.size.z; ++k)
    for (int j = 0; j < rock.size.y; ++j)
      for (int i = 0; i < rock.size.x; ++i) {
        const double f = rock.fraction[rock.size.element(i, j, k)];
        const Complex mu = mixed(mastic.mu(), stone.mu(), f, stiff);
        const Complex lambda = mixed(bulk(mastic), bulk(stone), f, stiff) - 2.0 / 3 * mu;
        out.mu[out.size.element(i, j, k)] = mu / mastic.modulus;
        out.lambda[out.size.element(i, j, k)] = lambda / mastic.modulus;
      }
  return out;
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app("Voxel finite elements of a specimen of mastic and rock between frictionless platens.");
  std::string balls, cells, layers;
  std::vector<double> box, voxels;
  std::vector<double> mastic, rock{60e9, 0, 0.28};
  double tolerance = 1e-8;
  auto* source = app.add_option_group("specimen")->require_option(1);
  source->add_option("--balls", balls, "balls of rock in mastic: CSV with x,y,z,radius [m]")->check(CLI::ExistingFile);
  source->add_option("--cells", cells, "Laguerre cells of a specimen.csv, each with the phase of its sphere")
      ->check(CLI::ExistingFile);
  source->add_option("--layers", layers, "x, y or z: the half with larger coordinates is rock (exact solutions)")
      ->check(CLI::IsMember({"x", "y", "z"}));
  app.add_option("--box", box, "edges of the specimen [m]")->expected(3)->required();
  app.add_option("--voxel", voxels,
                 "edges of the voxels [m], one computation for each; the edges of the specimen must be multiples")
      ->required();
  app.add_option("--mastic", mastic, "mastic: modulus [Pa], phase angle [degrees], Poisson's ratio")
      ->expected(3)
      ->required();
  app.add_option("--rock", rock, "rock: modulus [Pa], phase angle [degrees], Poisson's ratio [60e9 0 0.28]")
      ->expected(3);
  app.add_option("--tolerance", tolerance, "residual at which the solver stops, relative to the first residual [1e-8]");
  CLI11_PARSE(app, argc, argv);
  const Material m{mastic[0], mastic[1], mastic[2]}, a{rock[0], rock[1], rock[2]};
  fmt::print("voxel_m,mixing,rock_fraction,e_star_pa,phase_deg,poisson_ratio,poisson_phase_deg,iterations,seconds\n");
  for (const double voxel : voxels) {
    const auto fractions = !balls.empty()   ? continuum::of_balls(balls, box, voxel)
                           : !cells.empty() ? continuum::of_cells(cells, box, voxel)
                                            : continuum::of_layers(layers[0] - 'x', box, voxel);
    for (const bool stiff : {true, false}) {
      const auto begin = std::chrono::steady_clock::now();
      const auto result =
          continuum::compress(grid_of(fractions, m, a, stiff), fractions.size.x, fractions.size.y, tolerance);
      const double degrees = 180 / std::numbers::pi;
      fmt::print("{:g},{},{:.5f},{:.10g},{:.6f},{:.8f},{:.5f},{},{:.1f}\n", voxel, stiff ? "stiff" : "soft",
                 fractions.mean(), std::abs(result.modulus) * m.modulus, std::arg(result.modulus) * degrees,
                 std::abs(result.poisson), std::arg(result.poisson) * degrees, result.iterations,
                 std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
      std::cout.flush();
    }
  }
} catch (const std::exception& error) {
  std::cerr << "continuum: " << error.what() << '\n';
  return 1;
}
