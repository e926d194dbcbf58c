// SPDX-License-Identifier: GPL-3.0-or-later
// rigid_motions.cpp  Clusters by union–find; free motions as the null space of the walls' stiffness on six rigid
// motions.
#include "host/harmonic/rigid_motions.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <map>
#include <numeric>

#include "host/network/contact_stiffness.hpp"
#include "macadam/error.hpp"

namespace macadam::harmonic {
namespace {

/// Smallest particle number of each particle's cluster.
std::vector<std::int32_t> clusters(const ContactNetwork& network, std::size_t particles) {
  std::vector<std::int32_t> parent(particles);
  std::iota(parent.begin(), parent.end(), 0);
  auto root = [&](std::int32_t i) {
    while (parent[static_cast<std::size_t>(i)] != i) {
      i = parent[static_cast<std::size_t>(i)] = parent[static_cast<std::size_t>(parent[static_cast<std::size_t>(i)])];
    }
    return i;
  };
  for (const Contact& c : network.contacts) {
    if (c.b < 0) continue;
    const std::int32_t a = root(c.a), b = root(c.b);
    parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }
  for (std::size_t i = 0; i < particles; ++i) parent[i] = root(static_cast<std::int32_t>(i));
  return parent;
}

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

void refuse(const std::vector<std::int32_t>& cluster, std::int32_t root, const char* wall) {
  std::string numbers;
  std::int64_t count = 0;
  for (std::size_t i = 0; i < cluster.size(); ++i) {
    if (cluster[i] != root) continue;
    if (count++ < 10) numbers += (numbers.empty() ? "" : ", ") + std::to_string(i);
  }
  throw InputError("harmonic: the stiffness is singular: a cluster of " + std::to_string(count) + " particles (" +
                   numbers + (count > 10 ? ", …" : "") + ") does not touch the " + wall +
                   " wall; expected every particle to be joined to both walls (check gap_max and area_min)");
}

}  // namespace

std::vector<Pin> pins_of_free_motions(const Specimen& specimen, const ContactNetwork& network,
                                      const PairStiffness& stiffness) {
  struct Held {
    bool bottom = false, top = false;
    Matrix6 stiffness = Matrix6::Zero();
  };
  const std::vector<std::int32_t> cluster = clusters(network, specimen.size());
  std::map<std::int32_t, Held> held;
  for (const auto root : cluster) held[root];
  for (const Contact& c : network.contacts) {
    if (c.b >= 0) continue;
    Held& h = held[cluster[static_cast<std::size_t>(c.a)]];
    h.bottom |= c.b == wall_z_lo;
    h.top |= c.b == wall_z_hi;
    const auto pair = static_cast<std::size_t>(c.pair);
    const Matrix6 motion = rigid(specimen, c.a);
    h.stiffness +=
        motion.transpose() * contact_block(c, stiffness.k[pair].real(), stiffness.alpha[pair], 0, 0) * motion;
  }

  std::vector<Pin> pins;
  for (const auto& [root, h] : held) {
    if (!h.bottom) refuse(cluster, root, "bottom");
    if (!h.top) refuse(cluster, root, "top");
    const Eigen::SelfAdjointEigenSolver<Matrix6> modes(h.stiffness);
    const double largest = modes.eigenvalues()(5);
    int free = 0;
    while (free < 6 && modes.eigenvalues()(free) < 1e-12 * largest) ++free;  // sums of at most 1e4 terms to rounding
    if (free == 0) continue;
    std::vector<std::int32_t> members;
    for (std::size_t i = 0; i < cluster.size(); ++i) {
      if (cluster[i] == root) members.push_back(static_cast<std::int32_t>(i));
    }
    // displacements (not rotations) of all members under the free motions; pivoting picks independent, far apart ones
    Eigen::MatrixXd motion(free, static_cast<Eigen::Index>(3 * members.size()));
    for (std::size_t k = 0; k < members.size(); ++k) {
      motion.middleCols<3>(static_cast<Eigen::Index>(3 * k)) =
          (rigid(specimen, members[k]).topRows<3>() * modes.eigenvectors().leftCols(free)).transpose();
    }
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> pivots(motion);
    for (int m = 0; m < free; ++m) {
      const auto column = static_cast<std::size_t>(pivots.colsPermutation().indices()(m));
      pins.push_back({6 * static_cast<std::size_t>(members[column / 3]) + column % 3, largest});
    }
  }
  return pins;
}

}  // namespace macadam::harmonic
