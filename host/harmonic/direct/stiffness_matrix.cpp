// SPDX-License-Identifier: GPL-3.0-or-later
// stiffness_matrix.cpp  Computes K = Σ Gᵀ·D·G over the contacts, where G gives the relative displacements of a contact
// and D its stiffness. The sums are written directly into the compressed columns of the sparse matrix.
#include "host/harmonic/direct/stiffness_matrix.hpp"

#include <algorithm>

#include "host/base/counted.hpp"
#include "host/network/contact_stiffness.hpp"

namespace macadam::harmonic {

Eigen::SparseMatrix<double> assemble_lower(const ContactNetwork& network, const PairStiffness& stiffness,
                                           const std::vector<std::int32_t>& place, const std::vector<Pin>& pins) {
  const std::size_t n = place.size();
  // for each block column, the blocks below its diagonal, as (row, contact)
  std::vector<std::vector<std::pair<std::int32_t, std::uint32_t>>> columns(n);
  for (std::uint32_t number = 0; number < network.contacts.size(); ++number) {
    const Contact& c = network.contacts[number];
    if (c.b < 0) continue;
    const std::int32_t a = place[static_cast<std::size_t>(c.a)], b = place[static_cast<std::size_t>(c.b)];
    columns[static_cast<std::size_t>(std::min(a, b))].emplace_back(std::max(a, b), number);
  }
  std::vector<std::int32_t> particle(n);
  for (std::size_t i = 0; i < n; ++i) particle[static_cast<std::size_t>(place[i])] = static_cast<std::int32_t>(i);

  Eigen::SparseMatrix<double> out(static_cast<Eigen::Index>(6 * n), static_cast<Eigen::Index>(6 * n));
  std::size_t entries = 0;
  for (auto& column : columns) entries += 21 + 36 * column.size();
  out.reserve(counted<Eigen::SparseMatrix<double>::StorageIndex>(entries, "entries of the stiffness"));
  auto parameters = [&](const Contact& c) {
    const auto pair = static_cast<std::size_t>(c.pair);
    return std::pair{stiffness.k[pair].real(), stiffness.alpha[pair]};
  };
  for (std::size_t column = 0; column < n; ++column) {
    auto& below = columns[column];
    std::sort(below.begin(), below.end());
    const std::int32_t self = particle[column];
    Matrix6 diagonal = Matrix6::Zero();
    for (const std::uint32_t number : network.row(static_cast<std::size_t>(self))) {
      const Contact& c = network.contacts[number];
      const auto [k, alpha] = parameters(c);
      const int end = c.a == self ? 0 : 1;
      diagonal += contact_block(c, k, alpha, end, end);
    }
    for (const Pin& pin : pins) {
      if (pin.particle != static_cast<std::size_t>(self)) continue;
      const Eigen::Map<const Eigen::Vector<double, 6>> direction(pin.direction.data());
      diagonal += pin.stiffness * direction * direction.transpose();
    }
    std::vector<Matrix6> blocks;
    for (const auto& [row, number] : below) {
      const Contact& c = network.contacts[number];
      const auto [k, alpha] = parameters(c);
      const int end = c.a == self ? 0 : 1;
      blocks.push_back(contact_block(c, k, alpha, 1 - end, end));
    }
    for (int j = 0; j < 6; ++j) {
      const auto global = static_cast<Eigen::Index>(6 * column) + j;
      out.startVec(global);
      for (int i = j; i < 6; ++i) out.insertBack(static_cast<Eigen::Index>(6 * column) + i, global) = diagonal(i, j);
      for (std::size_t b = 0; b < blocks.size(); ++b) {
        for (int i = 0; i < 6; ++i) out.insertBack(6 * below[b].first + i, global) = blocks[b](i, j);
      }
    }
  }
  out.finalize();
  return out;
}

}  // namespace macadam::harmonic
