// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shaped_specimen_test.cpp  Tests specimens with shaped aggregates: each aggregate is a cluster of spheres,
/// mastic is outside of the clusters, and contact types follow from the touching particles.
#include <fmt/format.h>
#include <omp.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <map>

#include "host/shapes/surface/convex_hull.hpp"
#include "tests/support/test_files.hpp"

namespace macadam::test {
namespace {

/// Makes a folder with a few of the example shapes, because preparing all 82 takes longer than these tests.
fs::path few_shapes() {
  const fs::path folder = fs::path(testing::TempDir()) / fmt::format("macadam_few_shapes_{}", ::getpid());
  if (fs::create_directories(folder)) {
    for (const char* number : {"07", "19", "28", "41", "66"}) {
      const std::string name = fmt::format("aggregate_{}.off", number);
      fs::copy_file(fs::path(MACADAM_EXAMPLES) / "shapes" / name, folder / name);
    }
    static const struct Remover {
      fs::path folder;
      ~Remover() { fs::remove_all(folder); }
    } remover{folder};
  }
  return folder;
}

SpecimenSpec recipe(ShapeSpec::Library library, PlacementMethod placement = PlacementMethod::insertion) {
  SpecimenSpec spec;
  spec.box = {{0.022, 0.022, 0.024}};
  spec.seed = 3;
  spec.aggregate = {{4.75e-3, 9.5e-3, std::nullopt, 6}, {2e-3, 4.75e-3, std::nullopt, 40}};
  spec.mastic = {0.75e-3, 1e-3, 0.05, std::nullopt};
  spec.shapes.emplace();
  spec.shapes->library = library;
  if (library == ShapeSpec::Library::folder) spec.shapes->folder = few_shapes();
  spec.shapes->placement = placement;
  spec.shapes->fill.radius_min = 0.75e-3;
  spec.shapes->fill.radius_max = 1e-3;
  spec.shapes->fill.porosity = 0;
  return spec;
}

/// Returns a specimen that is made once and shared by all tests that do not change it.
const GeneratedSpecimen& made_of(ShapeSpec::Library library) {
  static std::map<ShapeSpec::Library, GeneratedSpecimen> made;
  const auto found = made.find(library);
  return found != made.end() ? found->second : made[library] = generate_specimen(recipe(library));
}

class ShapedSpecimen : public testing::TestWithParam<ShapeSpec::Library> {
 protected:
  const GeneratedSpecimen& made_ = made_of(GetParam());
};
INSTANTIATE_TEST_SUITE_P(All, ShapedSpecimen,
                         testing::Values(ShapeSpec::Library::folder, ShapeSpec::Library::icosahedron),
                         [](const auto& info) {
                           return info.param == ShapeSpec::Library::folder ? "aggregates" : "icosahedron";
                         });

TEST_P(ShapedSpecimen, AggregatesAreTheSpheresOfTheirBodies) {
  const Specimen& s = made_.specimen;
  const std::vector<AggregateClass> classes = recipe(GetParam()).aggregate;
  ASSERT_EQ(made_.aggregates.size(), 46);
  std::map<std::int32_t, std::int64_t> spheres;
  for (std::size_t i = 0; i < s.size(); ++i) {
    EXPECT_EQ(s.phase[i] == Phase::mastic, s.body[i] == -1);
    if (s.body[i] >= 0) ++spheres[s.body[i]];
  }
  std::int64_t clusters = 0, single = 0;
  std::vector<double> volume(2, 0.0);
  for (const Aggregate& a : made_.aggregates) {
    EXPECT_EQ(spheres[a.body], a.spheres);
    (a.spheres > 1 ? clusters : single) += 1;
    EXPECT_EQ(a.spheres == 1, a.shape == "sphere");
    if (a.spheres > 1) {
      EXPECT_GE(a.spheres, 8);
      EXPECT_NEAR(norm(a.axis_long), 1, 1e-12);
    }
    const AggregateClass& c = classes[static_cast<std::size_t>(a.size_class)];
    EXPECT_GE(a.size, c.sieve_min * (1 - 1e-12));
    EXPECT_LE(a.size, c.sieve_max * (1 + 1e-12));
    volume[static_cast<std::size_t>(a.size_class)] += a.volume;
  }
  EXPECT_GT(clusters, 0);
  EXPECT_GT(single, 0);
  ASSERT_EQ(made_.composition.size(), 3);
  for (std::size_t k = 0; k < 2; ++k)
    EXPECT_NEAR(made_.composition[k].fraction, volume[k] / s.box.volume(), 1e-12) << made_.composition[k].name;
}

TEST_P(ShapedSpecimen, SpheresOfAnAggregateStayTogether) {
  std::map<std::int32_t, const Aggregate*> of;
  for (const Aggregate& a : made_.aggregates) of[a.body] = &a;
  const Specimen& s = made_.specimen;
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (s.body[i] < 0) continue;
    const Aggregate& a = *of.at(s.body[i]);
    // no point of a shape is farther from an inner point than D^L; spheres may protrude by a part of their radius
    EXPECT_LE(norm(s.centre[i] - a.centre) + s.radius[i], a.d_long + 0.3 * s.radius[i]) << i;
  }
}

TEST_P(ShapedSpecimen, MasticLeavesTheShapesAndFillsThePorosity) {
  const Specimen& s = made_.specimen;
  double solid = 0;
  for (const Aggregate& a : made_.aggregates) solid += a.volume;
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (s.phase[i] == Phase::mastic) solid += 4 * M_PI / 3 * std::pow(s.radius[i], 3);
  }
  // the number of spheres is an integer, so the volume may be off by one sphere
  const double sphere = 4 * M_PI / 3 * std::pow(1e-3, 3);
  EXPECT_NEAR(solid, 0.95 * s.box.volume(), sphere);
  EXPECT_TRUE(particles_without_cell(s).empty());
}

