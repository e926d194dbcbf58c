// SPDX-License-Identifier: GPL-3.0-or-later
// check_solutions.cpp  Computes the residual of each particle as the sum of the loads of its contacts. The loads are
// computed from the network and not from the arrays of the solvers, so that the check is independent of the solvers.
// SIMD lanes hold one contact of four solutions, or four contacts of one solution.
#include "host/harmonic/check_solutions.hpp"

#include <algorithm>
#include <cmath>

#include "host/harmonic/cell_pressure.hpp"
#include "host/harmonic/group_lanes.hpp"
#include "host/harmonic/solution_sums.hpp"
#include "kernels/harmonic/particle_block.hpp"

namespace macadam::harmonic {
namespace {

using L = FourNumbers;
using kernels::Twist;

/// Returns the number of particles in a piece, the unit of work of a thread. Pieces are small, so that no thread waits
/// long for another thread at the end. (Large particles have hundreds of contacts and consecutive numbers, so a single
/// piece may hold many of these particles.) Pieces are not smaller, because adding the sums of very many pieces would
/// take time.
std::size_t piece_of(std::size_t particles) { return std::max<std::size_t>(64, particles / 4096); }

/// Checks up to four solutions. If `single`, it checks one solution and processes four of its contacts at a time.
template <bool single>
class Check {
 public:
  Check(const ContactNetwork& network, const Inertia& inertia, const std::vector<const LinearTask*>& tasks,
        double rounding)
      : network_(network), inertia_(inertia), rounding_(rounding), last_(tasks.size() - 1) {
    for (int f = 0; f < at_once; ++f) {  // with fewer than four tasks, the last task also fills the remaining lanes
      const LinearTask& task = *tasks[std::min(static_cast<std::size_t>(f), tasks.size() - 1)];
      motion_[f] = task.motion.data();
      wall_[f] = &task.wall;
      if (!network.cells.empty() && (f == 0 || static_cast<std::size_t>(f) < tasks.size()))
        pressures_[f] = cell_pressures(network, task.stiffness, task.motion, task.wall);
      for (std::size_t pair = 0; pair < pair_types; ++pair) {
        k_[pair].set(f, task.stiffness.k[pair]);
        alpha_[pair] = task.stiffness.alpha[pair];
      }
      mass_factor_.set(f, task.inertia);
      if (task.inertia != 0.0) inert_ = false;
    }
  }

  /// Returns, for each solution, the sums over all particles: squares of the residual, uᵀ·M·u, and the contributions of
  /// the pair types to E*.
  AllSums sums() const {
    const std::size_t particles = inertia_.mass.size();
    const std::size_t piece = piece_of(particles);
    std::vector<AllSums> pieces((particles + piece - 1) / piece);
#pragma omp parallel for schedule(dynamic, 1)
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      pieces[k] = sums_of(k * piece, std::min(particles, (k + 1) * piece));
    }
    AllSums out;
    for (const AllSums& sums : pieces) {
      for (std::size_t f = 0; f < at_once; ++f) out[f].add(sums[f]);
    }
    return out;
  }

 private:
  /// The load on a particle from all its contacts (`sum`), and the force and moment that result if the magnitudes of
  /// all terms are added.
  struct Total {
    Twist<L> sum;
    L force, moment;
  };
  static constexpr int step = single ? at_once : 1;  ///< number of contacts per group
  using Group = ContactGroup<step>;

  /// Returns, for each solution, the sums over particles begin … end − 1.
  AllSums sums_of(std::size_t begin, std::size_t end) const {
    AllSums out;
    PairProducts pairs[pair_types];
    Products<at_once> rest_squared, motion_squared;
    for (std::size_t i = begin; i < end; ++i) {
      const Twist<L> own = motion_of([this, i](int f) { return of_particle(f, static_cast<std::int32_t>(i)); });
      const Total total = loads_on(i, own, pairs);
      L x[6], rest[6];
      kernels::to_array(own, x);
      kernels::to_array(total.sum, rest);
      for (std::size_t c = 0; c < 6; ++c) {
        if (!inert_) {
          const double mass = inertia_at(inertia_, 6 * i + c);
          rest[c] += mass * mass_factor_(x[c]);
          motion_squared.add(mass * x[c], x[c]);
        }
        rest_squared.add(rest[c], rest[c]);
        if (rounding_ > 0) add_beyond(rest[c], c < 3 ? total.force : total.moment, out);
      }
    }
    for (int f = 0; f < at_once; ++f) {
      SolutionSums& own = out[static_cast<std::size_t>(f)];
      own.residual = rest_squared.conjugated(f);
      own.inertia = motion_squared.plain(f);
    }
    for (std::size_t pair = 0; pair < pair_types; ++pair) {
      for (int f = 0; f < at_once; ++f) {
        ModulusParts& parts = out[single ? 0 : static_cast<std::size_t>(f)].parts;
        parts.normal[pair] += pairs[pair].normal.plain(f);
        parts.shear[pair] += pairs[pair].shear.plain(f);
        parts.normal_rock[pair] += pairs[pair].normal_rock.plain(f);
        parts.shear_rock[pair] += pairs[pair].shear_rock.plain(f);
      }
    }
    return out;
  }

