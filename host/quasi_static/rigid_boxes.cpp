// SPDX-License-Identifier: GPL-3.0-or-later
// rigid_boxes.cpp  Sums the blocks of the matrix over boxes of a regular grid, and factors the small matrix.
#include "host/quasi_static/rigid_boxes.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "kernels/base/parallel.hpp"

namespace macadam::quasi_static {
namespace {

constexpr std::size_t boxes_at_once = 16;  ///< in a piece of parallel work
/// Least pivot, relative to the diagonal before elimination.
constexpr double least_pivot = 1e-9;

}  // namespace

RigidBoxes::RigidBoxes(const Specimen& specimen, double per_box) {
  const std::size_t n = specimen.size();
  const Vec3d size = specimen.box.size;
  const double edge = std::cbrt(size.x * size.y * size.z * per_box / static_cast<double>(std::max<std::size_t>(n, 1)));
  const auto count = [edge](double length) { return std::max(1, static_cast<int>(std::lround(length / edge))); };
  const int nx = count(size.x), ny = count(size.y), nz = count(size.z);
  const auto index = [](double x, double length, int cells) {
    return std::clamp(static_cast<int>(x / length * cells), 0, cells - 1);
  };
  std::map<int, std::vector<std::uint32_t>> cells;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3d& x = specimen.centre[i];
    cells[(index(x.z, size.z, nz) * ny + index(x.y, size.y, ny)) * nx + index(x.x, size.x, nx)].push_back(
        static_cast<std::uint32_t>(i));
  }
  box_of_.resize(n);
  lever_.resize(n);
  begin_.push_back(0);
  for (const auto& [cell, members] : cells) {
    Vec3d centre{};
    for (const std::uint32_t i : members) centre += specimen.centre[i];
    centre = (1 / static_cast<double>(members.size())) * centre;
    for (const std::uint32_t i : members) {
      box_of_[i] = static_cast<std::int32_t>(begin_.size()) - 1;
      lever_[i] = specimen.centre[i] - centre;
      members_.push_back(i);
    }
    begin_.push_back(members_.size());
  }
}

Block RigidBoxes::motion(std::size_t particle) const {
  const Vec3d& r = lever_[particle];
  Block out = Block::Identity();
  out(0, 4) = r.z, out(0, 5) = -r.y;
  out(1, 3) = -r.z, out(1, 5) = r.x;
  out(2, 3) = r.y, out(2, 4) = -r.x;
  return out;
}

void RigidBoxes::factor(const TangentMatrix& matrix) {
  std::vector<std::map<std::int32_t, Block>> rows(boxes());
  for_each_in_parallel(boxes(), [&](std::size_t box) {
    for (std::size_t m = begin_[box]; m < begin_[box + 1]; ++m) {
      const std::size_t i = members_[m];
      const Block left = motion(i).transpose();
      matrix.for_each_block_of(i, [&](std::size_t j, const Block& block) {
        const std::int32_t other = box_of_[j];
        if (other < static_cast<std::int32_t>(box)) return;
        const auto [at, added] = rows[box].try_emplace(other, Block::Zero());
        at->second.noalias() += left * (block * motion(j)).eval();
      });
    }
  });
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t box = 0; box < boxes(); ++box) {
    for (const auto& [other, block] : rows[box]) {
      const bool same = other == static_cast<std::int32_t>(box);
      for (int r = 0; r < 6; ++r) {
        for (int c = same ? r : 0; c < 6; ++c)
          entries.emplace_back(6 * other + c, static_cast<int>(6 * box) + r, block(r, c));
      }
    }
  }
  const auto n = static_cast<Eigen::Index>(6 * boxes());
  Eigen::SparseMatrix<double> lower(n, n);
  lower.setFromTriplets(entries.begin(), entries.end());
  const Eigen::VectorXd least = least_pivot * lower.diagonal().cwiseAbs();
  if (factors_.rows() == 0) factors_.analyzePattern(lower);  // it stays the same
  factors_.factorize(lower);
  pivots_.resize(0);
  if (factors_.info() != Eigen::Success) return;  // a pivot is exactly zero
  pivots_ = factors_.vectorD().cwiseAbs().cwiseMax(factors_.permutationP() * least);
}

void RigidBoxes::add_solution(const Vector& x, Vector& out) const {
  if (pivots_.size() == 0) return;
  Eigen::VectorXd right(static_cast<Eigen::Index>(6 * boxes()));
  const auto at = [](auto* numbers) { return Vec3d{numbers[0], numbers[1], numbers[2]}; };
  for_pieces(boxes(), boxes_at_once, [&](std::size_t from, std::size_t to) {
    for (std::size_t box = from; box < to; ++box) {
      Vec3d force{}, moment{};
      for (std::size_t m = begin_[box]; m < begin_[box + 1]; ++m) {
        const std::size_t i = members_[m];
        const Vec3d f = at(&x[6 * i]);
        force += f;
        moment += at(&x[6 * i + 3]) + cross(lever_[i], f);
      }
      right.segment<6>(static_cast<Eigen::Index>(6 * box)) << force.x, force.y, force.z, moment.x, moment.y, moment.z;
    }
  });
  Eigen::VectorXd found = factors_.permutationP() * right;
  factors_.matrixL().solveInPlace(found);
  found = found.cwiseQuotient(pivots_);
  factors_.matrixU().solveInPlace(found);
  found = (factors_.permutationPinv() * found).eval();
  for_pieces(boxes(), boxes_at_once, [&](std::size_t from, std::size_t to) {
    for (std::size_t box = from; box < to; ++box) {
      const double* rigid = found.data() + 6 * box;
      const Vec3d shift = at(rigid), turn = at(rigid + 3);
      for (std::size_t m = begin_[box]; m < begin_[box + 1]; ++m) {
        const std::size_t i = members_[m];
        double* u = &out[6 * i];
        const Vec3d moved = shift + cross(turn, lever_[i]);
        u[0] += moved.x, u[1] += moved.y, u[2] += moved.z;
        u[3] += turn.x, u[4] += turn.y, u[5] += turn.z;
      }
    }
  });
}

}  // namespace macadam::quasi_static
