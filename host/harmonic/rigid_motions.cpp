// SPDX-License-Identifier: GPL-3.0-or-later
// rigid_motions.cpp  Free motions as the null space of the walls' stiffness on six rigid motions.
#include "host/harmonic/rigid_motions.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "host/network/clusters.hpp"
#include "host/network/contact_stiffness.hpp"
#include "kernels/parallel.hpp"
#include "macadam/error.hpp"

namespace macadam::harmonic {
namespace {

/// Motion of a particle under the six rigid motions about the middle of the box, turns scaled to lengths.
Matrix6 rigid(const Specimen& specimen, std::int32_t particle) {
  const double height = specimen.box.size.z;
  const Vec3d r = specimen.centre[static_cast<std::size_t>(particle)] - 0.5 * specimen.box.size;
  Matrix6 out = Matrix6::Identity();
  // translation of a turn about axis k: e_k × r
  out.topRightCorner<3, 3>() << 0, r.z, -r.y, -r.z, 0, r.x, r.y, -r.x, 0;
  out.rightCols<3>() /= height;
  return out;
}

/// Makes the last of the motions orthonormal to those before.
void orthonormalise(std::vector<std::vector<double>>& motions, const Inertia& inertia) {
  const auto product = [&](const std::vector<double>& a, const std::vector<double>& b) {
    return sum_in_parallel<double>(a.size(), [&](std::size_t i) { return a[i] * inertia_at(inertia, i) * b[i]; });
  };
  std::vector<double>& last = motions.back();
  for (std::size_t m = 0; m + 1 < motions.size(); ++m) {
    const double share = product(motions[m], last);
    for (std::size_t i = 0; i < last.size(); ++i) last[i] -= share * motions[m][i];
  }
  const double norm = std::sqrt(product(last, last));
  for (double& v : last) v /= norm;
}

/// So many columns that are independent: each time the longest, whose direction is then taken out of all.
std::vector<std::size_t> independent_columns(Eigen::MatrixXd& matrix, int wanted) {
  const auto columns = static_cast<std::size_t>(matrix.cols());
  struct Longest {
    double square = -1;
    std::size_t column = 0;
    Longest& operator+=(const Longest& o) {
      if (o.square > square) *this = o;  // the first of equals
      return *this;
    }
  };
  std::vector<std::size_t> out;
  for (int k = 0; k < wanted; ++k) {
    const auto longest = sum_in_parallel<Longest>(columns, [&](std::size_t c) {
      return Longest{matrix.col(static_cast<Eigen::Index>(c)).squaredNorm(), c};
    });
    out.push_back(longest.column);
    const Eigen::VectorXd direction = matrix.col(static_cast<Eigen::Index>(longest.column)).normalized();
#pragma omp parallel for schedule(static)
    for (std::size_t c = 0; c < columns; ++c) {
      auto column = matrix.col(static_cast<Eigen::Index>(c));
      column -= direction.dot(column) * direction;
    }
  }
  return out;
}

}  // namespace

FreeMotions find_free_motions(const Specimen& specimen, const ContactNetwork& network, const PairStiffness& stiffness,
                              const Inertia& inertia) {
  FreeMotions out;
  for (const Cluster& cluster : find_clusters(network, specimen.size())) {
    if (!cluster.spans()) {
      throw InputError("harmonic: the stiffness is singular: found " + describe(cluster) +
                       ", expected every particle to be joined to both walls (check gap_max and area_min)");
    }
    Matrix6 walls = Matrix6::Zero();
    for (const std::int32_t particle : cluster.particles) {
      for (const std::uint32_t number : network.row(static_cast<std::size_t>(particle))) {
        const Contact& c = network.contacts[number];
        if (c.b >= 0) continue;
        const auto pair = static_cast<std::size_t>(c.pair);
        const Matrix6 motion = rigid(specimen, particle);
        walls += motion.transpose() * contact_block(c, stiffness.k[pair].real(), stiffness.alpha[pair], 0, 0) * motion;
      }
    }
    const Eigen::SelfAdjointEigenSolver<Matrix6> modes(walls);
    const double largest = modes.eigenvalues()(5);
    int free = 0;
    while (free < 6 && modes.eigenvalues()(free) < 1e-12 * largest) ++free;  // sums of at most 1e4 terms to rounding
    if (free == 0) continue;
    const std::vector<std::int32_t>& members = cluster.particles;
    // displacements (not rotations) of all members under the free motions; pivoting picks independent, far apart ones
    Eigen::MatrixXd motion(free, static_cast<Eigen::Index>(3 * members.size()));
#pragma omp parallel for schedule(static)
    for (std::size_t k = 0; k < members.size(); ++k) {
      motion.middleCols<3>(static_cast<Eigen::Index>(3 * k)) =
          (rigid(specimen, members[k]).topRows<3>() * modes.eigenvectors().leftCols(free)).transpose();
    }
    const std::vector<std::size_t> pivots = independent_columns(motion, free);
    for (int m = 0; m < free; ++m) {
      const std::size_t column = pivots[static_cast<std::size_t>(m)];
      out.pins.push_back({6 * static_cast<std::size_t>(members[column / 3]) + column % 3, largest});
      std::vector<double>& whole = out.motions.emplace_back(6 * specimen.size(), 0.0);
#pragma omp parallel for schedule(static)
      for (std::size_t k = 0; k < members.size(); ++k) {
        const std::int32_t particle = members[k];
        Eigen::Map<Eigen::Matrix<double, 6, 1>> at(&whole[6 * static_cast<std::size_t>(particle)]);
        at = rigid(specimen, particle) * modes.eigenvectors().col(m);
      }
      orthonormalise(out.motions, inertia);
    }
  }
  return out;
}

}  // namespace macadam::harmonic
