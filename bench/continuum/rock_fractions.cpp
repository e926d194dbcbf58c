// SPDX-License-Identifier: GPL-3.0-or-later
// rock_fractions.cpp  Computes the volume fraction of rock in each voxel from the phase at points of the voxel.
#include "bench/continuum/rock_fractions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "macadam/specimen.hpp"

namespace continuum {
namespace {

constexpr int samples = 6;  ///< points per edge of a voxel that may be cut

struct Sphere {
  double x, y, z, radius;
  bool rock;
};

RockFractions empty(const std::vector<double>& box, double voxel) {
  RockFractions out;
  const auto count = [&](int axis) {
    const double n = std::round(box[axis] / voxel);
    if (n < 1 || std::abs(n * voxel - box[axis]) > 1e-6 * box[axis])
      throw std::runtime_error(
          fmt::format("found an edge of {} m, expected a multiple of the voxel's {} m", box[axis], voxel));
    return int(n);
  };
  out.size = {count(0), count(1), count(2)};
  out.fraction.assign(out.size.elements(), 0);
  return out;
}

/// Sorts spheres into the cells of a regular grid, to find the spheres near a point.
class Bins {
 public:
  Bins(const std::vector<Sphere>& spheres, const std::vector<double>& box, double edge) {
    for (int i = 0; i < 3; ++i) count_[i] = std::max(1, int(box[i] / edge));
    for (int i = 0; i < 3; ++i) step_[i] = box[i] / count_[i];
    bins_.resize(std::size_t(count_[0]) * count_[1] * count_[2]);
    for (std::size_t s = 0; s < spheres.size(); ++s) {
      const Sphere& at = spheres[s];
      bins_[index(bin(0, at.x), bin(1, at.y), bin(2, at.z))].push_back(s);
      largest_ = std::max(largest_, at.radius);
    }
  }
  /// Calls f(number) for every sphere whose bin is within `reach` of the point `at` along each axis.
  template <class F>
  void near(const std::array<double, 3>& at, double reach, F&& f) const {
    int low[3], high[3];
    for (int i = 0; i < 3; ++i) low[i] = bin(i, at[i] - reach), high[i] = bin(i, at[i] + reach);
    for (int k = low[2]; k <= high[2]; ++k)
      for (int j = low[1]; j <= high[1]; ++j)
        for (int i = low[0]; i <= high[0]; ++i)
          for (const std::size_t s : bins_[index(i, j, k)]) f(s);
  }
  double largest() const { return largest_; }

 private:
  int bin(int axis, double x) const { return std::clamp(int(x / step_[axis]), 0, count_[axis] - 1); }
  std::size_t index(int i, int j, int k) const { return (std::size_t(k) * count_[1] + j) * count_[0] + i; }
  double largest_ = 0, step_[3];
  int count_[3];
  std::vector<std::vector<std::size_t>> bins_;
};

/// Sets every voxel to the fraction of sample points at which `rock(point)` holds.
template <class F>
void sample(RockFractions& out, double voxel, F&& rock) {
#pragma omp parallel for schedule(dynamic)
  for (int k = 0; k < out.size.z; ++k)
    for (int j = 0; j < out.size.y; ++j)
      for (int i = 0; i < out.size.x; ++i) {
        const auto at = [&](double x, double y, double z) {
          return rock(std::array{(i + x) * voxel, (j + y) * voxel, (k + z) * voxel});
        };
        const bool centre = at(0.5, 0.5, 0.5);
        bool cut = false;  // corners and face centres decide whether the voxel is sampled
        for (const double x : {0.0, 0.5, 1.0})
          for (const double y : {0.0, 0.5, 1.0})
            for (const double z : {0.0, 0.5, 1.0}) cut = cut || at(x, y, z) != centre;
        int inside = 0;
        for (int s = 0; cut && s < samples * samples * samples; ++s)
          inside += at((s % samples + 0.5) / samples, (s / samples % samples + 0.5) / samples,
                       (s / samples / samples + 0.5) / samples);
        out.fraction[out.size.element(i, j, k)] =
            cut ? float(inside) / float(samples * samples * samples) : float(centre);
      }
}

}  // namespace

RockFractions of_balls(const std::string& file, const std::vector<double>& box, double voxel) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  if (line.rfind("x,y,z,radius", 0) != 0)
    throw std::runtime_error(file + ":1: found \"" + line + "\", expected x,y,z,radius");
  std::vector<Sphere> spheres;
  for (int number = 2; std::getline(in, line); ++number) {
    Sphere s{};
    char comma = 0;
    std::istringstream words(line);
    if (!(words >> s.x >> comma >> s.y >> comma >> s.z >> comma >> s.radius))
      throw std::runtime_error(fmt::format("{}:{}: found \"{}\", expected four numbers", file, number, line));
    spheres.push_back(s);
  }
  auto out = empty(box, voxel);
  const Bins bins(spheres, box, 4 * voxel);
  sample(out, voxel, [&](const std::array<double, 3>& at) {
    bool found = false;
    bins.near(at, bins.largest(), [&](std::size_t n) {
      const Sphere& s = spheres[n];
      found = found || std::hypot(at[0] - s.x, at[1] - s.y, at[2] - s.z) < s.radius;
    });
    return found;
  });
  return out;
}

RockFractions of_cells(const std::string& file, const std::vector<double>& box, double voxel) {
  const auto specimen = macadam::read_specimen_csv(file, {{box[0], box[1], box[2]}});
  std::vector<Sphere> spheres;
  for (std::size_t i = 0; i < specimen.centre.size(); ++i) {
    const auto& c = specimen.centre[i];
    spheres.push_back({c.x, c.y, c.z, specimen.radius[i], specimen.phase[i] == macadam::Phase::aggregate});
  }
  auto out = empty(box, voxel);
  const double mean = std::cbrt(box[0] * box[1] * box[2] / double(spheres.size()));
  const Bins bins(spheres, box, mean);
  sample(out, voxel, [&](const std::array<double, 3>& at) {
    double least = INFINITY;
    bool rock = false;
    // Let p be the smallest power distance d² − R² found so far. A sphere with a smaller power distance has d² < p + R²
    // ≤ p + R_max², so no sphere farther away need be searched.
    for (double reach = mean;; reach *= 2) {
      bins.near(at, reach, [&](std::size_t n) {
        const Sphere& s = spheres[n];
        const double dx = at[0] - s.x, dy = at[1] - s.y, dz = at[2] - s.z;
        const double power = dx * dx + dy * dy + dz * dz - s.radius * s.radius;
        if (power < least) least = power, rock = s.rock;
      });
      if (least + bins.largest() * bins.largest() <= reach * reach || reach > box[0] + box[1] + box[2]) return rock;
    }
  });
  return out;
}

RockFractions of_layers(int axis, const std::vector<double>& box, double voxel) {
  auto out = empty(box, voxel);
  sample(out, voxel,
         [&](const std::array<double, 3>& at) { return at[std::size_t(axis)] > box[std::size_t(axis)] / 2; });
  return out;
}

}  // namespace continuum
