// SPDX-License-Identifier: GPL-3.0-or-later
/// \file ct_phantom_test.cpp  Tests synthetic scans (phantoms): volumes of known grains, sawn faces, artefacts of the
/// requested size, and the written files.
#include "macadam/phantom.hpp"

#include <unistd.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "tests/tools/ct/ct_scenes.hpp"
#include "host/tools/ct/synthetic/voxelise.hpp"

namespace macadam::test {
namespace {

constexpr double pi = std::numbers::pi;

class CtPhantom : public CtFolder {};

/// Returns a specification without artefacts, so that grey values are the fractions of phases in a voxel.
PhantomSpec clean(double voxel) {
  PhantomSpec spec;
  spec.voxel = voxel;
  spec.air = 0.4e-3;
  spec.blur = spec.noise = spec.cupping = spec.rings = spec.drift = 0;
  return spec;
}

/// Returns the volume of the voxels of each label.
std::vector<double> label_volumes(const Phantom& p) {
  std::vector<double> out(p.grains.size() + 1);
  for (const std::uint32_t label : p.labels.voxels) out.at(label) += p.labels.voxel_volume();
  return out;
}

/// The part of each voxel that a sphere covers does not depend on the origin of the grid.
TEST(CtCoverage, OfAGridThatBeginsElsewhereIsTheSame) {
  const Vec3d shift{3e-3, -2e-3, 5e-3};
  const auto of = [](const Vec3d& at) {
    const Image<float> grid({20, 21, 22}, {1e-3, 1.1e-3, 1.2e-3}, at);
    const ct::SawnCore core{at + Vec3d{2e-3, 2e-3, 2e-3}, at + Vec3d{18e-3, 18e-3, 18e-3}};
    return ct::cover({nullptr, at + Vec3d{9.1e-3, 8.2e-3, 10.3e-3}, 4e-3}, core, grid, 4);
  };
  const ct::Coverage here = of({}), there = of(shift);
  EXPECT_EQ(there.begin, here.begin);
  EXPECT_EQ(there.end, here.end);
  // Each column of voxels ends at the surface of a sphere. This end is computed from differences of coordinates, which
  // are accurate to about 1e-18 m.
  EXPECT_NEAR(there.volume / here.volume, 1, 1e-9);
  EXPECT_LT(norm(there.centroid - here.centroid - shift), 1e-12);
  ASSERT_EQ(there.share.size(), here.share.size());
  for (std::size_t i = 0; i < here.share.size(); ++i)
    EXPECT_NEAR(there.share[i], here.share[i], 1e-5) << i;  // floats, sums of 16 terms
}

TEST_F(CtPhantom, ASphereHasItsVolumeInGreyValuesAndLabels) {
  const Phantom p = make_phantom(spheres_scene(), clean(0.2e-3));
  EXPECT_EQ(p.scan.size, (std::array<std::int64_t, 3>{54, 44, 44}));
  ASSERT_EQ(p.grains.size(), 1U);
  const PhantomGrain& g = p.grains.front();
  const double volume = 4 * pi / 3 * 27e-9, air = 4 * pi / 3 * 1e-9, box = 10e-3 * 8e-3 * 8e-3;
  EXPECT_FALSE(g.border);
  EXPECT_NEAR(g.volume / volume, 1, 1e-12);
  EXPECT_NEAR(g.area / (4 * pi * 9e-6), 1, 1e-12);
  EXPECT_NEAR(g.sieve / 6e-3, 1, 1e-12);
  EXPECT_NEAR(measure_shape(g.surface).volume / volume, 1, 1e-9);
  // Volumes are summed over columns whose cross-section is a ninth of the cross-section of a voxel. About N = 2,000
  // columns pass through the cross-section of the sphere. The error decreases as N^(-3/4).
  EXPECT_NEAR(p.aggregate, volume / box, 3e-3 * volume / box);
  EXPECT_NEAR(p.voids, air / box, 1e-2 * air / box);
  // A voxel gets the label if more than half of it is in the sphere.
  EXPECT_NEAR(label_volumes(p)[1] / volume, 1, 1e-2);
  double sum = 0;
  for (std::size_t v = 0; v < p.scan.count(); ++v) {
    const double grey = p.scan.voxels[v];
    EXPECT_TRUE(grey >= 6000 && grey <= 42000);
    sum += (grey - 6000) * p.scan.voxel_volume();
  }
  const double expected = 36000 * volume + 24000 * (box - volume - air);
  EXPECT_NEAR(sum / expected, 1, 2e-3);
  EXPECT_EQ(p.scan.at(0, 0, 0), 6000);
  EXPECT_EQ(p.phases.at(0, 0, 0), 255);
}

TEST_F(CtPhantom, TheSawLeavesCaps) {
  PhantomSpec spec = clean(0.1e-3);
  // leaves a box of 6 × 4 × 4 mm, which cuts the sphere of radius 3 mm about (3.5, 4, 4) mm on five sides
  spec.sawn = 2e-3;
  const Phantom p = make_phantom(spheres_scene(), spec);
  EXPECT_NEAR(p.specimen.box.size.x, 6e-3, 1e-15);
  ASSERT_EQ(p.grains.size(), 1U);
  EXPECT_TRUE(p.grains[0].border);
  EXPECT_NEAR(label_volumes(p)[1] / p.grains[0].volume, 1, 1e-2);
  for (std::size_t v = 0; v < p.phases.count(); ++v) {
    if (p.phases.voxels[v] == 255) { EXPECT_EQ(p.labels.voxels[v], 0U); }
  }
  // The expected volume is the volume of the sphere between z = 2 and 6 mm over the sawn rectangle, integrated
  // numerically over columns.
  double sum = 0;
  const int n = 600;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double x = 2 + 6.0 * (i + 0.5) / n, y = 2 + 4.0 * (j + 0.5) / n;
      const double square = 9 - (x - 3.5) * (x - 3.5) - (y - 4) * (y - 4);
      if (square > 0) sum += std::min(4.0, 2 * std::sqrt(square)) * 24.0 / n / n;
    }
  }
  EXPECT_NEAR(p.grains[0].volume / (sum * 1e-9), 1, 1e-3);
}

