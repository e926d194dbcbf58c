// SPDX-License-Identifier: GPL-3.0-or-later
// shape_library_test.cpp  Tests the aggregate shapes that ship with the program, and the generator that made them.
#include <gtest/gtest.h>
#include <fmt/format.h>
#include <omp.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <string>

#include "host/shapes/library/library_targets.hpp"
#include "host/shapes/library/statistics.hpp"
#include "tests/support/long_tests.hpp"
#include "macadam/error.hpp"
#include "macadam/shape.hpp"

namespace macadam::test {
namespace {

namespace fs = std::filesystem;

constexpr int shipped_shapes = 82;

std::vector<Surface> read_folder(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".off") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<Surface> shapes;
  for (const fs::path& file : files) shapes.push_back(read_surface(file));
  return shapes;
}

const std::vector<Surface>& shipped() {
  static const std::vector<Surface> shapes = read_folder(MACADAM_EXAMPLES "/shapes");
  return shapes;
}

const std::vector<ShapeMeasure>& measures() {
  static const std::vector<ShapeMeasure> all = [] {
    std::vector<ShapeMeasure> m;
    for (const Surface& s : shipped()) m.push_back(measure_shape(s));
    return m;
  }();
  return all;
}

void expect_same(const Surface& a, const Surface& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.facets, b.facets) << a.name;
  const auto equal = [](const Vec3d& p, const Vec3d& q) { return p.x == q.x && p.y == q.y && p.z == q.z; };
  EXPECT_TRUE(std::equal(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(), equal)) << a.name;
}

using Property = std::function<double(const ShapeMeasure&)>;

/// Returns whether EN 933-3 and EN 933-4 apply to a shape; these standards apply to particles from 4 mm on.
bool standardised(const ShapeMeasure& m) { return m.d_intermediate >= 4e-3; }
bool any(const ShapeMeasure&) { return true; }

std::vector<double> values(const Property& property, bool (*counts)(const ShapeMeasure&) = any) {
  std::vector<double> v;
  for (const ShapeMeasure& m : measures()) {
    if (counts(m)) v.push_back(property(m));
  }
  return v;
}

double average(const std::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += x;
  return sum / static_cast<double>(v.size());
}

double correlation(const Property& a, const Property& b, bool (*counts)(const ShapeMeasure&) = any) {
  const std::vector<double> x = values(a, counts), y = values(b, counts);
  const double mx = average(x), my = average(y);
  double xx = 0, xy = 0, yy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mx) * (x[i] - mx);
    xy += (x[i] - mx) * (y[i] - my);
    yy += (y[i] - my) * (y[i] - my);
  }
  return xy / std::sqrt(xx * yy);
}

const Property d_long = [](const ShapeMeasure& m) { return m.d_long; };
const Property d_intermediate = [](const ShapeMeasure& m) { return m.d_intermediate; };
const Property d_short = [](const ShapeMeasure& m) { return m.d_short; };
const Property volume = [](const ShapeMeasure& m) { return m.volume; };
const Property area = [](const ShapeMeasure& m) { return m.area; };
const Property shape_index = [](const ShapeMeasure& m) { return m.shape_index(); };
const Property flatness = [](const ShapeMeasure& m) { return m.flatness(); };
const Property flakiness = [](const ShapeMeasure& m) { return m.flakiness(); };
const Property elongation = [](const ShapeMeasure& m) { return m.elongation(); };
const Property sphericity_true = [](const ShapeMeasure& m) { return m.sphericity_true; };
const Property sphericity_working = [](const ShapeMeasure& m) { return m.sphericity_working(); };

