// SPDX-License-Identifier: GPL-3.0-or-later
// sampling.cpp  Samples bodies along vertical lines, and Laguerre cells at points of voxels.
#include "bench/continuum/sampling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "macadam/specimen.hpp"

namespace macadam::continuum {
namespace {

constexpr int lines = 8;    ///< vertical lines per edge of a voxel
constexpr int samples = 6;  ///< points per edge of a voxel with two phases

using Interval = std::pair<double, double>;  ///< part of a vertical line, in voxels

/// Joins intervals that overlap.
void join(std::vector<Interval>& intervals) {
  std::sort(intervals.begin(), intervals.end());
  std::size_t last = 0;
  for (std::size_t i = 1; i < intervals.size(); ++i)
    if (intervals[i].first <= intervals[last].second)
      intervals[last].second = std::max(intervals[last].second, intervals[i].second);
    else
      intervals[++last] = intervals[i];
  if (!intervals.empty()) intervals.resize(last + 1);
}

/// Adds `factor` times the length of an interval in each voxel of a column.
void add_lengths(const Size& n, int i, int j, const Interval& part, float factor, std::vector<float>& to) {
  const double low = std::clamp(part.first, 0.0, double(n.z)), high = std::clamp(part.second, 0.0, double(n.z));
  for (int k = int(low); k < n.z && k < high; ++k)
    to[n.element(i, j, k)] += factor * float(std::min(high, k + 1.0) - std::max(low, double(k)));
}

/// Returns, for each voxel of the plane z = 0, the indices of the bodies whose bounding boxes lie above the voxel.
std::vector<std::vector<std::size_t>> bodies_of_columns(const Size& n, double voxel, const std::vector<Body>& bodies) {
  std::vector<std::vector<std::size_t>> out(std::size_t(n.x) * n.y);
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (int j = std::max(0, int(bodies[b].low[1] / voxel)); j < n.y && j * voxel < bodies[b].high[1]; ++j)
      for (int i = std::max(0, int(bodies[b].low[0] / voxel)); i < n.x && i * voxel < bodies[b].high[0]; ++i)
        out[std::size_t(j) * n.x + i].push_back(b);
  return out;
}

struct Sphere {
  double x, y, z, squared_radius;
  unsigned char phase;  ///< 0 mastic, 1 rock, 2 void
};

/// Returns the spheres whose Laguerre cells may contain points within the distance `reach` of the point `at`. Over this
/// distance the difference between the power distances to two spheres changes by at most 2·(distance of their
/// centres)·reach.
std::vector<Sphere> candidates(const std::vector<Sphere>& spheres, const Point& at, double reach) {
  std::vector<double> power(spheres.size());
  for (std::size_t s = 0; s < spheres.size(); ++s) {
    const double dx = spheres[s].x - at[0], dy = spheres[s].y - at[1], dz = spheres[s].z - at[2];
    power[s] = dx * dx + dy * dy + dz * dz - spheres[s].squared_radius;
  }
  const auto nearest = std::size_t(std::min_element(power.begin(), power.end()) - power.begin());
  const Sphere& best = spheres[nearest];
  std::vector<Sphere> out;
  for (std::size_t s = 0; s < spheres.size(); ++s) {
    const double apart = 2 * reach * std::hypot(spheres[s].x - best.x, spheres[s].y - best.y, spheres[s].z - best.z);
    if (s == nearest || power[s] - power[nearest] <= apart) out.push_back(spheres[s]);
  }
  return out;
}

/// Returns the phase of the cell in which a point lies.
unsigned char phase_at(const std::vector<Sphere>& spheres, const Point& at) {
  double least = INFINITY;
  unsigned char phase = 0;
  for (const Sphere& s : spheres) {
    const double dx = at[0] - s.x, dy = at[1] - s.y, dz = at[2] - s.z;
    const double power = dx * dx + dy * dy + dz * dz - s.squared_radius;
    if (power < least) least = power, phase = s.phase;
  }
  return phase;
}

}  // namespace

PhaseFractions mastic_in(const Point& box, double voxel) {
  PhaseFractions out;
  const auto count = [&](int axis) {
    const double n = std::round(box[std::size_t(axis)] / voxel);
    if (!(n >= 1 && n < 1e5) || std::abs(n * voxel - box[std::size_t(axis)]) > 1e-6 * box[std::size_t(axis)])
      throw std::runtime_error(fmt::format("found an edge of {} m, expected a multiple of the voxel's edge, {} m",
                                           box[std::size_t(axis)], voxel));
    return int(n);
  };
  out.size = {count(0), count(1), count(2)};
  out.rock.assign(out.size.elements(), 0);
  out.voids = out.rock;
  out.area = double(out.size.x) * out.size.y;
  return out;
}

void place_bodies(PhaseFractions& to, double voxel, const std::vector<Body>& rock, const std::vector<Body>& voids) {
  const Size n = to.size;
  const auto rock_of = bodies_of_columns(n, voxel, rock), voids_of = bodies_of_columns(n, voxel, voids);
  const float part = 1.0F / (lines * lines);
#pragma omp parallel for schedule(dynamic)
  for (int j = 0; j < n.y; ++j)
    for (int i = 0; i < n.x; ++i)
      for (int line = 0; line < lines * lines; ++line) {
        const double x = (i + (line % lines + 0.5) / lines) * voxel, y = (j + (line / lines + 0.5) / lines) * voxel;
        const auto intervals = [&](const std::vector<Body>& bodies, const std::vector<std::size_t>& numbers) {
          std::vector<Interval> out;
          for (const std::size_t b : numbers) {
            const std::vector<double> at = bodies[b].crossings(x, y);
            for (std::size_t c = 0; c + 1 < at.size(); c += 2) out.emplace_back(at[c] / voxel, at[c + 1] / voxel);
          }
          join(out);
          return out;
        };
        const std::size_t column = std::size_t(j) * n.x + i;
        const auto solid = intervals(rock, rock_of[column]), empty = intervals(voids, voids_of[column]);
        for (const Interval& v : empty) add_lengths(n, i, j, v, part, to.voids);
        for (const Interval& r : solid) {
          add_lengths(n, i, j, r, part, to.rock);
          for (const Interval& v : empty) {  // the void replaces the rock
            const Interval common{std::max(r.first, v.first), std::min(r.second, v.second)};
            if (common.first < common.second) add_lengths(n, i, j, common, -part, to.rock);
          }
        }
      }
}

PhaseFractions of_cells(const std::string& file, const Point& box, double voxel) {
  const auto specimen = macadam::read_specimen_csv(file, {{box[0], box[1], box[2]}});
  std::vector<Sphere> spheres;
  for (std::size_t i = 0; i < specimen.centre.size(); ++i) {
    const auto& c = specimen.centre[i];
    const auto phase = specimen.phase[i];
    spheres.push_back({c.x, c.y, c.z, specimen.radius[i] * specimen.radius[i],
                       static_cast<unsigned char>(phase == macadam::Phase::aggregate ? 1
                                                  : phase == macadam::Phase::mastic  ? 0
                                                                                     : 2)});
  }
  auto out = mastic_in(box, voxel);
  const Size n = out.size;
  constexpr int block = 4;  // edge of a block of voxels with one list of candidates, in voxels
  const double half_diagonal = std::sqrt(3.0) / 2 * voxel;
  const auto blocks = [](int voxels) { return (voxels + block - 1) / block; };
#pragma omp parallel for schedule(dynamic) collapse(2)
  for (int bk = 0; bk < blocks(n.z); ++bk)
    for (int bj = 0; bj < blocks(n.y); ++bj)
      for (int bi = 0; bi < blocks(n.x); ++bi) {
        const auto centre = [&](int b) { return (b + 0.5) * block * voxel; };
        const auto near = candidates(spheres, {centre(bi), centre(bj), centre(bk)}, block * half_diagonal);
        for (int v = 0; v < block * block * block; ++v) {
          const int i = bi * block + v % block, j = bj * block + v / block % block, k = bk * block + v / block / block;
          if (i >= n.x || j >= n.y || k >= n.z) continue;
          const auto at = [&](double x, double y, double z) {
            return Point{(i + x) * voxel, (j + y) * voxel, (k + z) * voxel};
          };
          const auto in_voxel = candidates(near, at(0.5, 0.5, 0.5), half_diagonal);
          int counts[3] = {};
          const auto is_same = [&](const Sphere& s) { return s.phase == in_voxel[0].phase; };
          if (std::all_of(in_voxel.begin(), in_voxel.end(), is_same))
            counts[in_voxel[0].phase] = samples * samples * samples;
          else
            for (int s = 0; s < samples * samples * samples; ++s)
              ++counts[phase_at(in_voxel, at((s % samples + 0.5) / samples, (s / samples % samples + 0.5) / samples,
                                             (s / samples / samples + 0.5) / samples))];
          out.rock[n.element(i, j, k)] = float(counts[1]) / float(samples * samples * samples);
          out.voids[n.element(i, j, k)] = float(counts[2]) / float(samples * samples * samples);
        }
      }
  return out;
}

PhaseFractions of_layers(int axis, const Point& box, double voxel) {
  auto out = mastic_in(box, voxel);
  const Size n = out.size;
  for (std::size_t e = 0; e < n.elements(); ++e) {
    const int at[3] = {int(e % n.x), int(e / n.x % n.y), int(e / n.x / n.y)}, edges[3] = {n.x, n.y, n.z};
    out.rock[e] = float(std::clamp(at[axis] + 1 - edges[axis] / 2.0, 0.0, 1.0));
  }
  return out;
}

}  // namespace macadam::continuum