TEST_P(ShapedSpecimen, MasticHasTheVolumeAndTheRadiiAskedFor) {
  const Specimen& s = made_.specimen;
  const MasticSpec asked = *recipe(GetParam()).mastic;
  std::int64_t count = 0;
  double volume = 0, radii = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (s.phase[i] != Phase::mastic) continue;
    ++count, volume += 4 * M_PI / 3 * std::pow(s.radius[i], 3), radii += s.radius[i];
    EXPECT_GE(s.radius[i], asked.radius_min);
    EXPECT_LE(s.radius[i], asked.radius_max);
    for (const double x : {s.centre[i].x / s.box.size.x, s.centre[i].y / s.box.size.y, s.centre[i].z / s.box.size.z}) {
      EXPECT_GT(x, 0);
      EXPECT_LT(x, 1);
    }
  }
  // One radius is taken from each of n equal parts of the range, then all are adjusted to the volume. The number n is
  // rounded, so the adjustment changes the volume by at most half a sphere.
  EXPECT_NEAR(radii / static_cast<double>(count), 0.5 * (asked.radius_min + asked.radius_max), 1e-3 * asked.radius_max);
  double aggregates = 0;
  for (const Aggregate& a : made_.aggregates) aggregates += a.volume;
  const CompositionRow& row = made_.composition.back();
  EXPECT_EQ(row.name, "mastic");
  EXPECT_EQ(row.count, count);
  EXPECT_EQ(row.count_asked, count);
  EXPECT_NEAR(row.fraction, volume / s.box.volume(), 1e-12);
  EXPECT_NEAR(row.fraction_asked, 1 - *asked.porosity - aggregates / s.box.volume(), 1e-12);
  EXPECT_NEAR(row.fraction, row.fraction_asked, 1e-12);
}

/// Returns how deep a point is inside the convex hull of some points; negative outside.
class Hull {
 public:
  explicit Hull(const std::vector<Vec3d>& points) : points_(points), facets_(convex_hull(points)) {}
  double depth(const Vec3d& x) const {
    double least = INFINITY;
    for (const auto& [a, b, c] : facets_) {
      const Vec3d n = cross(points_[b] - points_[a], points_[c] - points_[a]);
      least = std::min(least, dot(n, points_[a] - x) / norm(n));
    }
    return least;
  }

