// SPDX-License-Identifier: GPL-3.0-or-later
// reduced_model.cpp  Makes the motions of the reduced basis orthonormal, computes the small stiffness and mass
// matrices for these motions, and solves the small linear systems.
#include "host/harmonic/reduced_model.hpp"

#include <algorithm>
#include <cmath>

#include "host/harmonic/contact_motions.hpp"
#include "kernels/base/parallel.hpp"
#include "kernels/harmonic/contact_end.hpp"
#include "macadam/error.hpp"

namespace macadam::harmonic {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXcd;

/// A motion is not added to the basis if its part outside the span of the basis is shorter than this fraction of the
/// motion. The relative error of E* is of the order of the square of this fraction.
constexpr double nothing_new = 1e-6;

/// Sums are computed in this many parts, which are then added in order. So the result does not depend on the number of
/// threads.
constexpr std::size_t pieces = 16;

auto as_columns(const Vector& motion) {
  return Eigen::Map<const VectorXcd>(motion.data(), static_cast<Index>(motion.size()));
}

/// Calls f(piece, first row, number of rows) for all pieces in parallel.
template <class F>
void for_each_piece(Index rows, F&& f) {
  for_each_in_parallel(pieces, [&](std::size_t p) {
    const Index begin = static_cast<Index>(p) * rows / static_cast<Index>(pieces);
    f(p, begin, static_cast<Index>(p + 1) * rows / static_cast<Index>(pieces) - begin);
  });
}

/// Returns aᵀ·b.
MatrixXd products(const Eigen::Ref<const MatrixXd>& a, const Eigen::Ref<const MatrixXd>& b) {
  std::vector<MatrixXd> sums(pieces);
  for_each_piece(a.rows(), [&](std::size_t p, Index begin, Index rows) {
    sums[p] = a.middleRows(begin, rows).transpose() * b.middleRows(begin, rows);
  });
  for (std::size_t p = 1; p < pieces; ++p) sums[0] += sums[p];
  return sums[0];
}

/// Subtracts the matrix product `columns`·`shares` from `from`.
void take_away(MatrixXd& from, const Eigen::Ref<const MatrixXd>& columns, const MatrixXd& shares) {
  for_each_piece(from.rows(), [&](std::size_t, Index begin, Index rows) {
    from.middleRows(begin, rows).noalias() -= columns.middleRows(begin, rows) * shares;
  });
}

}  // namespace

ReducedModel::ReducedModel(const Specimen& specimen, const ContactNetwork& network, Inertia inertia,
                           const RockClassing& classing)
    : specimen_(specimen),
      network_(network),
      inertia_(std::move(inertia)),
      rock_(network, classing),
      in_rock_(rock_.classes().size()) {
  if (!network.cells.empty())
    throw InputError("reduced model", 0, "rule of the network", "\"volumetric\"",
                     "\"centres\" or \"series\", because the model does not contain the pressures of cells");
  for (const Contact& c : network.contacts) has_rock_.push_back(c.series > 0);
}

void ReducedModel::add(const std::vector<Vector>& motions) {
  if (motions.empty()) return;
  const Index before = basis_.cols();
  if (before == 0) basis_ = as_columns(motions.front()).real();
  const MatrixXd fresh = new_columns(motions);
  basis_.conservativeResize(Eigen::NoChange, basis_.cols() + fresh.cols());
  basis_.rightCols(fresh.cols()) = fresh;
  project(before);
}