  /// Adds, for one particle, the squares of the parts of its residuals that exceed rounding. `rest` holds the
  /// residuals, one per solution. `largest` is the load that results if the magnitudes of all terms are added.
  void add_beyond(L rest, L largest, AllSums& sums) const {
    for (int f = 0; f < at_once; ++f) {
      const double excess = std::max(std::abs(rest.at(f)) - rounding_ * largest.at(f).real(), 0.0);
      sums[static_cast<std::size_t>(f)].beyond += excess * excess;
    }
  }

  /// Returns the six numbers of a particle's motion in the solution of lane f.
  const Complex* of_particle(int f, std::int32_t particle) const {
    return motion_[single ? 0 : f] + 6 * static_cast<std::size_t>(particle);
  }

  /// Returns the motion whose six numbers `numbers(f)` are those of lane f.
  template <class Numbers>
  static Twist<L> motion_of(Numbers&& numbers) {
    const Complex* motion[at_once];
    for (int f = 0; f < at_once; ++f) motion[f] = numbers(f);
    L x[6];
    for (int c = 0; c < 6; ++c) x[c] = complex_lanes([&](int f) { return motion[f][c]; });
    return kernels::to_twist(x);
  }

  /// Returns the motions of the far ends of a group's contacts, which are particles or walls.
  Twist<L> motion_of_far_ends(const Group& g) const {
    Complex of_wall[at_once][6] = {};
    return motion_of([&](int f) -> const Complex* {
      const int contact = single ? f : 0;
      if (g.far[contact] >= 0) return of_particle(f, g.far[contact]);
      const WallMotion::Rigid moved = wall_[single ? 0 : f]->at(*g.contact[contact]);
      of_wall[f][0] = moved.displacement.x, of_wall[f][1] = moved.displacement.y, of_wall[f][2] = moved.displacement.z;
      of_wall[f][3] = moved.rotation.x, of_wall[f][4] = moved.rotation.y, of_wall[f][5] = moved.rotation.z;
      return of_wall[f];
    });
  }

  /// Returns the loads of all contacts of a particle, and adds the products of load and relative displacement to
  /// `pairs`.
  Total loads_on(std::size_t particle, const Twist<L>& own, PairProducts (&pairs)[pair_types]) const {
    Total out;
    const std::size_t end = network_.row_begin[particle + 1];
    for (std::size_t at = network_.row_begin[particle]; at < end; at += step) {
      add_loads(Group(network_, at, end, particle), own, out, pairs);
    }
    if (single) {
      for (L* x : {&out.sum.linear.x, &out.sum.linear.y, &out.sum.linear.z, &out.sum.angular.x, &out.sum.angular.y,
                   &out.sum.angular.z, &out.force, &out.moment}) {
        *x = in_first(*x);
      }
    }
    return out;
  }

  /// Returns the sum over all lanes, in the first lane.
  static L in_first(L x) {
    Complex sum = 0;
    for (int f = 0; f < at_once; ++f) sum += x.at(f);
    L out;
    out.set(0, sum);
    return out;
  }

