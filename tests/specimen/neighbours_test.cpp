// SPDX-License-Identifier: GPL-3.0-or-later
// neighbours_test.cpp  Compares the lists of neighbouring spheres with lists made by comparing all pairs of spheres.
// After every kind of move, content and order must be equal.
#include "host/spheres/neighbours.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include "host/spheres/random_stream.hpp"

namespace macadam {
namespace {

constexpr double skin = 0.02;
const Box box{{1, 1.5, 0.8}};

/// Returns spheres whose radii differ by up to a factor of thirty; a third of the spheres have equal radii.
std::vector<Ball> spheres(int n, RandomStream& random) {
  std::vector<Ball> balls;
  for (int i = 0; i < n; ++i) {
    const double u = random.uniform(), r = i % 3 == 0 ? 0.02 : 0.01 * std::pow(30, u * u * u * u);
    const double x = random.uniform(0, box.size.x), y = random.uniform(0, box.size.y);
    balls.push_back({{x, y, random.uniform(0, box.size.z)}, r});
  }
  return balls;
}

/// Returns the neighbours of sphere i that are nearer than `gap`, found by comparing all pairs. The neighbours are in
/// the order that the header documents.
std::vector<std::int32_t> by_hand(const std::vector<Ball>& balls, const std::vector<std::int32_t>& number, int i,
                                  double gap) {
  std::vector<std::pair<std::pair<int, int>, int>> row;
  for (int j = 0; j < static_cast<int>(balls.size()); ++j) {
    if (j == i || norm(balls[i].centre - balls[j].centre) >= balls[i].radius + balls[j].radius + gap) continue;
    const double own = balls[i].radius, other = balls[j].radius;
    const bool larger = other > own || (other == own && number[j] > number[i]);
    row.push_back({{larger ? 1 : number[j] < number[i] ? 0 : 2, number[j]}, j});
  }
  std::sort(row.begin(), row.end());
  std::vector<std::int32_t> out;
  for (const auto& [key, j] : row) out.push_back(j);
  return out;
}

/// Returns the members of a list that are nearer than `gap`.
std::vector<std::int32_t> within(const std::vector<Ball>& balls, const Neighbours& neighbours, int i, double gap) {
  std::vector<std::int32_t> out;
  for (const std::int32_t j : neighbours.of(static_cast<std::size_t>(i)))
    if (norm(balls[i].centre - balls[j].centre) < balls[i].radius + balls[j].radius + gap) out.push_back(j);
  return out;
}

class NeighboursOf : public testing::TestWithParam<int> {
 protected:
  void SetUp() override { omp_set_num_threads(GetParam()); }
  void TearDown() override { omp_set_num_threads(threads_); }
  int threads_ = omp_get_max_threads();
};
INSTANTIATE_TEST_SUITE_P(Threads, NeighboursOf, testing::Values(1, 2, 3));

TEST_P(NeighboursOf, AreThoseOfAllPairsInOrder) {
  RandomStream random(3, 0);
  for (const int n : {1, 2, 30, 1500}) {
    const std::vector<Ball> balls = spheres(n, random);
    std::vector<std::int32_t> number(balls.size());
    for (int i = 0; i < n; ++i) number[i] = i;
    const Neighbours neighbours(box, balls, skin);
    for (int i = 0; i < n; ++i) {
      const auto list = neighbours.of(static_cast<std::size_t>(i));
      ASSERT_EQ(by_hand(balls, number, i, skin), std::vector<std::int32_t>(list.begin(), list.end())) << n << ' ' << i;
    }
  }
}

/// In each round most spheres move a little and some move far. In every fifth round all spheres move so far that new
/// lists are needed. Spheres before `first` do not move. The numbers of the spheres are in mixed order.
TEST_P(NeighboursOf, HoldAllThatTouchAfterManyMoves) {
  RandomStream random(4, 0);
  constexpr int n = 1500, first = 200;
  std::vector<Ball> balls = spheres(n, random);
  std::vector<std::int32_t> number(n);
  for (int i = 0; i < n; ++i) number[i] = i < first ? i : n - 1 + first - i;
  Neighbours neighbours(box, balls, skin, first, number);
  int few = 0, many = 0;
  for (int round = 0; round < 20; ++round) {
    std::vector<std::int32_t> strayed;
    const double step = round % 5 == 4 ? skin : 0.1 * skin;
    // If many spheres move far, several threads make the new lists; if few do, one thread makes them.
    const double share = round % 3 == 2 ? 0.02 : 0.004;
    for (int i = first; i < n; ++i) {
      const bool far = random.uniform() < share;
      const auto moved = [&](double x, double length) {
        const double way = (far ? 20 * skin : step) * (2 * random.uniform() - 1);
        return std::clamp(x + way, 0.0, length);
      };
      Vec3d& c = balls[i].centre;
      c = {moved(c.x, box.size.x), moved(c.y, box.size.y), moved(c.z, box.size.z)};
      if (neighbours.strayed(static_cast<std::size_t>(i))) strayed.push_back(i);
    }
    (strayed.size() < n / 24 ? few : many) += 1;
    neighbours.relist(strayed);
    for (int i = first; i < n; ++i)
      ASSERT_EQ(by_hand(balls, number, i, 0), within(balls, neighbours, i, 0)) << "round " << round << ", " << i;
  }
  EXPECT_GT(few, 5);
  EXPECT_GT(many, 2);
}

}  // namespace
}  // namespace macadam