MatrixXd ReducedModel::new_columns(const std::vector<Vector>& motions) const {
  MatrixXd out(basis_.rows(), 2 * std::ssize(motions));
  Eigen::VectorXd whole(out.cols());
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const auto at = 2 * static_cast<Index>(i);
    out.col(at) = as_columns(motions[i]).real() - basis_.col(0);
    out.col(at + 1) = as_columns(motions[i]).imag();
    whole[at] = whole[at + 1] = length(motions[i]);
  }
  const auto others = basis_.rightCols(basis_.cols() - 1);
  Index kept = 0;
  for (int twice = 0; twice < 2; ++twice)
    take_away(out, others, products(others, out));  // the second pass removes the rounding error of the first
  for (Index j = 0; j < out.cols(); ++j) {
    MatrixXd column = out.col(j);
    for (int twice = 0; twice < 2; ++twice) {
      const auto before = out.leftCols(kept);
      take_away(column, before, products(before, column));
    }
    const double rest = std::sqrt(products(column, column)(0, 0));
    if (rest > nothing_new * whole[j]) out.col(kept++) = column / rest;
  }
  return out.leftCols(kept);
}

/// Computes the columns `from`, `from` + 1, … of the small matrices, and the same rows, because the matrices are
/// symmetric.
void ReducedModel::project(Index from) {
  constexpr Index stack = 48;  // number of contacts whose products are computed as one matrix product
  const Index count = basis_.cols(), added = count - from;
  const auto& contacts = network_.contacts;
  using Sums = std::array<MatrixXd, 2 * pair_types>;
  std::vector<Sums> sums(pieces);
  for_each_in_parallel(pieces, [&](std::size_t piece) {
    std::array<MatrixXd, 2 * pair_types> motion, force;
    std::array<Index, pair_types> filled{};
    ContactMotions u(count);
    const auto flush = [&](std::size_t pair) {
      for (const std::size_t form : {2 * pair, 2 * pair + 1}) {
        sums[piece][form].noalias() +=
            motion[form].topRows(3 * filled[pair]).transpose() * force[form].topRows(3 * filled[pair]);
      }
      filled[pair] = 0;
    };
    for (std::size_t i = piece * contacts.size() / pieces; i < (piece + 1) * contacts.size() / pieces; ++i) {
      if (has_rock_[i]) continue;  // RockClasses sums these contacts
      const Contact& c = contacts[i];
      const auto pair = static_cast<std::size_t>(c.pair);
      if (motion[2 * pair].size() == 0) {
        for (const std::size_t form : {2 * pair, 2 * pair + 1}) {
          motion[form].resize(3 * stack, count);
          force[form].resize(3 * stack, added);
          sums[piece][form] = MatrixXd::Zero(count, added);
        }
      }
      u.set(c, basis_);
      const Index row = 3 * filled[pair];
      motion[2 * pair].middleRows<3>(row) = u.normal;
      motion[2 * pair + 1].middleRows<3>(row) = u.shear;
      force[2 * pair].middleRows<3>(row) = normal_form(c) * u.normal.rightCols(added);
      force[2 * pair + 1].middleRows<3>(row) = shear_form(c) * u.shear.rightCols(added);
      if (++filled[pair] == stack) flush(pair);
    }
    for (std::size_t pair = 0; pair < pair_types; ++pair)
      if (filled[pair] > 0) flush(pair);
  });
  const auto widen = [&](MatrixXd& m, const MatrixXd& columns) {
    m.conservativeResize(count, count);
    m.rightCols(added) = columns;
    m.bottomRows(added) = columns.transpose();
  };
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    for (const bool shear : {false, true}) {
      MatrixXd columns = MatrixXd::Zero(count, added);
      for (const Sums& s : sums)
        if (const MatrixXd& m = s[2 * pair + (shear ? 1 : 0)]; m.size() > 0) columns += m;
      widen(shear ? shear_[pair] : normal_[pair], columns);
    }
  }
  const std::vector<RockForms> of_classes = rock_.columns(basis_, from);
  for (std::size_t i = 0; i < of_classes.size(); ++i) {
    widen(in_rock_[i].normal, of_classes[i].normal);
    widen(in_rock_[i].shear, of_classes[i].shear);
  }
  if (inertia_.mass.empty()) {
    mass_ = MatrixXd::Zero(count, count);
    return;
  }
  MatrixXd momentum = basis_.rightCols(added);
  for (Index i = 0; i < momentum.rows(); ++i) momentum.row(i) *= inertia_at(inertia_, static_cast<std::size_t>(i));
  widen(mass_, products(basis_, momentum));
}

