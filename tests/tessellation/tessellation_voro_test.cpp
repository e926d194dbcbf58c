// SPDX-License-Identifier: GPL-3.0-or-later
/// \file tessellation_voro_test.cpp  Compares the tessellation of the full single-sphere specimen with the tessellation
/// by voro++, an independent implementation.
#include <gtest/gtest.h>
#ifdef _OPENMP
#include <omp.h>
#endif

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>
#include <utility>
#include <vector>
#include <voro++/voro++.hh>

#include "macadam/tessellation.hpp"

namespace macadam {
namespace {

using Pair = std::pair<std::int32_t, std::int32_t>;
using Areas = std::map<Pair, double>;

struct VoroResult {
  std::vector<std::vector<int>> neighbour;     ///< by particle; voro++ numbers the walls as Macadam does
  std::vector<std::vector<double>> face_area;  ///< [mm²]
  std::vector<double> volume;                  ///< [mm³]
};

constexpr double mm = 1e-3;

/// Returns all cells with their neighbours and face areas, in millimetres because voro++ uses absolute tolerances.
VoroResult voro_tessellate(const Specimen& s) {
  const Vec3d size = (1 / mm) * s.box.size;
  constexpr double particles_per_block = 5.6;  // the optimum according to voro++
  const double blocks = std::cbrt(static_cast<double>(s.size()) / (particles_per_block * size.x * size.y * size.z));
  const auto grid = [blocks](double length) { return static_cast<int>(length * blocks) + 1; };
  voro::container_poly container(0, size.x, 0, size.y, 0, size.z, grid(size.x), grid(size.y), grid(size.z), false,
                                 false, false, 8);
  for (std::size_t i = 0; i < s.size(); ++i)
    container.put(static_cast<int>(i), s.centre[i].x / mm, s.centre[i].y / mm, s.centre[i].z / mm, s.radius[i] / mm);
  VoroResult out;
  out.neighbour.resize(s.size()), out.face_area.resize(s.size()), out.volume.resize(s.size());
  voro::c_loop_all loop(container);
  voro::voronoicell_neighbor cell;
  if (loop.start()) do {
      if (!container.compute_cell(cell, loop)) continue;
      const int i = loop.pid();
      cell.neighbors(out.neighbour[i]);
      cell.face_areas(out.face_area[i]);
      out.volume[i] = cell.volume();
    } while (loop.inc());
  return out;
}

template <class F>
double seconds(F&& f) {
  const auto start = std::chrono::steady_clock::now();
  f();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median_of_3(std::array<double, 3> t) {
  std::sort(t.begin(), t.end());
  return t[1];
}

class FullSpecimen : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    specimen = new Specimen(read_specimen_csv(MACADAM_TEST_DATA "/ss_full.csv.gz", Box{{0.05, 0.05, 0.08}}));
    tessellation = new Tessellation(tessellate(*specimen));
  }
  static void TearDownTestSuite() {
    delete tessellation;
    delete specimen;
  }
  static inline Specimen* specimen = nullptr;
  static inline Tessellation* tessellation = nullptr;
};

TEST_F(FullSpecimen, Invariants) {
  EXPECT_TRUE(tessellation->hidden.empty());
  const TessellationInvariants i = measure_invariants(*specimen, *tessellation);
  // Sums of 2e5 positive terms with a relative error of a few ε each are accurate to 1e-14 or better. The test requires
  // 1e-12.
  EXPECT_LT(i.volume, 1e-12);
  EXPECT_LT(i.walls, 1e-12);
  // The bound is ε times the size of the box over the smallest distance between two centres (1e-16 · 100), divided by
  // the smallest flatness of tetrahedra (1e-3).
  EXPECT_LT(i.closure, 1e-11);
  EXPECT_LT(i.flatness, 1e-11);
  EXPECT_LT(i.power, 1e-11);
}

TEST_F(FullSpecimen, ContactsByKind) {
  std::array<int, 3> aggregates{};
  std::array<int, 6> walls{};
  for (const Facet& f : tessellation->facets) {
    if (f.b < 0)
      ++walls[-1 - f.b];
    else
      ++aggregates[(specimen->phase[f.a] == Phase::aggregate) + (specimen->phase[f.b] == Phase::aggregate)];
  }
  // counts of M-M, M-A and A-A in an independent implementation
  EXPECT_EQ(aggregates, (std::array<int, 3>{160310, 56896, 2209}));
  EXPECT_EQ(walls[4], 944);
  EXPECT_EQ(walls[5], 957);
}

TEST_F(FullSpecimen, SameNeighboursAndAreasAsVoro) {
  const VoroResult voro = voro_tessellate(*specimen);
  Areas expected;
  for (std::size_t i = 0; i < specimen->size(); ++i)
    for (std::size_t k = 0; k < voro.neighbour[i].size(); ++k) {
      const auto a = static_cast<std::int32_t>(i), b = voro.neighbour[i][k];
      if (b < 0 || a < b) expected[{a, b}] = voro.face_area[i][k] * mm * mm;
    }
  double mean = 0;
  for (const Facet& f : tessellation->facets) mean += f.area / static_cast<double>(tessellation->facets.size());
  double largest = 0;
  for (const Facet& f : tessellation->facets) {
    const auto other = expected.find({f.a, f.b});
    ASSERT_NE(other, expected.end()) << f.a << ' ' << f.b << " of area " << f.area / mean << " of the mean";
    largest = std::max(largest, std::abs(other->second - f.area) / mean);
  }
  EXPECT_EQ(expected.size(), tessellation->facets.size());
  std::printf("largest difference of a facet's area: %.2g of the mean\n", largest);
  EXPECT_LT(largest, 1e-9);
  double cells = 0;
  for (std::size_t i = 0; i < specimen->size(); ++i) {
    const double v = voro.volume[i] * mm * mm * mm;
    cells = std::max(cells, std::abs(v - tessellation->cell_volume[i]) / v);
  }
  EXPECT_LT(cells, 1e-9);
}

TEST_F(FullSpecimen, NotSlowerThanVoro) {
#ifdef _OPENMP
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
#endif
  std::array<double, 3> ours{}, theirs{};
  for (int k = 0; k < 3; ++k) {
    ours[k] = seconds([] { EXPECT_FALSE(tessellate(*specimen).facets.empty()); });
    theirs[k] = seconds([] { EXPECT_FALSE(voro_tessellate(*specimen).volume.empty()); });
  }
#ifdef _OPENMP
  omp_set_num_threads(threads);
#endif
  std::printf("one thread, median of 3: macadam %.3f s, voro++ %.3f s\n", median_of_3(ours), median_of_3(theirs));
  EXPECT_LE(median_of_3(ours), median_of_3(theirs));
}

}  // namespace
}  // namespace macadam
