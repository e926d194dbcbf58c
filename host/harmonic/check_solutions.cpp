// SPDX-License-Identifier: GPL-3.0-or-later
// check_solutions.cpp  Every particle adds up the loads of its own contacts, which are computed from the network and
// not from the arrays of the solvers.
#include "host/harmonic/check_solutions.hpp"

#include <algorithm>
#include <cmath>

#include "host/harmonic/iterative/lanes.hpp"
#include "kernels/harmonic/linear_system.hpp"
#include "kernels/harmonic/particle_block.hpp"

namespace macadam::harmonic {
namespace {

using kernels::Placement;
using kernels::Twist;

constexpr std::size_t piece = 64;  ///< particles: large ones, with hundreds of contacts, stand together

/// |Re| + |Im| of each frequency, in both of its lanes.
template <int F>
Lanes<F> size_of(Lanes<F> x) {
  const Lanes<F> positive = x.v < 0 ? -x.v : x.v;
  return positive + positive.swapped();
}

/// Sums over a piece, of each frequency.
struct Sums {
  double residual = 0, beyond = 0;  ///< squares
  Complex inertia = 0;
  ModulusParts parts;

  void add(const Sums& o) {
    residual += o.residual, beyond += o.beyond, inertia += o.inertia;
    for (std::size_t pair = 0; pair < pair_types; ++pair) {
      parts.normal[pair] += o.parts.normal[pair];
      parts.shear[pair] += o.parts.shear[pair];
    }
  }
};

template <int F>
class Check {
  using L = Lanes<F>;

 public:
  Check(const ContactNetwork& network, const Inertia& inertia, const std::vector<const LinearTask*>& tasks,
        double rounding)
      : network_(network), inertia_(inertia), rounding_(rounding) {
    for (std::size_t f = 0; f < F; ++f) {
      const LinearTask& task = *tasks[std::min(f, tasks.size() - 1)];  // the first fill the block
      const int lane = static_cast<int>(f);
      motion_[f] = task.motion.data();
      for (std::size_t pair = 0; pair < pair_types; ++pair) {
        const Complex k = task.stiffness.k[pair];
        k_[pair].set(lane, k);
        stiff_[pair].set(lane, {std::abs(k.real()) + std::abs(k.imag()), std::abs(k.real()) + std::abs(k.imag())});
        alpha_[pair] = L(task.stiffness.alpha[pair]);
      }
      mass_factor_.set(lane, task.inertia);
      if (task.inertia != 0.0) inert_ = false;
      wall_.set(lane, 1.0);
    }
  }

  /// Of each frequency.
  std::array<Sums, F> sums() const {
    const std::size_t particles = inertia_.mass.size();
    std::vector<std::array<Sums, F>> pieces((particles + piece - 1) / piece);
#pragma omp parallel for schedule(dynamic, 1)
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      pieces[k] = sums_of(k * piece, std::min(particles, (k + 1) * piece));
    }
    std::array<Sums, F> out;
    for (const auto& sums : pieces) {
      for (std::size_t f = 0; f < F; ++f) out[f].add(sums[f]);
    }
    return out;
  }

 private:
  struct PairProducts {
    Products<F> normal, shear;
  };
  /// Loads on a particle: their sum, and force and moment by magnitude if nothing cancelled.
  struct Loads {
    Twist<L> sum;
    L force, moment;
  };

  std::array<Sums, F> sums_of(std::size_t begin, std::size_t end) const {
    PairProducts pairs[pair_types];
    Products<F> rest_squared, motion_squared;
    double beyond[F] = {};
    for (std::size_t i = begin; i < end; ++i) {
      const Twist<L> own = motion_of(static_cast<std::int32_t>(i));
      const Loads loads = loads_on(static_cast<std::int32_t>(i), own, pairs);
      L x[6], rest[6];
      kernels::to_array(own, x);
      kernels::to_array(loads.sum, rest);
      for (std::size_t c = 0; c < 6; ++c) {
        if (!inert_) {
          const double mass = inertia_at(inertia_, 6 * i + c);
          rest[c] += mass * mass_factor_(x[c]);
          motion_squared.add(mass * x[c], x[c]);
        }
        rest_squared.add(rest[c], rest[c]);
        if (rounding_ > 0) add_beyond(rest[c], c < 3 ? loads.force : loads.moment, beyond);
      }
    }
    std::array<Sums, F> out;
    for (int f = 0; f < F; ++f) {
      Sums& own = out[static_cast<std::size_t>(f)];
      own.residual = rest_squared.conjugated(f);
      own.beyond = beyond[f];
      own.inertia = motion_squared.plain(f);
      for (std::size_t pair = 0; pair < pair_types; ++pair) {
        own.parts.normal[pair] = pairs[pair].normal.plain(f);
        own.parts.shear[pair] = pairs[pair].shear.plain(f);
      }
    }
    return out;
  }

  void add_beyond(L rest, L largest, double (&beyond)[F]) const {
    for (int f = 0; f < F; ++f) {
      const double excess = std::max(std::abs(rest.at(f)) - rounding_ * largest.at(f).real(), 0.0);
      beyond[f] += excess * excess;
    }
  }