 private:
  std::vector<Vec3d> points_;
  std::vector<std::array<std::int32_t, 3>> facets_;
};

// The points include midpoints of edges and faces of a box. For points in one plane CGAL chooses facets by memory
// addresses, which differ from run to run; the result must not.
TEST(ConvexHull, SidesAreDividedByTheirCornersAlone) {
  std::vector<Vec3d> points;
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) points.push_back({i * 0.1, j * 0.2, k * 0.3});
  const std::vector<std::array<std::int32_t, 3>> expected{{0, 2, 20},  {0, 6, 8},  {0, 8, 2},    {0, 18, 24},
                                                          {0, 20, 18}, {0, 24, 6}, {2, 8, 26},   {2, 26, 20},
                                                          {6, 24, 26}, {6, 26, 8}, {18, 20, 26}, {18, 26, 24}};
  EXPECT_EQ(convex_hull(points), expected);
}

// Mastic spheres stay outside of the clusters. In a contact of mastic with a sphere of a cluster both spheres yield
// equally, as in any other contact. Still no mastic sphere gets inside a cluster.
TEST_P(ShapedSpecimen, MasticStaysOutsideTheClusters) {
  const Specimen& s = made_.specimen;
  std::map<std::int32_t, std::vector<Vec3d>> clusters;
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (s.body[i] >= 0) clusters[s.body[i]].push_back(s.centre[i]);
  }
  std::int64_t inside = 0;
  double deepest = -INFINITY, largest_overlap = 0;
  for (const auto& [body, centres] : clusters) {
    if (centres.size() == 1) continue;
    const Hull hull(centres);
    Vec3d middle{};
    for (const Vec3d& c : centres) middle += (1.0 / static_cast<double>(centres.size())) * c;
    EXPECT_GT(hull.depth(middle), 0);
    for (std::size_t i = 0; i < s.size(); ++i) {
      if (s.phase[i] != Phase::mastic) continue;
      const double depth = hull.depth(s.centre[i]);
      inside += depth > 0 ? 1 : 0;
      deepest = std::max(deepest, depth / s.radius[i]);
      for (std::size_t k = 0; k < s.size(); ++k) {
        if (s.body[k] != body) continue;
        const double sum = s.radius[i] + s.radius[k];
        largest_overlap = std::max(largest_overlap, 1 - norm(s.centre[i] - s.centre[k]) / sum);
      }
    }
  }
  fmt::print("deepest mastic centre {:.2f} of its radius in a hull, largest overlap {:.2f}\n", deepest,
             largest_overlap);
  EXPECT_EQ(inside, 0);
  EXPECT_LT(largest_overlap, 0.5);  // no centre inside another sphere
}

TEST_P(ShapedSpecimen, ContactsAreInnerWithinABodyAndNowhereElse) {
  const Specimen& s = made_.specimen;
  const ContactNetwork network = build_network(s, tessellate(s));
  for (const Contact& c : network.contacts) {
    if (c.b < 0) continue;
    const auto a = static_cast<std::size_t>(c.a), b = static_cast<std::size_t>(c.b);
    const bool both = s.phase[a] == Phase::aggregate && s.phase[b] == Phase::aggregate;
    EXPECT_EQ(c.pair == PairType::inner, both && s.body[a] == s.body[b]);
    EXPECT_EQ(c.pair == PairType::aa, both && s.body[a] != s.body[b]);
  }
  EXPECT_GT(network.count[static_cast<std::size_t>(PairType::inner)], 0);
}

TEST_P(ShapedSpecimen, SameSeedSameBitsForAnyNumberOfThreads) {
  const int before = omp_get_max_threads();
  for (int t : {1, 3}) {
    omp_set_num_threads(t);
    const Specimen again = generate_specimen(recipe(GetParam())).specimen;
    omp_set_num_threads(before);
    ASSERT_EQ(again.size(), made_.specimen.size());
    for (std::size_t i = 0; i < again.size(); ++i) {
      ASSERT_EQ(again.centre[i].x, made_.specimen.centre[i].x) << i << ", " << t << " threads";
      ASSERT_EQ(again.radius[i], made_.specimen.radius[i]) << i;
    }
  }
}

