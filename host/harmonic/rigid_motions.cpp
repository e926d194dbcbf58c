// SPDX-License-Identifier: GPL-3.0-or-later
// rigid_motions.cpp  Finds free motions (motions that no contact resists) as null spaces of small matrices. Free rigid
// motions of a part are the null space of the stiffness with which the contacts around the part resist its six rigid
// motions. Free motions of single particles are the null spaces of their stiffness blocks.
#include "host/harmonic/rigid_motions.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "host/harmonic/sliding_parts.hpp"
#include "kernels/base/parallel.hpp"
#include "macadam/error.hpp"

namespace macadam::harmonic {
namespace {

using OwnMotions = Eigen::Matrix<double, 6, Eigen::Dynamic>;  ///< columns: motions of one particle

/// Returns the motion of a particle under the six rigid motions about the middle of the box, one per column. Turns are
/// multiplied by the height of the box, so that all six coefficients are lengths.
Matrix6 rigid(const Specimen& specimen, std::int32_t particle) {
  const double height = gauge_length(specimen);
  const Vec3d r = specimen.centre[static_cast<std::size_t>(particle)] - 0.5 * specimen.box.size;
  Matrix6 out = Matrix6::Identity();
  // a turn about axis k displaces the particle by e_k × r
  out.topRightCorner<3, 3>() << 0, r.z, -r.y, -r.z, 0, r.x, r.y, -r.x, 0;
  out.rightCols<3>() /= height;
  return out;
}

/// Makes a motion orthonormal to the motions of the list from number `first` on, with respect to masses, and appends
/// it. The caller ensures that each of these earlier motions moves either one particle of the new motion or all
/// particles of the new motion.
void add_orthonormal(FreeMotion added, std::size_t first, const Inertia& inertia, std::vector<FreeMotion>& list) {
  const auto weighted = [&](const FreeMotion& m, const double* a, const double* b) {
    return sum_in_parallel<double>(m.motion.size(), [&](std::size_t i) {
      return a[i] * inertia_at(inertia, 6 * static_cast<std::size_t>(m.particles[i / 6]) + i % 6) * b[i];
    });
  };
  for (std::size_t m = first; m < list.size(); ++m) {
    const FreeMotion& earlier = list[m];
    const auto at = std::ranges::lower_bound(added.particles, earlier.particles.front()) - added.particles.begin();
    double* const same = added.motion.data() + 6 * at;
    const double share = weighted(earlier, earlier.motion.data(), same);
    for (std::size_t i = 0; i < earlier.motion.size(); ++i) same[i] -= share * earlier.motion[i];
  }
  const double norm = std::sqrt(weighted(added, added.motion.data(), added.motion.data()));
  for (double& v : added.motion) v /= norm;
  list.push_back(std::move(added));
}

/// Returns the indices of `wanted` linearly independent columns. Repeatedly takes the longest column and removes its
/// direction from all columns. The matrix is overwritten.
std::vector<std::size_t> independent_columns(Eigen::MatrixXd& matrix, int wanted) {
  const auto columns = static_cast<std::size_t>(matrix.cols());
  struct Longest {
    double square = -1;
    std::size_t column = 0;
    Longest& operator+=(const Longest& o) {
      if (o.square > square) *this = o;  // of equally long columns, the first is kept
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

/// One part of a cluster with its free motions: rigid motions of the part, and motions of single particles.
class Part {
 public:
  Part(const Specimen& specimen, const ContactNetwork& network, const PairStiffness& stiffness,
       const std::vector<std::int32_t>& members, bool is_cluster)
      : specimen_(specimen), network_(network), stiffness_(stiffness), members_(members) {
    find_rigid(is_cluster);
    if (members.size() > 1) find_own();
  }

  /// Appends pins and orthonormal motions of this part.
  void add_to(FreeMotions& out, const Inertia& inertia) const {
    const std::size_t first = out.motions.size();
    for (const auto& [k, own] : own_) {
      const std::int32_t particle = members_[k];
      const double radius = radius_of(k);
      for (Eigen::Index m = 0; m < own.cols(); ++m) {
        Pin pin{static_cast<std::size_t>(particle), {}, largest_};
        FreeMotion motion{{particle}, std::vector<double>(6)};
        for (std::size_t c = 0; c < 6; ++c) {
          const double v = own(static_cast<Eigen::Index>(c), m);
          pin.direction[c] = c < 3 ? v : v * radius;
          motion.motion[c] = c < 3 ? v : v / radius;
        }
        out.pins.push_back(pin);
        // motions of other single particles are already orthogonal to this motion
        add_orthonormal(std::move(motion), out.motions.size() - static_cast<std::size_t>(m), inertia, out.motions);
      }
    }
    if (rigid_.cols() == 0) return;
    add_pins(out);
    for (Eigen::Index m = 0; m < rigid_.cols(); ++m) {
      FreeMotion motion{members_, std::vector<double>(6 * members_.size())};
#pragma omp parallel for schedule(static)
      for (std::size_t k = 0; k < members_.size(); ++k) {
        Eigen::Map<Eigen::Matrix<double, 6, 1>> at(&motion.motion[6 * k]);
        at = rigid(specimen_, members_[k]) * rigid_.col(m);
      }
      add_orthonormal(std::move(motion), first, inertia, out.motions);
    }
  }

 private:
  double radius_of(std::size_t k) const { return specimen_.radius[static_cast<std::size_t>(members_[k])]; }

  /// Finds the rigid motions of the part that its contacts with other parts and with walls do not resist while all
  /// other particles and the walls are at rest.
  void find_rigid(bool is_cluster) {
    Matrix6 around = Matrix6::Zero();
    for (const std::int32_t particle : members_) {
      for (const std::uint32_t number : network_.row(static_cast<std::size_t>(particle))) {
        const Contact& c = network_.contacts[number];
        const bool at_a = c.a == particle;
        if (c.b >= 0 && (is_cluster || std::ranges::binary_search(members_, at_a ? c.b : c.a))) continue;
        const auto pair = static_cast<std::size_t>(c.pair);
        const int end = at_a ? 0 : 1;
        const Matrix6 motion = rigid(specimen_, particle);
        around +=
            motion.transpose() * contact_block(c, stiffness_.k[pair].real(), stiffness_.alpha[pair], end, end) * motion;
      }
    }
    const Eigen::SelfAdjointEigenSolver<Matrix6> modes(around);
    largest_ = modes.eigenvalues()(5);
    int free = 0;
    // 1e-12 is the rounding error of sums of up to 1e4 terms
    while (free < 6 && modes.eigenvalues()(free) < 1e-12 * largest_) ++free;
    rigid_ = modes.eigenvectors().leftCols(free);
  }

  /// Finds the free motions of single particles, and removes the rigid motions that consist of such motions only.
  void find_own() {
    for (std::size_t k = 0; k < members_.size(); ++k) {
      OwnMotions own = own_motions(members_[k], specimen_, network_, stiffness_);
      if (own.cols() > 0) own_.emplace_back(k, std::move(own));
    }
    if (own_.empty() || rigid_.cols() == 0) return;
    Eigen::MatrixXd all = scaled_motions();
    const Eigen::MatrixXd whole = all * all.transpose();
    remove_own(all);
    // each eigenvalue, 0 to 1, is the fraction of a rigid motion that is left when the particles' own free motions are
    // removed from it
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> left(all * all.transpose(), whole);
    int gone = 0;
    while (gone < rigid_.cols() && left.eigenvalues()(gone) < 1e-9)
      ++gone;  // rounding leaves less; if just one particle in 1e9 cannot turn by itself, 1e-9 is left
    rigid_ = (rigid_ * left.eigenvectors().rightCols(rigid_.cols() - gone)).eval();
  }

  /// Returns the rigid motions as [rigid motion][6·member + component], rotations multiplied by the particles' radii
  /// [m].
  Eigen::MatrixXd scaled_motions() const {
    Eigen::MatrixXd out(rigid_.cols(), static_cast<Eigen::Index>(6 * members_.size()));
#pragma omp parallel for schedule(static)
    for (std::size_t k = 0; k < members_.size(); ++k) {
      auto columns = out.middleCols<6>(static_cast<Eigen::Index>(6 * k));
      columns = (rigid(specimen_, members_[k]) * rigid_).transpose();
      columns.rightCols<3>() *= radius_of(k);
    }
    return out;
  }

  /// Removes the particles' own motions from the rigid motions in `all`.
  void remove_own(Eigen::MatrixXd& all) const {
    for (const auto& [k, own] : own_) {
      auto columns = all.middleCols<6>(static_cast<Eigen::Index>(6 * k));
      columns -= (columns * own * own.transpose()).eval();
    }
  }

  /// Adds one pin for each rigid motion, on single degrees of freedom of particles that are far apart. Displacements
  /// are preferred. A rotation is pinned only if the part lies on the axis of the turn, so that the turn displaces no
  /// particle.
  void add_pins(FreeMotions& out) const {
    constexpr double of_rotations = 1e-3;
    Eigen::MatrixXd all = scaled_motions();
    remove_own(all);
    for (std::size_t k = 0; k < members_.size(); ++k)
      all.middleCols<3>(static_cast<Eigen::Index>(6 * k + 3)) *= of_rotations;
    for (const std::size_t column : independent_columns(all, static_cast<int>(rigid_.cols()))) {
      const std::size_t k = column / 6, c = column % 6;
      Pin pin{static_cast<std::size_t>(members_[k]), {}, largest_};
      pin.direction[c] = c < 3 ? 1 : radius_of(k);
      out.pins.push_back(pin);
    }
  }

  const Specimen& specimen_;
  const ContactNetwork& network_;
  const PairStiffness& stiffness_;
  const std::vector<std::int32_t>& members_;
  double largest_ = 0;  ///< largest stiffness of the contacts around the part [N/m]
  OwnMotions rigid_;    ///< free rigid motions; columns of coefficients of rigid()
  /// (member, free motions of this particle alone), members ascending.
  std::vector<std::pair<std::size_t, OwnMotions>> own_;
};

}  // namespace

void FreeMotion::remove_from(Vector& other, const Inertia& inertia) const {
  const auto dof = [this](std::size_t i) { return 6 * static_cast<std::size_t>(particles[i / 6]) + i % 6; };
  const auto share = sum_in_parallel<Complex>(
      motion.size(), [&](std::size_t i) { return motion[i] * inertia_at(inertia, dof(i)) * other[dof(i)]; });
  for (std::size_t i = 0; i < motion.size(); ++i) other[dof(i)] -= share * motion[i];
}

FreeMotions find_free_motions(const Specimen& specimen, const ContactNetwork& network, const PairStiffness& stiffness,
                              const Inertia& inertia) {
  FreeMotions out;
  for (const Cluster& cluster : find_clusters(network, specimen.size())) {
    if (!cluster.spans()) {
      throw InputError(
          "harmonic: the stiffness is singular: found " + describe(cluster) +
          ", expected every particle to have paths of contacts to both walls (check gap_max and area_min)");
    }
    const auto parts = sliding_parts(cluster, network, stiffness);
    for (const auto& part : parts) Part(specimen, network, stiffness, part, parts.size() == 1).add_to(out, inertia);
  }
  return out;
}

}  // namespace macadam::harmonic
