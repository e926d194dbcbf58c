// SPDX-License-Identifier: GPL-3.0-or-later
/// \file two_level.hpp  A real preconditioner of two levels: each particle by itself, and the rigid motions of boxes of
/// particles together.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "host/harmonic/rigid_motions.hpp"
#include "kernels/layout.hpp"
#include "macadam/specimen.hpp"

namespace macadam::harmonic {

/// z = (Σ_i K_ii⁻¹ + R·(RᵀKR)⁻¹·Rᵀ)·r, with Re K at one frequency. R has six columns a box, the motions of its
/// particles under three displacements of it and three turns about its middle, over its half width.
struct TwoLevel {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  TwoLevel(const Specimen& specimen, const ContactNetwork& network, const kernels::Layout& layout,
           const PairStiffness& stiffness, const FreeMotions& free);

  std::size_t boxes() const { return box_body.size() - 1; }
  /// Motion of a body under the motions of its box: u = d + θ × lever / width, rotation θ / width.
  struct Lever {
    double x, y, z, width;
  };

  /// A rigid motion of the whole, given by particle, as motions of the boxes.
  Eigen::VectorXd motions_of_boxes(const std::vector<double>& motion, const kernels::Layout& layout) const;

  std::vector<double> inverse;         ///< [body][36], K_ii⁻¹, symmetric
  std::vector<Lever> lever;            ///< [body]
  std::vector<std::int32_t> box_body;  ///< box → first body; boxes + 1 entries
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> coarse;  ///< (RᵀKR)⁻¹; free motions left out
};

}  // namespace macadam::harmonic
