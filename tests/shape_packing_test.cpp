// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shape_packing_test.cpp  The design formulation of the paper's Table 3 in full: 56.3 % of the box is aggregate.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>

#include "long_tests.hpp"
#include "shape_tests.hpp"

namespace macadam {
namespace {

constexpr double asked_of_solid[] = {0.14, 0.11, 0.207, 0.136};

void expect_packed(const char* name, const std::vector<ShapeTemplate>& shapes) {
  if (!test::long_tests) GTEST_SKIP() << "minutes with sanitizers";
  const SpecimenSpec recipe = test::design_formulation();
  const ShapeComposition composition = compose_shapes(recipe, shapes, {});
  const auto start = std::chrono::steady_clock::now();
  const ShapePlacement p = place_shapes(recipe.box, shapes, composition, {});
  const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf("%s: %zu aggregates packed in %.1f s\n", name, p.aggregate.size(), took);

  for (int k = 0; k < 4; ++k)
    EXPECT_NEAR(p.row[k].fraction / 0.95, asked_of_solid[k], 1e-3 * asked_of_solid[k]) << p.row[k].name;
  double reach = 0;  // of any shape about its centre, over D^I
  for (const ShapeTemplate& t : shapes)
    for (const Vec3d& x : t.surface.points) reach = std::max(reach, norm(x) / t.d_intermediate);
  std::vector<Surface> surface;
  for (const PlacedAggregate& a : p.aggregate) surface.push_back(test::placed_surface(a, shapes));
  for (std::size_t i = 0; i < surface.size(); ++i)
    for (const Vec3d& x : surface[i].points) {
      EXPECT_GT(std::min({x.x, x.y, x.z}), 0) << i;
      EXPECT_GT(std::min({0.05 - x.x, 0.05 - x.y, 0.08 - x.z}), 0) << i;
    }
  // Every point of a body against those near it: an independent look at each body's solid angles. Edges against facets
  // are shape_placement_test's.
  const auto size = [&](std::size_t i) {
    return p.aggregate[i].pose.scale * shapes[p.aggregate[i].shape].d_intermediate;
  };
  std::size_t looked = 0;
  for (std::size_t i = 0; i < surface.size(); ++i)
    for (std::size_t j = 0; j < surface.size(); ++j) {
      if (i == j || norm(p.aggregate[i].pose.centre - p.aggregate[j].pose.centre) > reach * (size(i) + size(j)))
        continue;
      for (std::size_t k = 0; k < surface[i].points.size(); k += 8) {
        const Vec3d& x = surface[i].points[k];
        if (norm(x - p.aggregate[j].pose.centre) > reach * size(j)) continue;
        EXPECT_LT(test::winding(surface[j], x), 0.5) << i << " in " << j;
        ++looked;
      }
    }
  EXPECT_GT(looked, 1000u);

  EXPECT_GT(test::evenness_of_directions(p.aggregate, shapes), 0.01);
  for (int size_class = 2; size_class < 4; ++size_class) {
    std::array<double, 4> quarter{};
    double n = 0;
    for (const PlacedAggregate& a : p.aggregate)
      if (a.size_class == size_class) quarter[std::min(3, static_cast<int>(a.pose.centre.z / 0.02))] += 1, n += 1;
    // A count of mean n/4 drawn at random deviates by √(3n)/4; four of these.
    for (double count : quarter) EXPECT_NEAR(count, n / 4, std::sqrt(3 * n)) << "class " << size_class;
  }
}

TEST(ShapePacking, DesignFormulationOfStones) {
  std::vector<ShapeTemplate> shapes;
  for (int k = 1; k <= 20; ++k) shapes.push_back(shape_template(test::stone(k)));
  expect_packed("stones", shapes);
}

// placement_bench packs the icosahedra: a minute more.

}  // namespace
}  // namespace macadam