  /// Adds the loads of a group of contacts to `out`, and their products with the relative displacements to `pairs`.
  /// `own` is the motion of the particle.
  void add_loads(const Group& g, const Twist<L>& own, Total& out, PairProducts (&pairs)[pair_types]) const {
    const Twist<L> other = motion_of_far_ends(g);
    const kernels::Placement<L> frame = frame_of(g);
    L m[6];
    moments_over_length(g, m);
    const Factor<at_once> k = single ? stiffness_of(g) : k_[g.pair[0]];
    const L alpha = of_contact<step>([&](int f) { return alpha_[g.pair[f]]; });
    Factor<at_once> normal = k, shear = k;
    const L series = g.in_series ? of_contact<step>([&](int f) { return g.contact[f]->series; }) : L();
    if (g.in_series) normal = in_series(k, series), shear = in_series(k, alpha * series);
    L u[6], density[6];
    kernels::relative_rates(frame, own, other, u);
    L acting[6];
    std::copy(std::begin(u), std::end(u), acting);
    if (!network_.cells.empty()) add_pressure(g, acting);
    for (std::size_t c = 0; c < 6; ++c) density[c] = c < 3 ? normal(acting[c]) : shear(acting[c]);
    const kernels::FacetLoad<L> load = kernels::condensed_load(density, alpha, m);
    const auto on = kernels::to_centres(frame, load);
    out.sum.linear += on.force_a, out.sum.angular += on.moment_a;
    const auto add_products = [&](std::size_t pair, L of_share) {
      pairs[pair].add(load, u, of_share);
      if (!g.in_series) return;
      const L in_shear = alpha * series;
      pairs[pair].add_rock(load, u, of_share, {series * normal.real, series * normal.imaginary},
                           {in_shear * shear.real, in_shear * shear.imaginary});
    };
    if (g.alike) {
      add_products(g.pair[0], of_contact<step>([&](int f) { return share(g.far[f]); }));
    } else {
      for (int i = 0; i < g.count; ++i)
        add_products(g.pair[i], of_contact<step>([&](int f) { return f == i ? share(g.far[f]) : 0.0; }));
    }
    if (rounding_ > 0) {
      const LoadSizes largest = largest_load(g, normal, own, other);
      out.force += largest.force, out.moment += largest.moment;
    }
  }

  /// Adds to the relative displacements of a group the additional displacements that the pressures of cells cause.
  void add_pressure(const Group& g, L (&u)[6]) const {
    std::array<Complex, 3> shift[at_once];
    for (int f = 0; f < at_once; ++f) {
      const std::size_t of = single ? 0 : std::min(static_cast<std::size_t>(f), last_);
      const int contact = single ? f : 0;
      shift[f] = pressure_shift(*g.contact[contact], pressures_[of]);
      // seen from the second end, n and t are reversed, and so is the sign of the relative displacement
      if (g.sign[contact] < 0) shift[f][1] = -shift[f][1];
    }
    u[0] += complex_lanes([&](int f) { return shift[f][0]; });
    u[3] += complex_lanes([&](int f) { return shift[f][1]; });
    u[4] += complex_lanes([&](int f) { return shift[f][2]; });
  }

  /// Returns the fraction of a contact's product that is added when the contact is visited from one particle: 1/2 for a
  /// contact between two particles, because the contact is visited from both particles; 1 for a wall contact.
  static double share(std::int32_t far) { return far < 0 ? 1 : 0.5; }

  /// Returns the stiffness of each contact of a group; lanes without a contact get 0.
  Factor<at_once> stiffness_of(const Group& g) const {
    if (g.alike && g.count == at_once) return k_[g.pair[0]];
    Factor<at_once> k{};
    for (int f = 0; f < g.count; ++f)
      k.set(f, k_[g.pair[f]].real.v[0] + Complex(0, k_[g.pair[f]].imaginary.v[at_once]));
    return k;
  }

  const ContactNetwork& network_;
  const Inertia& inertia_;
  double rounding_;
  const Complex* motion_[at_once];
  const WallMotion* wall_[at_once];
  std::array<Vector, at_once> pressures_;  ///< of cells, for each solution; empty without cells that resist
  std::size_t last_ = 0;                   ///< index of the last solution
  Factor<at_once> k_[pair_types], mass_factor_{};
  double alpha_[pair_types];
  bool inert_ = true;  ///< whether no solution has inertia
};

template <bool single>
void check(const ContactNetwork& network, const Inertia& inertia, const std::vector<const LinearTask*>& tasks,
           double rounding, std::vector<SolutionCheck>& out) {
  const AllSums sums = Check<single>(network, inertia, tasks, rounding).sums();
  for (std::size_t f = 0; f < tasks.size(); ++f) {
    const double residual = std::sqrt(sums[f].residual);
    out.push_back({residual, rounding > 0 ? std::sqrt(sums[f].beyond) : residual, sums[f].inertia, sums[f].parts});
  }
}

}  // namespace

std::vector<SolutionCheck> check_solutions(const ContactNetwork& network, const Inertia& inertia,
                                           const std::vector<const LinearTask*>& tasks, double rounding) {
  constexpr std::size_t most = at_once;
  std::vector<SolutionCheck> out;
  for (std::size_t first = 0; first < tasks.size(); first += most) {
    const auto begin = tasks.begin() + static_cast<std::ptrdiff_t>(first);
    const std::vector<const LinearTask*> some(
        begin, begin + static_cast<std::ptrdiff_t>(std::min(most, tasks.size() - first)));
    if (some.size() == 1)
      check<true>(network, inertia, some, rounding, out);
    else
      check<false>(network, inertia, some, rounding, out);
  }
  return out;
}

}  // namespace macadam::harmonic
