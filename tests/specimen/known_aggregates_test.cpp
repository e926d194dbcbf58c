// SPDX-License-Identifier: GPL-3.0-or-later
// known_aggregates_test.cpp  Tests the file of aggregates beside the file of a specimen: the file of a generated
// specimen is read back, and faults are named with their line.
#include <gtest/gtest.h>

#include <fstream>

#include "host/network/rock_lengths.hpp"
#include "host/specimen/known_aggregates.hpp"
#include "macadam/error.hpp"
#include "tests/support/cluster_specimens.hpp"
#include "tests/support/test_folder.hpp"

namespace macadam::test {
namespace {

struct KnownAggregatesFile : TestFolder {
  std::filesystem::path file() const { return folder_ / "aggregates.csv"; }
  std::string message(const std::string& text, const Specimen& specimen) const {
    std::ofstream(file()) << text;
    try {
      read_aggregates_csv(file(), specimen);
    } catch (const InputError& error) { return error.what(); }
    return {};
  }
};

TEST_F(KnownAggregatesFile, IsThatOfAGeneratedSpecimen) {
  SpecimenSpec spec = cluster_recipe(2, {6.5e-3, 6.5e-3, 8.5e-3});
  spec.aggregate = {{3.6e-3, 3.9e-3, std::nullopt, 2}};
  const GeneratedSpecimen made = generate_specimen(spec);
  write_aggregates_csv(file(), made.aggregates, made.composition);
  const KnownAggregates read = read_aggregates_csv(file(), made.specimen);
  ASSERT_EQ(read.aggregates.size(), made.aggregates.size());
  const RockSurfaces own(made.specimen, made.aggregates, made.surfaces),
      again(made.specimen, read.aggregates, read.surfaces), spheres(made.specimen, {}, {});
  double most = 0, difference = 0;
  for (std::size_t k = 0; k < read.aggregates.size(); ++k) {
    const Aggregate &a = made.aggregates[k], &b = read.aggregates[k];
    EXPECT_EQ(a.body, b.body);
    EXPECT_EQ(a.surface >= 0, b.surface >= 0);
    EXPECT_NEAR(a.volume, b.volume, 1e-9 * a.volume);
    for (const Vec3d& corner : {Vec3d{0, 0, 0}, Vec3d{6.5e-3, 0, 8.5e-3}, Vec3d{0, 6.5e-3, 4e-3}}) {
      const double inside = own.fraction_inside(a.centre, corner);
      EXPECT_NEAR(again.fraction_inside(a.centre, corner), inside, 1e-9);
      most = std::max(most, inside);
      difference = std::max(difference, std::abs(inside - spheres.fraction_inside(a.centre, corner)));
    }
  }
  EXPECT_GT(most, 0.1);
  EXPECT_GT(difference, 1e-3);  // the spheres that fill a shape do not fill it completely
}

TEST_F(KnownAggregatesFile, FaultsAreNamed) {
  Specimen s;
  s.box.size = {0.02, 0.02, 0.02};
  s.centre = {{0.01, 0.01, 0.01}, {0.012, 0.01, 0.01}}, s.radius = {0.001, 0.001};
  s.phase = {Phase::aggregate, Phase::aggregate}, s.body = {0, 0};
  const std::string header = "body,shape,size,x,y,z\n", row = "0,sphere,0.006,0.01,0.01,0.01\n";
  EXPECT_EQ(message(header + row, s), "");
  EXPECT_NE(message("body,shape,size,x,y\n", s).find("no column z"), std::string::npos);
  EXPECT_NE(message(header + "1,sphere,0.006,0.01,0.01,0.01\n", s).find(":2: column body"), std::string::npos);
  EXPECT_NE(message(header + row + row, s).find(":3: column body"), std::string::npos);
  EXPECT_NE(message(header + "0,sphere,-1,0.01,0.01,0.01\n", s).find("column size"), std::string::npos);
  EXPECT_NE(message(header + "0,sphere,0.006,a,0.01,0.01\n", s).find("column x"), std::string::npos);
  EXPECT_NE(message(header + "0,sphere,0.006\n", s).find("3 fields"), std::string::npos);
  EXPECT_NE(message(header + "0,cube.off,0.006,0.01,0.01,0.01\n", s).find("column shape"), std::string::npos);
  EXPECT_NE(message(header + "0,aggregate_01,0.006,0.01,0.01,0.01\n", s).find("qw"), std::string::npos);
  EXPECT_NE(message("", s).find("nothing"), std::string::npos);
}

}  // namespace
}  // namespace macadam::test