ReducedModel::Solution ReducedModel::solve(const LawTable& laws, const HarmonicLoad& load, double rock) const {
  const Complex s = load.s(), inertia = load.density_scaling * (s * s + s * load.viscous_damping);
  const PairStiffness stiffness = pair_stiffness(laws, s);
  Eigen::MatrixXcd whole = inertia * mass_;
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    whole += stiffness.k[pair] * normal_[pair];
    whole += stiffness.k[pair] * stiffness.alpha[pair] * shear_[pair];
  }
  // stiffnesses of a class in normal and in shear direction, with α
  const auto stiffness_of = [&](const RockClasses::Class& of) {
    const double series = rock * of.series, alpha = stiffness.alpha[of.pair];
    const Complex k = stiffness.k[of.pair];
    return std::array<Complex, 2>{kernels::in_series(k, series), alpha * kernels::in_series(k, alpha * series)};
  };
  for (std::size_t i = 0; i < in_rock_.size(); ++i) {
    const auto [normal, shear] = stiffness_of(rock_.classes()[i]);
    whole += normal * in_rock_[i].normal;
    whole += shear * in_rock_[i].shear;
  }
  Solution out;
  out.of_the_motions = VectorXcd::Ones(basis_.cols());
  const Index free = basis_.cols() - 1;
  if (free > 0) {
    // Degrees of freedom have different units, and stiff walls make some rows far larger than others. So rows and
    // columns are scaled by the diagonal.
    const Eigen::VectorXd scale = whole.diagonal().tail(free).cwiseAbs().cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXcd scaled = scale.asDiagonal() * whole.bottomRightCorner(free, free) * scale.asDiagonal();
    const VectorXcd right = scale.asDiagonal() * whole.bottomLeftCorner(free, 1);
    out.of_the_motions.tail(free) = -(scale.asDiagonal() * scaled.partialPivLu().solve(right));
  }
  if (!out.of_the_motions.allFinite())
    throw RunError("harmonic: the reduced system of the known motions has no finite solution");
  const double to_modulus = gauge_length(specimen_) / section_area(specimen_);
  const auto energy = [&](const Matrix& m) -> Complex {  // without conjugates
    return to_modulus * (out.of_the_motions.transpose() * m * out.of_the_motions).value();
  };
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    out.parts.normal[pair] = stiffness.k[pair] * energy(normal_[pair]);
    out.parts.shear[pair] = stiffness.k[pair] * stiffness.alpha[pair] * energy(shear_[pair]);
  }
  for (std::size_t i = 0; i < in_rock_.size(); ++i) {
    const RockClasses::Class& of = rock_.classes()[i];
    const auto [normal, shear] = stiffness_of(of);
    const Complex of_normal = normal * energy(in_rock_[i].normal), of_shear = shear * energy(in_rock_[i].shear);
    out.parts.normal[of.pair] += of_normal;
    out.parts.shear[of.pair] += of_shear;
    out.parts.normal_rock[of.pair] += rock * of.series * normal * of_normal;
    out.parts.shear_rock[of.pair] += rock * of.series * shear * of_shear;
  }
  out.parts.inertia = inertia * energy(mass_);
  return out;
}

Vector ReducedModel::motion(const Solution& solution) const {
  Vector out(static_cast<std::size_t>(basis_.rows()));
#pragma omp parallel for schedule(static)
  for (Index i = 0; i < basis_.rows(); ++i) {
    Complex sum = 0;
    for (Index j = 0; j < basis_.cols(); ++j) sum += basis_(i, j) * solution.of_the_motions[j];
    out[static_cast<std::size_t>(i)] = sum;
  }
  return out;
}

}  // namespace macadam::harmonic
