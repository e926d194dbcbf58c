// SPDX-License-Identifier: GPL-3.0-or-later
// make_system.cpp  Builds the arrays of the iterative solver. The columns of the matrix R are rigid motions of
// boxes of particles. The coarse matrix RᵀKR is summed only over contacts between boxes, because a rigid motion of a
// box does not strain the contacts inside it.
#include "host/harmonic/iterative/make_system.hpp"

#include "host/harmonic/iterative/invert.hpp"
#include "host/harmonic/linear_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "kernels/base/parallel.hpp"
#include "kernels/contact/initial_contact.hpp"
#include "kernels/harmonic/particle_block.hpp"

namespace macadam::harmonic {

using kernels::ContactEnd;
using kernels::Lever;
using kernels::LinearSystem;
using kernels::Twist;

namespace {

/// Returns the data of a contact for its first particle, with the normal pointing away from this particle.
ContactEnd seen_from_a(const Contact& c, const kernels::Layout& layout) {
  ContactEnd e{{c.n.x, c.n.y, c.n.z},
               {c.s.x, c.s.y, c.s.z},
               c.arm_a,
               c.arm_b,
               {},
               c.b >= 0 ? layout.body_of(c.b) : kernels::wall_at_rest,
               static_cast<std::int32_t>(c.pair)};
  kernels::moments_over_length(c, e.moments);
  return e;
}

/// Returns the data of a contact for its second particle. Its frame is (−n, s, −t), so coordinates along t change their
/// sign.
ContactEnd seen_from_b(const Contact& c, const kernels::Layout& layout) {
  ContactEnd e = seen_from_a(c, layout);
  for (double& x : e.n) x = -x;
  std::swap(e.arm, e.arm_other);
  e.moments[2] = -e.moments[2];
  e.moments[4] = -e.moments[4];
  e.other = layout.body_of(c.a);
  return e;
}

/// Fills the contacts of every particle.
void make_rows(const ContactNetwork& network, const kernels::Layout& layout, LinearSystem& out) {
  const std::size_t n = layout.particles();
  out.particle = layout.particle;
  out.row_begin.assign(n + 1, 0);
#pragma omp parallel for schedule(static)
  for (std::size_t body = 0; body < n; ++body) {
    out.row_begin[body + 1] = network.row(static_cast<std::size_t>(layout.particle[body])).size();
  }
  std::partial_sum(out.row_begin.begin(), out.row_begin.end(), out.row_begin.begin());
  out.ends.resize(out.row_begin.back());
#pragma omp parallel for schedule(static)
  for (std::size_t body = 0; body < n; ++body) {
    const std::int32_t particle = layout.particle[body];
    ContactEnd* to = out.ends.data() + out.row_begin[body];
    for (const std::uint32_t number : network.row(static_cast<std::size_t>(particle))) {
      const Contact& c = network.contacts[number];
      *to++ = c.a == particle ? seen_from_a(c, layout) : seen_from_b(c, layout);
    }
  }
  for (std::size_t body = 0; body < (network.cells.empty() ? 0 : n); ++body)
    out.cells.push_back(network.cells[static_cast<std::size_t>(layout.particle[body])]);
  const auto& contacts = network.contacts;
  if (std::all_of(contacts.begin(), contacts.end(), [](const Contact& c) { return c.series == 0; })) return;
  out.series.resize(out.ends.size());
  for (std::size_t body = 0; body < n; ++body) {
    std::size_t to = out.row_begin[body];
    for (const std::uint32_t number : network.row(static_cast<std::size_t>(layout.particle[body])))
      out.series[to++] = contacts[number].series;
  }
}

/// Calls f(box, body) for the bodies of every box; boxes run in parallel.
template <class F>
void for_each_body(const LinearSystem& system, F&& f) {
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t b = 0; b < system.boxes(); ++b) {
    for (auto i = system.box_body[b]; i < system.box_body[b + 1]; ++i) f(b, static_cast<std::size_t>(i));
  }
}

/// Computes the lever of every body: its position relative to the middle of its box, and the half diagonal of the box,
/// which scales rotations to lengths.
void make_levers(const Specimen& specimen, const kernels::Layout& layout, LinearSystem& out) {
  out.box_body = layout.tile_body;
  out.lever.resize(layout.particles());
  std::vector<Vec3d> low(out.boxes(), Vec3d{1e300, 1e300, 1e300}), high(out.boxes(), Vec3d{-1e300, -1e300, -1e300});
  const auto centre = [&](std::size_t i) { return specimen.centre[static_cast<std::size_t>(layout.particle[i])]; };
  for_each_body(out, [&](std::size_t b, std::size_t i) {
    const Vec3d c = centre(i);
    low[b] = {std::min(low[b].x, c.x), std::min(low[b].y, c.y), std::min(low[b].z, c.z)};
    high[b] = {std::max(high[b].x, c.x), std::max(high[b].y, c.y), std::max(high[b].z, c.z)};
  });
  for_each_body(out, [&](std::size_t b, std::size_t i) {
    const Vec3d l = centre(i) - 0.5 * (low[b] + high[b]);
    const double width = std::max(0.5 * norm(high[b] - low[b]), 1e-3 * norm(specimen.box.size));
    out.lever[i] = {l.x, l.y, l.z, width};
  });
}

/// Returns the motion of a body under motion c of its box: column c of R.
Twist<double> box_motion(const Lever& lever, int c) {
  double y[6] = {};
  y[c] = 1;
  return kernels::moved_with_box(lever, y);
}

/// Returns RᵀKR, [6·boxes][6·boxes]. For each box only its own six rows are written, so that boxes can be computed in
/// parallel.
Eigen::MatrixXd coarse_stiffness(const LinearSystem& system) {
  const auto size = static_cast<Eigen::Index>(6 * system.boxes());
  std::vector<std::int32_t> box_of(system.bodies());
  for_each_body(system, [&](std::size_t b, std::size_t i) { box_of[i] = static_cast<std::int32_t>(b); });
  // the matrix is symmetric, so rows are written as columns, which are contiguous
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(size, size);
  for_each_body(system, [&](std::size_t box, std::size_t i) {
    const auto row = static_cast<Eigen::Index>(6 * box);
    for (std::size_t at = system.row_begin[i]; at < system.row_begin[i + 1]; ++at) {
      const ContactEnd& e = system.ends[at];
      const auto pair = static_cast<std::size_t>(e.pair);
      const auto other = static_cast<std::size_t>(e.other);
      if (e.other >= 0 && box_of[other] == static_cast<std::int32_t>(box)) continue;
      const double alpha = system.typical.alpha[pair], series = system.series_of(at),
                   normal = kernels::in_series(system.typical.k[pair], series),
                   shear = kernels::in_series(system.typical.k[pair], alpha * series);
      const auto add = [&](Eigen::Index column, const Twist<double>& own, const Twist<double>& far) {
        double y[6] = {};
        kernels::add_to_box(
            system.lever[i],
            kernels::end_load(
                e, own, far, [&](double u, bool in_shear) { return (in_shear ? shear : normal) * u; }, alpha),
            y);
        for (int c = 0; c < 6; ++c) k(column, row + c) -= y[c];
      };
      for (int c = 0; c < 6; ++c) {
        add(row + c, box_motion(system.lever[i], c), {});
        if (e.other >= 0) add(6 * box_of[other] + c, {}, box_motion(system.lever[other], c));
      }
    }
  });
  return k;
}

/// Returns a free motion of the whole specimen as motions of the boxes. Since it is rigid, the first body of a box
/// determines the motion of the box.
Eigen::VectorXd motions_of_boxes(const LinearSystem& system, int motion) {
  Eigen::VectorXd out(static_cast<Eigen::Index>(6 * system.boxes()));
  for (std::size_t b = 0; b < system.boxes(); ++b) {
    const auto body = static_cast<std::size_t>(system.box_body[b]);
    const double* u =
        &system.motion[(body * static_cast<std::size_t>(system.free) + static_cast<std::size_t>(motion)) * 6];
    const Lever& l = system.lever[body];
    const Vec3d turn{u[3], u[4], u[5]}, middle = Vec3d{u[0], u[1], u[2]} - cross(turn, Vec3d{l.x, l.y, l.z});
    out.segment<6>(static_cast<Eigen::Index>(6 * b)) << middle.x, middle.y, middle.z, l.width * turn.x,
        l.width * turn.y, l.width * turn.z;
  }
  return out;
}

/// Returns Rᵀ·M·m for the free motion m with number `motion` (see make_weights()). It is used for free motions in which
/// only some of the particles move. The result is not zero if the boxes can move as in the free motion.
Eigen::VectorXd weights_of_boxes(const LinearSystem& system, int motion) {
  const auto size = static_cast<Eigen::Index>(6 * system.boxes());
  return Eigen::Map<const Eigen::VectorXd>(system.weight.data() + motion * size, size);
}

/// Copies masses and free motions into the order of the layout.
void make_motions(const kernels::Layout& layout, const Inertia& inertia, const FreeMotions& free, LinearSystem& out) {
  const std::size_t n = layout.particles(), motions = free.motions.size();
  out.free = static_cast<int>(motions);
  out.mass.resize(2 * n);
  out.motion.resize(6 * n * motions);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < n; ++i) {
    const auto particle = static_cast<std::size_t>(layout.particle[i]);
    out.mass[2 * i] = inertia.mass[particle];
    out.mass[2 * i + 1] = inertia.inertia[particle];
  }
  out.own_motions.assign(n, 0);
  for (std::size_t m = 0; m < motions; ++m) {
    const FreeMotion& motion = free.motions[m];
    for (std::size_t k = 0; k < motion.particles.size(); ++k) {
      const auto i = static_cast<std::size_t>(layout.body_of(motion.particles[k]));
      std::copy_n(&motion.motion[6 * k], 6, &out.motion[(i * motions + m) * 6]);
      if (motion.particles.size() == 1) ++out.own_motions[i];
    }
  }
}