/// A grain counts as cut by the saw even if only its lower side is cut. Volume and centre are computed from the part of
/// the sphere that is left.
TEST_F(CtPhantom, ASphereCutFromBelowAloneIsCut) {
  const Scene scene = scene_of_rows("0,0.005,0.004,0.0033,0.003,aggregate,4\n");  // lowest point 0.3 mm above z = 0
  const auto sawn_by = [&](double off) {
    PhantomSpec spec = clean(0.1e-3);
    spec.sawn = off;
    return make_phantom(scene, spec).grains.at(0);
  };
  // volume of the cap, πh²(3r − h)/3
  const double volume = 4 * pi / 3 * 27e-9, cap = pi * 0.36e-6 * (9e-3 - 0.6e-3) / 3;
  const PhantomGrain whole = sawn_by(0.2e-3), cut = sawn_by(0.9e-3);
  EXPECT_FALSE(whole.border);
  EXPECT_NEAR(whole.volume / volume, 1, 1e-12);
  EXPECT_TRUE(cut.border);
  EXPECT_NEAR(cut.volume / (volume - cap), 1, 1e-3);
  // About the centre of a sphere, the cap between the heights a and r has the first moment π(r² − a²)²/4. Here a is 2.4
  // mm, and the cut shifts the centroid by 0.075 mm.
  const double moment = pi / 4 * std::pow(9e-6 - 5.76e-6, 2);
  EXPECT_NEAR(cut.centre.z, 2.4e-3 + moment / (volume - cap), 2e-6);
  EXPECT_NEAR(cut.centre.x, 4.1e-3, 2e-6);
  EXPECT_NEAR(cut.centre.y, 3.1e-3, 2e-6);
}

TEST_F(CtPhantom, ACylinderHasNoCorners) {
  PhantomSpec spec = clean(0.2e-3);
  spec.shape = CoreShape::cylinder;
  const Phantom p = make_phantom(spheres_scene(), spec);
  const auto inside = std::count_if(p.phases.voxels.begin(), p.phases.voxels.end(), [](auto v) { return v != 255; });
  EXPECT_NEAR(static_cast<double>(inside) * p.phases.voxel_volume() / (pi * 16e-6 * 8e-3), 1, 1e-2);
}