  Twist<L> motion_of(std::int32_t end) const {
    if (end < 0) return {{L(), L(), end == wall_z_hi ? wall_ : L()}, {}};
    L x[6];
    for (int c = 0; c < 6; ++c) {
      for (int f = 0; f < F; ++f) {
        x[c].set(f,
                 motion_[static_cast<std::size_t>(f)][6 * static_cast<std::size_t>(end) + static_cast<std::size_t>(c)]);
      }
    }
    return kernels::to_twist(x);
  }

  /// `pairs`: added to by the contacts whose first end the particle is.
  Loads loads_on(std::int32_t particle, const Twist<L>& own, PairProducts (&pairs)[pair_types]) const {
    Loads out;
    for (const std::uint32_t number : network_.row(static_cast<std::size_t>(particle))) {
      const Contact& c = network_.contacts[number];
      const auto pair = static_cast<std::size_t>(c.pair);
      const bool is_a = c.a == particle;
      const std::int32_t far = is_a ? c.b : c.a;
      const Twist<L> other = motion_of(far);
      const auto wide = [](const Vec3d& v) { return Vec3<L>{L(v.x), L(v.y), L(v.z)}; };
      const Placement<L> frame{wide(c.n), wide(c.s), wide(c.t), L(c.arm_a), L(c.arm_b)};
      const AreaMoments& of = c.moments;
      const double over_d = 1 / c.distance;
      const L m[6] = {L(of.a * over_d),  L(of.s * over_d),  L(of.t * over_d),
                      L(of.ss * over_d), L(of.st * over_d), L(of.tt * over_d)};
      L u[6], density[6];
      kernels::relative_rates(frame, is_a ? own : other, is_a ? other : own, u);
      for (std::size_t k = 0; k < 6; ++k) density[k] = k_[pair](u[k]);
      const kernels::FacetLoad<L> load = kernels::condensed_load(density, alpha_[pair], m);
      const auto at = kernels::to_centres(frame, load);
      if (is_a) {
        out.sum.linear += at.force_a, out.sum.angular += at.moment_a;
        PairProducts& products = pairs[pair];
        products.normal.add(load.n, u[0]), products.normal.add(-load.moment_t, u[1]);
        products.normal.add(load.moment_s, u[2]);
        products.shear.add(load.s, u[3]), products.shear.add(load.t, u[4]), products.shear.add(load.moment_n, u[5]);
      } else {
        out.sum.linear -= at.force_a, out.sum.angular += at.moment_b;
      }
      if (rounding_ > 0) {
        const auto three = [](const Vec3<L>& v) { return size_of(v.x) + size_of(v.y) + size_of(v.z); };
        const double own_arm = std::abs(is_a ? c.arm_a : c.arm_b), far_arm = std::abs(is_a ? c.arm_b : c.arm_a);
        L linear = three(own.linear) + own_arm * three(own.angular), angular = three(own.angular);
        if (far >= 0) {  // what a wall moves by is known without rounding
          linear += three(other.linear) + far_arm * three(other.angular);
          angular += three(other.angular);
        }
        const L force = (of.a * over_d) * stiff_[pair] * linear;
        out.force += force;
        out.moment += ((of.ss + of.tt) * over_d) * stiff_[pair] * angular + own_arm * force;
      }
    }
    return out;
  }

  const ContactNetwork& network_;
  const Inertia& inertia_;
  double rounding_;
  const Complex* motion_[F];
  Factor<F> k_[pair_types], mass_factor_{};
  L stiff_[pair_types], alpha_[pair_types], wall_;  ///< stiff: |Re k| + |Im k|
  bool inert_ = true;
};

template <int F>
void check(const ContactNetwork& network, const Inertia& inertia, const std::vector<const LinearTask*>& tasks,
           double rounding, std::vector<SolutionCheck>& out) {
  const std::array<Sums, F> sums = Check<F>(network, inertia, tasks, rounding).sums();
  for (std::size_t f = 0; f < tasks.size(); ++f) {
    const double residual = std::sqrt(sums[f].residual);
    out.push_back({residual, rounding > 0 ? std::sqrt(sums[f].beyond) : residual, sums[f].inertia, sums[f].parts});
  }
}

}  // namespace

std::vector<SolutionCheck> check_solutions(const ContactNetwork& network, const Inertia& inertia,
                                           const std::vector<const LinearTask*>& tasks, double rounding) {
  constexpr std::size_t most = kernels::most_loads;
  std::vector<SolutionCheck> out;
  for (std::size_t first = 0; first < tasks.size(); first += most) {
    const auto begin = tasks.begin() + static_cast<std::ptrdiff_t>(first);
    const std::vector<const LinearTask*> some(
        begin, begin + static_cast<std::ptrdiff_t>(std::min(most, tasks.size() - first)));
    if (some.size() == 1)
      check<1>(network, inertia, some, rounding, out);
    else
      check<kernels::most_loads>(network, inertia, some, rounding, out);
  }
  return out;
}

}  // namespace macadam::harmonic