TEST(ShapedSpecimens, AreWrittenALineAnAggregate) {
  const GeneratedSpecimen& made = made_of(ShapeSpec::Library::icosahedron);
  const fs::path file = fs::path(testing::TempDir()) / fmt::format("aggregates_{}.csv", ::getpid());
  std::vector<Aggregate> aggregates = made.aggregates;
  aggregates[1].shape = "stone,\"1\"";  // a user's file may have such a name
  write_aggregates_csv(file, aggregates, made.composition);
  const std::string text = read(file);
  fs::remove(file);
  EXPECT_NE(text.find(",\"stone,\"\"1\"\"\","), std::string::npos);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 47);
  EXPECT_NE(text.find("4.75-9.5 mm"), std::string::npos);
}

TEST(ShapedSpecimens, SingleSpheresFollowTheirRule) {
  const Surface ball = subdivided_icosahedron();
  const ShapeMeasure m = measure_shape(ball);
  const std::pair<SingleSphere, double> rules[] = {
      {SingleSphere::circumscribed, 2 * m.radius_bounding / m.d_intermediate},
      {SingleSphere::volume, std::cbrt(6 / M_PI * m.volume) / m.d_intermediate}};
  for (const auto& [rule, diameter] : rules) {
    SpecimenSpec spec = recipe(ShapeSpec::Library::icosahedron, PlacementMethod::packing);
    spec.aggregate = {{2e-3, 4.75e-3, 0.4, std::nullopt}};
    spec.shapes->fill.single = rule;
    const GeneratedSpecimen made = generate_specimen(spec);
    std::int64_t single = 0;
    double volume = 0;
    for (const Aggregate& a : made.aggregates) {
      volume += a.volume;
      if (a.shape != "sphere") continue;
      ++single;
      EXPECT_NEAR(a.d_long, diameter * a.size, 1e-12 * a.size);
      EXPECT_NEAR(a.volume, M_PI / 6 * std::pow(a.d_long, 3), 1e-12 * a.volume);
      const auto i = std::find(made.specimen.body.begin(), made.specimen.body.end(), a.body);
      EXPECT_EQ(made.specimen.radius[i - made.specimen.body.begin()], a.d_long / 2);
    }
    EXPECT_GT(single, 0);
    EXPECT_NEAR(volume / spec.box.volume(), made.composition[0].fraction_asked,
                1e-3 * made.composition[0].fraction_asked);
    for (std::size_t k = 0; k < made.aggregates.size(); ++k)
      for (std::size_t j = 0; j < k; ++j) {
        const Aggregate &a = made.aggregates[k], &b = made.aggregates[j];
        if (a.shape != "sphere" || b.shape != "sphere") continue;
        EXPECT_GT(norm(a.centre - b.centre), (a.d_long + b.d_long) / 2) << k << " and " << j;
      }
  }
}

/// If overlap of aggregates is tested with their spheres, spheres of different aggregates do not overlap and keep the
/// spacing. All spheres are in the box.
TEST(ShapedSpecimens, MayBeTestedByTheirSpheres) {
  for (const double spacing : {0.0, 2e-4}) {
    SpecimenSpec spec = recipe(ShapeSpec::Library::icosahedron);
    spec.shapes->test = PlacementTest::spheres;
    spec.spacing = spacing;
    const Specimen s = generate_specimen(spec).specimen;
    const Specimen& by_surfaces = made_of(ShapeSpec::Library::icosahedron).specimen;
    for (std::size_t i = 0; i < s.size() && s.body[i] >= 0; ++i) {
      EXPECT_EQ(s.radius[i], by_surfaces.radius[i]) << i;  // the fillings are the same
      for (std::size_t j = 0; j < i; ++j) {
        if (s.body[i] == s.body[j]) continue;
        EXPECT_GE(norm(s.centre[i] - s.centre[j]), s.radius[i] + s.radius[j] + spacing - 1e-15)
            << i << " " << j;  // 1e-15 m: rounding of positions in a box of centimetres
      }
      const Vec3d x = s.centre[i], l = s.box.size;
      EXPECT_GE(std::min({x.x, x.y, x.z, l.x - x.x, l.y - x.y, l.z - x.z}), s.radius[i] - 1e-15) << i;
    }
    EXPECT_NE(s.centre[0].x, by_surfaces.centre[0].x);
  }
}