TEST_F(CtPhantom, ShapesFillTheirVoxels) {
  const Phantom p = make_phantom(shapes_scene(), clean(0.2e-3));
  ASSERT_GE(p.grains.size(), 4U);
  const std::vector<double> volumes = label_volumes(p);
  for (const PhantomGrain& g : p.grains) {
    EXPECT_FALSE(g.border);
    const ShapeMeasure m = measure_shape(g.surface);
    EXPECT_NEAR(m.volume / g.volume, 1, 1e-9);
    EXPECT_NEAR(m.area / g.area, 1, 1e-9);
    EXPECT_NEAR(m.d_long / g.d_long, 1, 1e-9);
    // The search for the sieve size tries fixed directions, which do not rotate with the grain. At the end of the
    // search they are a quarter of a degree apart.
    EXPECT_NEAR(square_sieve(g.surface) / g.sieve, 1, 5e-3);
    EXPECT_LT(norm(m.centroid - g.centre), 1e-9);
    EXPECT_NEAR(volumes[g.id] / g.volume, 1, 2e-2) << g.id;  // about 4,000 voxels, of which the surface cuts 1,200
  }
  EXPECT_EQ(p.specimen.voids.empty(), false);
  for (const GrainGap& gap : p.gaps) {
    EXPECT_LT(gap.a, gap.b);
    EXPECT_GT(gap.gap, 0);  // the generator does not let particles touch
    EXPECT_LE(gap.gap, 3 * 0.2e-3);
  }
}

/// Returns mean and standard deviation of the grey values of the chosen voxels.
template <class Choose>
std::pair<double, double> statistics(const Phantom& p, const Choose& chosen) {
  double n = 0, sum = 0, squares = 0;
  for (std::int64_t k = 0; k < p.scan.size[2]; ++k) {
    for (std::int64_t j = 0; j < p.scan.size[1]; ++j) {
      for (std::int64_t i = 0; i < p.scan.size[0]; ++i) {
        if (!chosen(i, j, k)) continue;
        const double v = p.scan.at(i, j, k);
        n += 1, sum += v, squares += v * v;
      }
    }
  }
  return {sum / n, std::sqrt(squares / n - sum / n * (sum / n))};
}

TEST_F(CtPhantom, SamplesThatAreNoneOrTooManyAreRefused) {
  PhantomSpec spec = clean(0.5e-3);
  for (const int samples : {0, 17}) {
    spec.samples = samples;
    EXPECT_THROW(make_phantom(spheres_scene(), spec), InputError) << samples;
  }
  for (const int samples : {1, 16}) {
    spec.samples = samples;
    EXPECT_NO_THROW(make_phantom(spheres_scene(), spec)) << samples;
  }
}

/// Noise, cupping, drift, rings and blur have the requested size. Each is measured where it shows: in the air, on the
/// axis, between slices and in the phases.
TEST_F(CtPhantom, FaultsAreAsLargeAsAsked) {
  const Scene scene = spheres_scene();
  const auto scanned = [&](double PhantomSpec::*fault, double value) {
    PhantomSpec spec = clean(0.2e-3);
    spec.*fault = value;
    return make_phantom(scene, spec);
  };
  const auto in_phase = [](const Phantom& p, int phase) {
    return [&p, phase](auto i, auto j, auto k) { return p.phases.at(i, j, k) == phase; };
  };
  const Phantom noisy = scanned(&PhantomSpec::noise, 0.05);
  const auto corner = [](auto i, auto, auto) { return i < 2; };
  // The standard deviation of 3,872 voxels is accurate to 1.1 %. No grey value is clipped, because air is 3.3 standard
  // deviations above 0.
  EXPECT_NEAR(statistics(noisy, corner).second, 1800, 75);
  const Phantom cupped = scanned(&PhantomSpec::cupping, 0.2);
  const auto axis = [](auto i, auto j, auto k) { return (i == 26 || i == 27) && (j == 21 || j == 22) && k == 22; };
  EXPECT_NEAR(statistics(cupped, axis).first, 0.8 * 42000, 0.01 * 42000);
  const Phantom drifted = scanned(&PhantomSpec::drift, 0.05);
  std::set<double> means;
  for (std::int64_t slice = 0; slice < 44; ++slice)
    means.insert(statistics(drifted, [&](auto i, auto, auto k) { return k == slice && i < 2; }).first);
  EXPECT_GT(*means.rbegin() - *means.begin(), 0.05 * 6000);
  EXPECT_LT(*means.rbegin() - *means.begin(), 0.3 * 6000);
  const Phantom ringed = scanned(&PhantomSpec::rings, 0.05);
  EXPECT_NEAR(statistics(ringed, corner).second, 1800, 500);      // about 20 rings pass through this region
  EXPECT_EQ(ringed.scan.at(0, 0, 5), ringed.scan.at(53, 43, 5));  // the same distance from the axis
  const Phantom sharp = make_phantom(scene, clean(0.2e-3)), blurred = scanned(&PhantomSpec::blur, 1.5);
  EXPECT_NEAR(statistics(blurred, in_phase(blurred, 2)).first, statistics(sharp, in_phase(sharp, 2)).first, 1500);
  EXPECT_GT(statistics(blurred, in_phase(blurred, 0)).first, statistics(sharp, in_phase(sharp, 0)).first + 2000);
}

