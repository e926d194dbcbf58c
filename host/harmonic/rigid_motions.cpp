// SPDX-License-Identifier: GPL-3.0-or-later
// rigid_motions.cpp  Free motions as the null space of the walls' stiffness on six rigid motions.
#include "host/harmonic/rigid_motions.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <cmath>

#include "host/network/clusters.hpp"
#include "host/network/contact_stiffness.hpp"
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
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * inertia_at(inertia, i) * b[i];
    return sum;
  };
  std::vector<double>& last = motions.back();
  for (std::size_t m = 0; m + 1 < motions.size(); ++m) {
    const double share = product(motions[m], last);
    for (std::size_t i = 0; i < last.size(); ++i) last[i] -= share * motions[m][i];
  }
  const double norm = std::sqrt(product(last, last));
  for (double& v : last) v /= norm;
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
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> pivots(motion);
    for (int m = 0; m < free; ++m) {
      const auto column = static_cast<std::size_t>(pivots.colsPermutation().indices()(m));
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