/// Measures how far mastic reaches below the surfaces of clusters, which are nearly balls. The option hold_out must
/// reduce this depth.
TEST(ShapedSpecimens, HoldMasticOut) {
  const ShapeMeasure m = measure_shape(subdivided_icosahedron());
  // radius of the ball of equal volume, over D^I
  const double ball = std::cbrt(6 / M_PI * m.volume) / 2 / m.d_intermediate;
  const auto depth = [&](double hold_out) {
    SpecimenSpec spec = recipe(ShapeSpec::Library::icosahedron);
    spec.shapes->hold_out = hold_out;
    const GeneratedSpecimen made = generate_specimen(spec);
    double sum = 0;
    for (const Aggregate& a : made.aggregates)
      for (std::size_t i = 0; a.spheres > 1 && i < made.specimen.size(); ++i)
        if (made.specimen.body[i] < 0)
          sum += std::max(0.0, ball * a.size + made.specimen.radius[i] - norm(made.specimen.centre[i] - a.centre));
    return sum;
  };
  const double free = depth(0), held = depth(10);
  // With hold_out = 10 the surface is ten times as stiff as a sphere. The depth is reduced by less, because several
  // spheres share a surface.
  EXPECT_LT(held, 0.7 * free);
  EXPECT_LT(depth(1), free);
}

TEST(ShapedSpecimens, TakeTheIcosahedronAsOneMoreOfTheLibrary) {
  SpecimenSpec spec = recipe(ShapeSpec::Library::aggregates_and_icosahedron);
  spec.mastic.reset();
  spec.aggregate = {{2e-3, 3e-3, std::nullopt, 60}};
  spec.shapes->fill.radius_min = spec.shapes->fill.radius_max = 0.5e-3;
  spec.shapes->fill.least = 2;
  std::map<std::string, int> times;
  const std::string icosahedron = subdivided_icosahedron().name;
  // Each seed draws 60 aggregates from 83 shapes, so each shape is expected 60/83 = 0.7 times per seed.
  for (spec.seed = 1; spec.seed <= 10 && times[icosahedron] == 0; ++spec.seed)
    for (const Aggregate& a : generate_specimen(spec).aggregates) ++times[a.shape];
  EXPECT_GT(times[icosahedron], 0);
  EXPECT_LT(times[icosahedron], 6);
  EXPECT_GT(times.size(), 30u);
}

TEST(ShapedSpecimens, OfAnotherSeedAreOthers) {
  SpecimenSpec other = recipe(ShapeSpec::Library::icosahedron);
  other.seed = 4;
  EXPECT_NE(generate_specimen(other).specimen.centre[0].x,
            made_of(ShapeSpec::Library::icosahedron).specimen.centre[0].x);
}

TEST(ShapedSpecimens, MayNotLetTheirSpheresGo) {
  SpecimenSpec spec = recipe(ShapeSpec::Library::icosahedron);
  spec.fix_aggregates = false;
  EXPECT_THROW(generate_specimen(spec), InputError);
}

TEST(ShapedSpecimens, SayHowFarTheyGotWhereThereIsNoRoom) {
  SpecimenSpec spec = recipe(ShapeSpec::Library::icosahedron);
  spec.attempts = 2000;
  spec.aggregate[0].count = 60;
  EXPECT_HAS(message_of([&] { generate_specimen(spec); }), "4.75-9.5 mm");
  spec.shapes->allow_short = true;
  const GeneratedSpecimen made = generate_specimen(spec);
  EXPECT_LT(made.composition[0].count, 60);
  EXPECT_EQ(made.composition[0].count_asked, 60);
}

}  // namespace
}  // namespace macadam::test
