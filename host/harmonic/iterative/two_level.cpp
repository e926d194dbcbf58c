// SPDX-License-Identifier: GPL-3.0-or-later
// two_level.cpp  Contacts between boxes make up the coarse matrix: a rigid motion strains none inside.
#include "host/harmonic/iterative/two_level.hpp"

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "host/network/contact_stiffness.hpp"
#include "macadam/error.hpp"

namespace macadam::harmonic {
namespace {

TwoLevel::Matrix6 motion_of(const TwoLevel::Lever& l) {
  TwoLevel::Matrix6 t = TwoLevel::Matrix6::Identity();
  t.topRightCorner<3, 3>() << 0, l.z, -l.y, -l.z, 0, l.x, l.y, -l.x, 0;  // e_k × lever
  t.rightCols<3>() /= l.width;
  return t;
}

}  // namespace

TwoLevel::TwoLevel(const Specimen& specimen, const ContactNetwork& network, const kernels::Layout& layout,
                   const PairStiffness& stiffness, const FreeMotions& free)
    : box_body(layout.tile_body) {
  const std::size_t n = layout.particles();
  std::vector<std::int32_t> box_of(n);
  lever.resize(n);
  for (std::size_t b = 0; b < boxes(); ++b) {
    Vec3d low{1e300, 1e300, 1e300}, high = -low;
    for (auto i = box_body[b]; i < box_body[b + 1]; ++i) {
      box_of[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(b);
      const Vec3d& c = specimen.centre[static_cast<std::size_t>(layout.particle[static_cast<std::size_t>(i)])];
      low = {std::min(low.x, c.x), std::min(low.y, c.y), std::min(low.z, c.z)};
      high = {std::max(high.x, c.x), std::max(high.y, c.y), std::max(high.z, c.z)};
    }
    const Vec3d middle = 0.5 * (low + high);
    const double width = std::max(0.5 * norm(high - low), 1e-3 * norm(specimen.box.size));
    for (auto i = box_body[b]; i < box_body[b + 1]; ++i) {
      const Vec3d l = specimen.centre[static_cast<std::size_t>(layout.particle[static_cast<std::size_t>(i)])] - middle;
      lever[static_cast<std::size_t>(i)] = {l.x, l.y, l.z, width};
    }
  }
  const auto parameters = [&](const Contact& c) {
    const auto pair = static_cast<std::size_t>(c.pair);
    return std::pair{stiffness.k[pair].real(), stiffness.alpha[pair]};
  };
  inverse.resize(36 * n);
  constexpr std::int32_t none = std::numeric_limits<std::int32_t>::max();
  std::int32_t loose = none;
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < n; ++i) {
    const std::int32_t particle = layout.particle[i];
    Matrix6 own = Matrix6::Zero();
    for (const std::uint32_t number : network.row(static_cast<std::size_t>(particle))) {
      const Contact& c = network.contacts[number];
      const auto [k, alpha] = parameters(c);
      const int end = c.a == particle ? 0 : 1;
      own += contact_block(c, k, alpha, end, end);
    }
    const Eigen::LLT<Matrix6> factor(own);
    if (factor.info() != Eigen::Success) {
#pragma omp critical
      loose = std::min(loose, particle);
      continue;
    }
    Eigen::Map<Matrix6> to(inverse.data() + 36 * i);
    to = factor.solve(Matrix6::Identity());
  }
  if (loose < none) { throw RunError(fmt::format("harmonic: particle {} can move by itself without force", loose)); }
  Eigen::MatrixXd k =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(6 * boxes()), static_cast<Eigen::Index>(6 * boxes()));
  for (const Contact& c : network.contacts) {
    const auto a = static_cast<std::size_t>(layout.body_of(c.a));
    const auto [stiff, alpha] = parameters(c);
    const Eigen::Index box_a = 6 * box_of[a];
    const Matrix6 motion_a = motion_of(lever[a]);
    if (c.b < 0) {
      k.block<6, 6>(box_a, box_a) += motion_a.transpose() * contact_block(c, stiff, alpha, 0, 0) * motion_a;
      continue;
    }
    const auto b = static_cast<std::size_t>(layout.body_of(c.b));
    const Eigen::Index box_b = 6 * box_of[b];
    if (box_a == box_b) continue;
    const Matrix6 motion_b = motion_of(lever[b]);
    k.block<6, 6>(box_a, box_a) += motion_a.transpose() * contact_block(c, stiff, alpha, 0, 0) * motion_a;
    k.block<6, 6>(box_b, box_b) += motion_b.transpose() * contact_block(c, stiff, alpha, 1, 1) * motion_b;
    const Matrix6 across = motion_a.transpose() * contact_block(c, stiff, alpha, 0, 1) * motion_b;
    k.block<6, 6>(box_a, box_b) += across;
    k.block<6, 6>(box_b, box_a) += across.transpose();
  }
  // Motions of the whole that no wall resists have no stiffness among the boxes either. They are given some: what of
  // them gets into z is taken out of it anyway.
  const double usual = k.trace() / static_cast<double>(k.rows());
  for (const std::vector<double>& motion : free.motions) {
    const Eigen::VectorXd boxes_move = motions_of_boxes(motion, layout);
    k += usual / boxes_move.squaredNorm() * boxes_move * boxes_move.transpose();
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(k);
  if (factor.info() != Eigen::Success) throw RunError("harmonic: boxes of particles can move without force");
  coarse = factor.solve(Eigen::MatrixXd::Identity(k.rows(), k.cols()));
}

Eigen::VectorXd TwoLevel::motions_of_boxes(const std::vector<double>& motion, const kernels::Layout& layout) const {
  Eigen::VectorXd out(static_cast<Eigen::Index>(6 * boxes()));
  for (std::size_t b = 0; b < boxes(); ++b) {
    const auto body = static_cast<std::size_t>(box_body[b]);  // a rigid motion: any of the box will do
    const double* u = &motion[6 * static_cast<std::size_t>(layout.particle[body])];
    const Lever& l = lever[body];
    const Vec3d turn{u[3], u[4], u[5]}, middle = Vec3d{u[0], u[1], u[2]} - cross(turn, Vec3d{l.x, l.y, l.z});
    out.segment<6>(static_cast<Eigen::Index>(6 * b)) << middle.x, middle.y, middle.z, l.width * turn.x,
        l.width * turn.y, l.width * turn.z;
  }
  return out;
}

}  // namespace macadam::harmonic