/// Compares a ratio with Table 1 in [1]. The average must be within 5 % of the average in [1]. The range must cover the
/// range in [1], to the two decimals printed there, and exceed it by at most 5 %.
void expect_ratio(const char* name, const std::vector<double>& v, double low, double mean, double high) {
  EXPECT_NEAR(average(v), mean, 0.05 * mean) << name;
  const auto [least, greatest] = std::minmax_element(v.begin(), v.end());
  EXPECT_LT(*least, low + 0.005) << name;
  EXPECT_GT(*greatest, high - 0.005) << name;
  EXPECT_GT(*least, 0.95 * low) << name;
  EXPECT_LT(*greatest, 1.05 * high) << name;
}

TEST(ShapeLibrary, FilesAreWhatTheGeneratorMakes) {
  if (!long_tests) GTEST_SKIP() << "6 s, ten times that in this build";
  const std::vector<Surface> made = generate_shape_library();
  ASSERT_EQ(shipped().size(), made.size());
  for (std::size_t i = 0; i < made.size(); ++i) expect_same(shipped()[i], made[i]);
}

TEST(ShapeLibrary, TheProgramCarriesTheFiles) {
  const std::vector<Surface> carried = shape_library();
  ASSERT_EQ(carried.size(), shipped().size());
  for (std::size_t i = 0; i < carried.size(); ++i) expect_same(carried[i], shipped()[i]);
}

TEST(ShapeLibrary, SameBitsForAnyNumberOfThreadsAndOtherShapesForOtherSeeds) {
  omp_set_num_threads(1);
  const std::vector<Surface> one = generate_shape_library(5, 4);
  omp_set_num_threads(3);
  const std::vector<Surface> three = generate_shape_library(5, 4), other = generate_shape_library(6, 4);
  ASSERT_EQ(one.size(), 4u);
  for (std::size_t i = 0; i < one.size(); ++i) {
    expect_same(one[i], three[i]);
    EXPECT_TRUE(check_surface(other[i]).good()) << check_surface(other[i]).text();
    EXPECT_NE(one[i].facets, other[i].facets);
  }
}

TEST(ShapeLibrary, OtherSeedsHaveTheRangesOfTable1AsWell) {
  for (const std::uint64_t seed : {2, 3}) {
    RandomStream random(seed, 0);
    const std::vector<ShapeMeasure> targets = draw_library_targets(random, shipped_shapes);
    for (const ShapeProperty& p : shape_properties()) {
      if (std::string(p.name) == "A") continue;  // A is a property of surfaces; the drawn targets have none
      const auto [low, mean, high] = p.paper;
      const Spread spread = spread_of(p, targets);
      EXPECT_NEAR(p.per_unit * spread.min / low, 1, 0.05) << p.name << ", seed " << seed;
      EXPECT_NEAR(p.per_unit * spread.average / mean, 1, 0.05) << p.name << ", seed " << seed;
      EXPECT_NEAR(p.per_unit * spread.max / high, 1, 0.05) << p.name << ", seed " << seed;
    }
  }
}

// The generator stretches a stone to its lengths in the last step. Most stones then have a sphericity within 0.8 % of
// their target.
TEST(ShapeLibrary, StonesAreWhatTheyWereToBe) {
  constexpr int shapes = 12;
  RandomStream random(1, 0);
  const std::vector<ShapeMeasure> targets = draw_library_targets(random, shapes);
  const std::vector<Surface> made = generate_shape_library(1, shapes);
  int near = 0;
  for (std::size_t i = 0; i < shapes; ++i) {
    const ShapeMeasure m = measure_shape(made[i]);
    EXPECT_EQ(m.points, targets[i].points);
    EXPECT_NEAR(m.d_long / targets[i].d_long, 1, 0.004) << i;
    EXPECT_NEAR(m.d_intermediate / targets[i].d_intermediate, 1, 0.004) << i;
    EXPECT_NEAR(m.d_short / targets[i].d_short, 1, 0.004) << i;
    const double off = std::abs(m.sphericity_true / targets[i].sphericity_true - 1);
    EXPECT_LT(off, 0.025) << i;
    near += off < 0.008;
  }
  EXPECT_GE(near, 10);
}

