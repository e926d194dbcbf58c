// SPDX-License-Identifier: GPL-3.0-or-later
/// \file placement_bench.cpp  Measures how many shaped aggregates can be placed by packing and by insertion, and how
/// long it takes.
///
///   placement_bench [DIR [SEEDS [ATTEMPTS]]]   DIR: folder of OFF files, or "-" for generated aggregates; the
///                                              icosahedron is measured too. Seeds 1 … SEEDS. ATTEMPTS: of the
///                                              insertion
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <string>

#include "tests/support/shape_tests.hpp"

namespace {

using namespace macadam;

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// Reads the shapes of a folder in the order of their names; "-" generates 20 aggregates.
std::vector<ShapeTemplate> shapes_of(const std::string& folder) {
  std::vector<ShapeTemplate> shapes;
  if (folder == "-") {
    for (int k = 1; k <= 20; ++k) shapes.push_back(shape_template(test::stone(k)));
    return shapes;
  }
  std::set<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".off") files.insert(entry.path());
  for (const auto& file : files) shapes.push_back(shape_template(read_surface(file)));
  return shapes;
}

/// Places the aggregates of one recipe and prints, for each size class, how many were placed and how many were asked
/// for.
void run(const char* name, const std::vector<ShapeTemplate>& shapes, PlacementMethod method, std::uint64_t seed,
         std::int64_t attempts) {
  SpecimenSpec recipe = test::design_formulation();
  recipe.seed = seed;
  const ShapeComposition composition = compose_shapes(recipe, shapes, {});
  ShapePlacementSpec spec;
  spec.method = method, spec.seed = seed, spec.attempts = attempts, spec.allow_short = true;
  const double start = seconds();
  const ShapePlacement placed = place_shapes(recipe.box, shapes, composition, spec);
  const double took = seconds() - start;
  double asked = 0, reached = 0;
  std::printf("%s, %s, seed %llu: %.1f s\n", name, method == PlacementMethod::packing ? "packing" : "insertion",
              static_cast<unsigned long long>(seed), took);
  for (const CompositionRow& row : placed.row) {
    std::printf("  %-14s %5lld of %5lld, %.3f %% of the box, %.3f %% asked\n", row.name.c_str(),
                static_cast<long long>(row.count), static_cast<long long>(row.count_asked), 100 * row.fraction,
                100 * row.fraction_asked);
    asked += row.fraction_asked, reached += row.fraction;
  }
  std::printf("  %-14s %.2f %% of the box, %.2f %% asked (%.1f %% of the solid volume); evenness of D^L p = %.3f\n",
              "all", 100 * reached, 100 * asked, 100 * reached / 0.95,
              test::evenness_of_directions(placed.aggregate, shapes));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string folder = argc > 1 ? argv[1] : "-";
  const int seeds = argc > 2 ? std::atoi(argv[2]) : 1;
  const std::int64_t attempts = argc > 3 ? std::atoll(argv[3]) : 20'000;
  const std::vector<ShapeTemplate> stones = shapes_of(folder), icosahedron{shape_template(test::icosphere(1))};
  for (int seed = 1; seed <= seeds; ++seed)
    for (const PlacementMethod method : {PlacementMethod::packing, PlacementMethod::insertion}) {
      run("stones", stones, method, seed, attempts);
      run("icosahedron", icosahedron, method, seed, attempts);
    }
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
