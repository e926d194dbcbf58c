// SPDX-License-Identifier: GPL-3.0-or-later
// aggregate_cube_test.cpp  A cluster is one deformable body: a cube of aggregate has the modulus of
// docs/aggregate-cube.md.
#include "aggregate_cube.hpp"

#include <gtest/gtest.h>

namespace macadam::test {
namespace {

// Columns of springs: E between the walls, if these have it too, and in the middle, whatever they have.
TEST(AggregateCube, GaugeOfALatticeIsExact) {
  constexpr double E = 2e10, side = 2e-3;
  Specimen s;
  s.box.size = {5 * side, 5 * side, 10 * side};
  for (int k = 0; k < 250; ++k)
    s.centre.push_back({(k % 5 + 0.5) * side, (k / 5 % 5 + 0.5) * side, (k / 25 + 0.5) * side});
  s.radius.assign(s.centre.size(), 0.5 * side);
  s.phase.assign(s.centre.size(), Phase::aggregate);
  s.body.assign(s.centre.size(), 0);
  for (const double wall : {1.0, 3.0}) {
    const CubeModulus m = cube_modulus(s, {E, inner_alpha}, wall * E);
    EXPECT_NEAR(m.walls / E, 1 / (0.9 + 0.1 / wall), 1e-9);  // half a side at each wall
    EXPECT_NEAR(m.gauge / E, 1, 1e-9);
    EXPECT_NEAR(m.poisson, 0, 1e-9);
  }
}

struct Case {
  const InnerSpheres* spheres;
  CubeFilling filling;
  double gauge, walls;     ///< means of twenty seeds [Pa]
  double deviation;        ///< standard one among the seeds, the larger of both [Pa]
  unsigned seeds;          ///< taken here: cubes of coarse spheres cost a tenth and differ three times as much
  double contact_modulus;  ///< with which the aggregate has its 60 GPa: the paper's where that does
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.spheres->name << ", " << to_string(c.filling); }

class CubeOfSpheres : public testing::TestWithParam<Case> {};

std::vector<Case> cases() {
  using enum CubeFilling;
  return {{&fine_spheres, shape, 59.22e9, 62.11e9, 0.36e9, 1, fine_spheres.contact_modulus},
          {&fine_spheres, recipe, 59.35e9, 61.45e9, 0.36e9, 1, fine_spheres.contact_modulus},
          {&coarse_spheres, shape, 58.51e9, 62.91e9, 1.33e9, 6, 1.145e11},
          {&coarse_spheres, recipe, 60.90e9, 64.15e9, 0.81e9, 6, coarse_spheres.contact_modulus}};
}

CubeModulus mean_modulus(const Case& c, double contact_modulus, std::uint64_t first_seed, unsigned seeds) {
  CubeModulus mean;
  for (unsigned k = 0; k < seeds; ++k) {
    const Specimen cube = aggregate_cube(*c.spheres, c.filling, scene_porosity, first_seed + k);
    const CubeModulus m = cube_modulus(cube, {contact_modulus, inner_alpha});
    mean.gauge += m.gauge / seeds, mean.walls += m.walls / seeds, mean.poisson += m.poisson / seeds;
  }
  return mean;
}

INSTANTIATE_TEST_SUITE_P(All, CubeOfSpheres, testing::ValuesIn(cases()), [](const auto& info) {
  return std::string(info.param.spheres->name) + "_" + to_string(info.param.filling);
});

TEST_P(CubeOfSpheres, HasTheMeasuredModulus) {
  const Case& c = GetParam();
  const CubeModulus mean = mean_modulus(c, c.spheres->contact_modulus, test_seed(), c.seeds);
  // Four standard deviations between a mean of these seeds and one of twenty: one choice of seeds in 16,000 is off.
  const double bound = 4 * c.deviation * std::sqrt(1.0 / c.seeds + 1.0 / 20);
  EXPECT_NEAR(mean.gauge, c.gauge, bound);
  EXPECT_NEAR(mean.walls, c.walls, bound);
  // 0.235 of uniform strain and what relaxation adds: 0.245 to 0.260, ± 0.006 among seeds
  EXPECT_NEAR(mean.poisson, 0.25, 0.02);
}

// The seeds are fixed: what is asked of them is the material's 60 GPa within 2 %, and nothing beside it.
TEST_P(CubeOfSpheres, HasTheModulusOfTheAggregate) {
  if (!long_tests) GTEST_SKIP() << "the same code as above, for other numbers";
  const Case& c = GetParam();
  EXPECT_NEAR(mean_modulus(c, c.contact_modulus, 1, 2 * c.seeds).gauge, aggregate_modulus, 0.02 * aggregate_modulus);
}

}  // namespace
}  // namespace macadam::test