/// Computes Rᵀ·M·m for every free motion m (a motion that no contact resists). M is the mass matrix. The columns of R
/// are the six rigid motions of each box; a box is a group of neighbouring particles.
void make_weights(LinearSystem& out) {
  const auto motions = static_cast<std::size_t>(out.free);
  out.weight.assign(motions * 6 * out.boxes(), 0);
  for_each_body(out, [&](std::size_t b, std::size_t i) {
    for (std::size_t m = 0; m < motions; ++m) {
      double load[6], sum[6] = {};
      for (std::size_t c = 0; c < 6; ++c) load[c] = out.mass[2 * i + c / 3] * out.motion[(i * motions + m) * 6 + c];
      kernels::add_to_box(out.lever[i], kernels::to_twist(load), sum);
      for (std::size_t c = 0; c < 6; ++c) out.weight[(m * out.boxes() + b) * 6 + c] += sum[c];
    }
  });
}

}  // namespace

LinearSystem make_system(const ContactNetwork& network, const Specimen& specimen, const kernels::Layout& layout,
                         const PairStiffness& typical, const Inertia& inertia, const FreeMotions& free) {
  LinearSystem out;
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    out.typical.k[pair] = typical.k[pair].real();
    out.typical.alpha[pair] = typical.alpha[pair];
  }
  make_rows(network, layout, out);
  make_levers(specimen, layout, out);
  make_motions(layout, inertia, free, out);
  make_weights(out);
  Eigen::MatrixXd k = coarse_stiffness(out);
  // Free motions of the whole specimen have no stiffness among the boxes either, so the coarse matrix would be
  // singular. This loop gives the free motions some stiffness. The added stiffness has no effect on the solution,
  // because the iteration removes the free motions from the preconditioned residual z.
  const double usual = k.trace() / static_cast<double>(k.rows());
  for (int m = 0; m < out.free; ++m) {
    const bool of_all = free.motions[static_cast<std::size_t>(m)].particles.size() == layout.particles();
    const Eigen::VectorXd boxes_move = of_all ? motions_of_boxes(out, m) : weights_of_boxes(out, m);
    if (const double square = boxes_move.squaredNorm(); square > 0)
      k += usual / square * boxes_move * boxes_move.transpose();
  }
  if (!invert_in_parallel(k)) throw NotIterable("harmonic: groups of neighbouring particles can move without force");
  out.coarse.assign(k.data(), k.data() + k.size());
  return out;
}

