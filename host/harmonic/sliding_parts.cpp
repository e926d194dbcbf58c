// SPDX-License-Identifier: GPL-3.0-or-later
// sliding_parts.cpp  Finds parts by union–find over the contacts that resist sliding, and free motions of a particle as
// the null space of its stiffness block.
#include "host/harmonic/sliding_parts.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>

#include "host/base/disjoint_sets.hpp"

namespace macadam::harmonic {
namespace {

/// Largest sine of the angle between normals that count as parallel: it allows for rounding errors of coordinates.
constexpr double parallel = 1e-12;

/// Returns whether a contact is horizontal and has no shear stiffness.
bool slides_horizontally(const Contact& c, const PairStiffness& stiffness) {
  return stiffness.alpha[static_cast<std::size_t>(c.pair)] == 0 && std::hypot(c.n.x, c.n.y) <= parallel;
}

}  // namespace

std::vector<std::vector<std::int32_t>> sliding_parts(const Cluster& cluster, const ContactNetwork& network,
                                                     const PairStiffness& stiffness) {
  const std::vector<std::int32_t>& members = cluster.particles;
  const auto index_of = [&](std::int32_t particle) {
    return static_cast<std::int32_t>(std::ranges::lower_bound(members, particle) - members.begin());
  };
  DisjointSets sets(members.size());
  bool slides = false;
  for (std::size_t i = 0; i < members.size(); ++i) {
    for (const std::uint32_t number : network.row(static_cast<std::size_t>(members[i]))) {
      const Contact& c = network.contacts[number];
      if (c.b < 0 || c.a != members[i]) continue;
      if (slides_horizontally(c, stiffness)) {
        slides = true;
        continue;
      }
      sets.join(static_cast<std::int32_t>(i), index_of(c.b));
    }
  }
  if (!slides) return {members};
  std::map<std::int32_t, std::vector<std::int32_t>> parts;
  for (std::size_t i = 0; i < members.size(); ++i) parts[sets.find(static_cast<std::int32_t>(i))].push_back(members[i]);
  std::vector<std::vector<std::int32_t>> out;
  for (auto& [first, part] : parts) out.push_back(std::move(part));
  return out;
}

Eigen::Matrix<double, 6, Eigen::Dynamic> own_motions(std::int32_t particle, const Specimen& specimen,
                                                     const ContactNetwork& network, const PairStiffness& stiffness) {
  const auto row = network.row(static_cast<std::size_t>(particle));
  Eigen::Matrix<double, 6, Eigen::Dynamic> none(6, 0);
  if (row.size() < 2) return none;
  const Vec3d& axis = network.contacts[row.front()].n;
  const auto is_parallel = [&](std::uint32_t number) {
    return norm(cross(network.contacts[number].n, axis)) <= parallel;
  };
  if (!std::ranges::all_of(row, is_parallel)) return none;
  Matrix6 block = Matrix6::Zero();
  for (const std::uint32_t number : row) {
    const Contact& c = network.contacts[number];
    const auto pair = static_cast<std::size_t>(c.pair);
    const int end = c.a == particle ? 0 : 1;
    block += contact_block(c, stiffness.k[pair].real(), stiffness.alpha[pair], end, end);
  }
  Eigen::Vector<double, 6> scale = Eigen::Vector<double, 6>::Ones();
  scale.tail<3>() /= specimen.radius[static_cast<std::size_t>(particle)];  // rotations become lengths
  const Eigen::SelfAdjointEigenSolver<Matrix6> modes(scale.asDiagonal() * block * scale.asDiagonal());
  const double largest = modes.eigenvalues()(5);
  int free = 0;
  // 1e-12 allows for the rounding error of a sum over a few contacts
  while (free < 6 && modes.eigenvalues()(free) < 1e-12 * largest) ++free;
  return modes.eigenvectors().leftCols(free);
}

}  // namespace macadam::harmonic