TEST(ShapeLibrary, NumberOfShapesIsChecked) {
  EXPECT_THROW(generate_shape_library(1, 0), InputError);
  EXPECT_THROW(generate_shape_library(1, -3), InputError);
  EXPECT_THROW(generate_shape_library(1, 1'000'000'000), InputError);
  EXPECT_EQ(generate_shape_library(1, 1).front().name, "aggregate_01");
}

TEST(ShapeLibrary, ShapesAreClosedOrientedAndWithoutSelfIntersections) {
  ASSERT_EQ(shipped().size(), static_cast<std::size_t>(shipped_shapes));
  for (const Surface& s : shipped()) {
    const SurfaceVerdict verdict = check_surface(s);
    EXPECT_TRUE(verdict.good()) << s.name << ": " << verdict.text();
    EXPECT_EQ(s.facets.size(), 2 * s.points.size() - 4) << s.name << ": a sphere's topology";
  }
}

TEST(ShapeLibrary, PointsAndFacetsLieInThePapersRange) {
  const auto points = values([](const ShapeMeasure& m) { return double(m.points); });
  const auto facets = values([](const ShapeMeasure& m) { return double(m.facets); });
  for (const double n : points) EXPECT_TRUE(n >= 25 && n <= 411) << n;
  for (const double n : facets) EXPECT_TRUE(n >= 46 && n <= 818) << n;
  EXPECT_NEAR(average(points), 167, 0.05 * 167);
  EXPECT_NEAR(average(facets), 330, 0.05 * 330);
  EXPECT_EQ(std::count_if(facets.begin(), facets.end(), [](double n) { return n < 100; }), 9);
}

TEST(ShapeLibrary, SieveClassesHoldAsManyAsThePapers) {
  std::map<double, int> found;  // number of shapes by the upper sieve of their class [mm]
  for (const ShapeMeasure& m : measures()) ++found[1e3 * sieve_class(m.d_intermediate)[1]];
  const std::vector<std::pair<double, int>> expected{{0.5, 1},  {1, 6},   {2, 17},   {4, 27},
                                                     {6.3, 14}, {10, 12}, {12.5, 4}, {16, 1}};
  ASSERT_EQ(found.size(), expected.size());
  auto row = found.begin();
  for (const auto& [sieve, shapes] : expected) {
    EXPECT_NEAR(row->first, sieve, 1e-9);
    EXPECT_EQ(row->second, shapes) << sieve << " mm";
    ++row;
  }
}

TEST(ShapeLibrary, RatiosHaveTheStatisticsOfTable1) {
  expect_ratio("SI", values(shape_index, standardised), 1.50, 2.55, 4.68);
  expect_ratio("F", values(flatness), 0.37, 0.64, 0.91);
  expect_ratio("Fl", values(flakiness, standardised), 0.31, 0.57, 0.85);
  expect_ratio("E", values(elongation), 0.39, 0.70, 0.97);
  expect_ratio("psi^w", values(sphericity_true), 0.73, 0.86, 0.96);
  expect_ratio("psi^A", values(sphericity_working), 0.68, 0.85, 0.94);
}

TEST(ShapeLibrary, DimensionsHaveTheStatisticsOfTable1) {
  struct Row {
    const char* name;
    const Property& property;
    double low, mean, high;
  };
  for (const auto& [name, property, low, mean, high] :
       {Row{"D^L", d_long, 1.02e-3, 5.95e-3, 18.66e-3}, Row{"D^I", d_intermediate, 0.48e-3, 3.94e-3, 12.59e-3},
        Row{"D^S", d_short, 0.32e-3, 2.56e-3, 8.83e-3}, Row{"V", volume, 0.07e-9, 84.23e-9, 851.22e-9},
        Row{"A", area, 1.05e-6, 80.60e-6, 511.19e-6}}) {
    const std::vector<double> v = values(property);
    EXPECT_NEAR(average(v), mean, 0.05 * mean) << name;
    const auto [least, greatest] = std::minmax_element(v.begin(), v.end());
    // the minimum is the value of a single shape, so its tolerance is large
    EXPECT_NEAR(*least, low, 0.1 * low) << name;
    EXPECT_NEAR(*greatest, high, 0.1 * high) << name;
  }
}

/// A row of Table 2 in [1]: a property of shapes and its correlations with the properties of earlier rows. The
/// properties SI and Fl are defined only for shapes of at least 4 mm.
struct Correlations {
  const char* name;
  const Property& property;
  bool standardised;
  std::vector<double> paper;
};
const std::vector<Correlations> table_2{
    {"D^L", d_long, false, {}},
    {"D^I", d_intermediate, false, {0.96}},
    {"D^S", d_short, false, {0.92, 0.91}},
    {"V", volume, false, {0.87, 0.88, 0.89}},
    {"A", area, false, {0.95, 0.95, 0.93, 0.98}},
    {"SI", shape_index, true, {-0.24, -0.28, -0.71, -0.35, -0.35}},
    {"F", flatness, false, {0.15, 0.05, 0.38, 0.18, 0.16, -0.83}},
    {"Fl", flakiness, true, {0.25, 0.02, 0.62, 0.24, 0.24, -0.79, 0.97}},
    {"E", elongation, false, {-0.31, -0.07, -0.17, -0.11, -0.15, -0.16, -0.32, -0.39}},
    {"psi^w", sphericity_true, false, {-0.34, -0.25, -0.06, -0.14, -0.21, -0.89, 0.55, 0.75, 0.51}},
    {"psi^A", sphericity_working, false, {-0.07, -0.03, 0.24, 0.11, 0.06, -0.98, 0.76, 0.86, 0.33, 0.89}},
};

/// Returns the difference of Fisher's z = artanh r between our shapes and those of [1], in standard errors. Two samples
/// of n shapes from one population have a standard error of √(2/(n − 3)).
double fisher_errors(double ours, double paper, std::size_t shapes) {
  return (std::atanh(ours) - std::atanh(paper)) / std::sqrt(2.0 / (static_cast<double>(shapes) - 3));
}

TEST(ShapeLibrary, CorrelationsAreThoseOfTable2) {
  double squares = 0;
  int pairs = 0;
  for (std::size_t i = 0; i < table_2.size(); ++i) {
    ASSERT_EQ(table_2[i].paper.size(), i);
    for (std::size_t k = 0; k < i; ++k) {
      const Correlations &a = table_2[i], &b = table_2[k];
      const auto counts = a.standardised || b.standardised ? standardised : any;
      const double ours = correlation(a.property, b.property, counts), paper = a.paper[k];
      const double errors = fisher_errors(ours, paper, values(a.property, counts).size());
      SCOPED_TRACE(fmt::format("{} and {}: {:.2f}, paper {:.2f}", a.name, b.name, ours, paper));
      const std::string pair = std::string(b.name) + ' ' + a.name;
      // The difference of one correlation in twenty would exceed two standard errors by chance. Fl divides by a sieve
      // size. The sieve classes in [1] are wider than the classes with which the Fl in [1] must have been computed; see
      // the next test.
      EXPECT_LT(std::abs(errors), pair == "F Fl" ? 2.5 : 2);
      // The generator pairs its target values until all correlations are met within 0.1, and makes stones that match
      // their targets to one per cent. SI is 1/(F·E); its correlation with F depends on how F and E of the few shapes
      // above 4 mm happen to be paired.
      EXPECT_NEAR(ours, paper, pair == "SI F" ? 0.2 : 0.12);
      squares += errors * errors, ++pairs;
    }
  }
  EXPECT_EQ(pairs, 55);
  EXPECT_LT(squares / pairs, 1);  // for two samples of one population the mean of the squares is 1
}

TEST(ShapeLibrary, FlakinessGoesWithFlatnessByTheSievesOfTheStandard) {
  const std::vector<double> sieves{4e-3, 5e-3, 6.3e-3, 8e-3, 10e-3, 12.5e-3, 16e-3};  // EN 933-3
  const Property narrow = [&](const ShapeMeasure& m) {
    return m.d_short / *std::upper_bound(sieves.begin(), sieves.end(), m.d_intermediate);
  };
  const std::size_t shapes = values(narrow, standardised).size();
  EXPECT_EQ(shapes, 31u);
  EXPECT_LT(std::abs(fisher_errors(correlation(narrow, flatness, standardised), 0.97, shapes)), 2);
}

/// Returns the volume of the tetrahedron of the origin and three unit vectors with these cosines between them.
double unit_tetrahedron(double a, double b, double c) {
  return std::sqrt(1 + 2 * a * b * c - a * a - b * b - c * c) / 6;
}

TEST(SubdividedIcosahedron, HasItsPointsOnTheSphereAndItsVolume) {
  const double radius = 6.295e-3;
  const Surface s = subdivided_icosahedron(radius);
  EXPECT_EQ(s.points.size(), 42u);
  EXPECT_EQ(s.facets.size(), 80u);
  EXPECT_TRUE(check_surface(s).good()) << check_surface(s).text();
  const double rounding = 8 * std::numeric_limits<double>::epsilon();
  for (const Vec3d& p : s.points) EXPECT_NEAR(norm(p), radius, rounding * radius);
  // Each of the 20 triangles is divided into a middle triangle, between edge midpoints 36° apart, and three triangles
  // at its corners.
  const double between_corners = 1 / std::sqrt(5.0), between_middles = std::numbers::phi / 2;
  const double corner_to_middle = std::sqrt((1 + between_corners) / 2);
  const double exact = 20 * unit_tetrahedron(between_middles, between_middles, between_middles) +
                       60 * unit_tetrahedron(corner_to_middle, corner_to_middle, between_middles);
  const ShapeMeasure m = measure_shape(s);
  EXPECT_NEAR(m.volume / std::pow(radius, 3), exact, 1e-13);  // 80 terms of O(0.05), each rounded a few times
  EXPECT_NEAR(m.d_long, 2 * radius, rounding * radius);
  EXPECT_NEAR(m.radius_bounding, radius, 1e-12 * radius);
}

TEST(SubdividedIcosahedron, IsTheOneThatShips) {
  const std::vector<Surface> files = read_folder(MACADAM_EXAMPLES "/icosahedron");
  ASSERT_EQ(files.size(), 1u);
  expect_same(files.front(), subdivided_icosahedron(6.295e-3));
}

TEST(SubdividedIcosahedron, RadiusIsChecked) {
  for (const double r : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(subdivided_icosahedron(r), InputError) << r;
}

int program(const std::string& arguments) {
  const int status =
      std::system(fmt::format("'{}' shapes generate {} >/dev/null 2>&1", MACADAM_PROGRAM, arguments).c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(ShapesGenerate, WritesWhatTheLibraryMakes) {
  const fs::path folder = fs::path(testing::TempDir()) / fmt::format("macadam_shapes_generate_{}", getpid());
  ASSERT_EQ(program(fmt::format("--out '{}' --seed 3 --count 2", (folder / "two").string())), 0);
  const std::vector<Surface> files = read_folder(folder / "two"), made = generate_shape_library(3, 2);
  ASSERT_EQ(files.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) expect_same(files[i], made[i]);
  ASSERT_EQ(program(fmt::format("--out '{}' --icosahedron 0.25", (folder / "ball").string())), 0);
  expect_same(read_folder(folder / "ball").at(0), subdivided_icosahedron(0.25));
  EXPECT_EQ(program(fmt::format("--out '{}' --count 0", folder.string())), 2);
  EXPECT_EQ(program(fmt::format("--out '{}' --icosahedron -1", folder.string())), 2);
  EXPECT_EQ(program(fmt::format("--out '{}' --count 2 --icosahedron 1", folder.string())), 2);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace macadam::test