std::vector<double> invert_particle_blocks(const LinearSystem& system, const kernels::Layout& layout) {
  std::vector<double> out(36 * system.bodies());
  std::int64_t loose = std::numeric_limits<std::int64_t>::max();
#pragma omp parallel for schedule(static) reduction(min : loose)
  for (std::size_t i = 0; i < system.bodies(); ++i) {
    double block[36] = {};
    for (std::size_t at = system.row_begin[i]; at < system.row_begin[i + 1]; ++at) {
      const auto pair = static_cast<std::size_t>(system.ends[at].pair);
      kernels::add_block(system.ends[at], system.typical.k[pair], system.typical.alpha[pair], system.series_of(at),
                         block);
    }
    if (kernels::invert_block(block) > system.own_motions[i]) loose = std::min(loose, static_cast<std::int64_t>(i));
    std::copy(std::begin(block), std::end(block), &out[36 * i]);
  }
  if (loose < std::numeric_limits<std::int64_t>::max()) refuse_loose_particle(loose, layout);
  return out;
}

void refuse_loose_particle(std::int64_t body, const kernels::Layout& layout) {
  throw NotIterable(fmt::format("harmonic: no contact resists some motion of particle {} (singular stiffness matrix)",
                                layout.particle[static_cast<std::size_t>(body)]));
}

}  // namespace macadam::harmonic