TEST_F(CtPhantom, TheSameSeedsGiveTheSameBits) {
  PhantomSpec spec;
  spec.voxel = 0.3e-3;
  const Phantom a = make_phantom(shapes_scene(), spec), b = make_phantom(shapes_scene(), spec);
  EXPECT_EQ(a.scan.voxels, b.scan.voxels);
  EXPECT_EQ(a.labels.voxels, b.labels.voxels);
  spec.seed = 2;
  const Phantom c = make_phantom(shapes_scene(), spec);
  EXPECT_NE(a.scan.voxels, c.scan.voxels);
  EXPECT_EQ(a.labels.voxels, c.labels.voxels);
}

TEST_F(CtPhantom, FilesHoldAllOfIt) {
  const Scene scene = shapes_scene();
  PhantomSpec spec;
  spec.voxel = 0.4e-3;
  const Phantom p = make_phantom(scene, spec);
  write_phantom(folder_ / "p", p, scene, spec);
  EXPECT_EQ(read_image<std::uint16_t>(folder_ / "p" / "scan.mha").voxels, p.scan.voxels);
  EXPECT_EQ(read_image<std::uint32_t>(folder_ / "p" / "truth" / "labels.mha").voxels, p.labels.voxels);
  EXPECT_EQ(read_image<std::uint8_t>(folder_ / "p" / "truth" / "phases.mha").voxels, p.phases.voxels);
  const Specimen s = read_specimen_csv(folder_ / "p" / "truth" / "specimen.csv", p.specimen.box);
  EXPECT_EQ(s.radius, p.specimen.radius);
  EXPECT_EQ(s.voids.size(), p.specimen.voids.size());
  const std::string grains = read(folder_ / "p" / "truth" / "grains.csv");
  EXPECT_EQ(grains.find("id,x,y,z,volume_m3,area_m2,d_long_m,d_intermediate_m,d_short_m,"), 0U);
  EXPECT_EQ(std::count(grains.begin(), grains.end(), '\n'), static_cast<std::ptrdiff_t>(p.grains.size()) + 1);
  EXPECT_EQ(read_shape_library(folder_ / "p" / "truth" / "library").size(), p.grains.size());
  EXPECT_EQ(read(folder_ / "p" / "truth" / "contacts.csv").find("a,b,gap_m,contact\n"), 0U);
  EXPECT_HAS(read(folder_ / "p" / "phantom.json"), "\"voxel_m\": 0.0004");
}

TEST_F(CtPhantom, RefusesWhatItCannotScan) {
  const auto message = [&](const Scene& scene, const PhantomSpec& spec) {
    return message_of([&] { make_phantom(scene, spec); });
  };
  EXPECT_HAS(message(spheres_scene(), clean(0)), "voxel: found 0, expected a positive length");
  EXPECT_HAS(message(spheres_scene(), clean(1)), "voxel");
  EXPECT_HAS(message(spheres_scene(), clean(1e-6)), "number of voxels");
  PhantomSpec spec = clean(0.2e-3);
  spec.sawn = 4e-3;
  EXPECT_HAS(message(spheres_scene(), spec), "sawn");
  spec = clean(0.2e-3), spec.noise = -1;
  EXPECT_HAS(message(spheres_scene(), spec), "noise");
  spec = clean(0.2e-3), spec.grey_mastic = 1;
  EXPECT_HAS(message(spheres_scene(), spec), "grey values");
  EXPECT_HAS(message(cluster_scene(), clean(0.2e-3)), "a second sphere of body 7");
}

}  // namespace
}  // namespace macadam::test
