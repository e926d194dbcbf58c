// SPDX-License-Identifier: GPL-3.0-or-later
// block_cocg.cpp  Implements COCG, the conjugate-gradient method with products xᵀ·y without conjugates, for complex
// symmetric matrices. The preconditioned residual z is the sum of a fine level (the inverse stiffness block of each
// particle times its residual) and a coarse level (rigid motions of boxes of particles). One iteration has three sweeps
// over the particles. The first computes q = K·p. The second updates x, r and the fine level of z. The third adds the
// coarse level to z and then computes p. Sums over all particles are computed as partial sums over a fixed number of
// particles, which are then added in order. So they do not depend on the number of threads.
#include "host/harmonic/iterative/block_cocg.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/harmonic/iterative/apply_row.hpp"
#include "kernels/harmonic/particle_block.hpp"

namespace macadam::harmonic {
namespace {

constexpr std::size_t chunk = 128;  ///< number of particles per partial sum

/// The iteration for F tasks side by side.
template <int F>
class BlockCocg {
  using L = Lanes<F>;

 public:
  BlockCocg(const kernels::LinearSystem& system, const std::vector<double>& inverse, const kernels::Layout& layout,
            const std::vector<LinearTask*>& tasks)
      : system_(system),
        inverse_(inverse),
        layout_(layout),
        tasks_(tasks),
        n_(system.bodies()),
        free_(static_cast<std::size_t>(system.free)) {
    for (int f = 0; f < F; ++f) {
      const LinearTask& task = *tasks[static_cast<std::size_t>(f)];
      for (std::size_t pair = 0; pair < pair_types; ++pair) {
        const Complex k = task.stiffness.k[pair];
        stiffness_.k[pair].set(f, k);
        if (k != 0.0) stiffness_.compliance[pair].set(f, 1.0 / k);
        stiffness_.alpha[pair] = task.stiffness.alpha[pair];
      }
      stiffness_.inertia.set(f, task.inertia);
      if (task.inertia != 0.0) stiffness_.inert = false;
    }
    for (auto* v : {&x_, &r_, &p_, &q_, &z_}) v->resize(6 * n_);
    partial_.resize((n_ + chunk - 1) / chunk);
    load_.resize(6 * system.boxes());
    coarse_.resize(6 * system.boxes());
  }

  void solve(const std::function<bool()>& stop) {
    load_tasks();
    for (int f = 0; f < F; ++f) { scale_[f] = length(tasks_[static_cast<std::size_t>(f)]->right); }
    Sums sums = start();
    double best = infinity;
    for (int k = 0, best_at = 0;; ++k) {
      L drop[kernels::most_free_motions];
      precondition(sums, drop);
      Factor<F> beta;
      const double worst = judge(k, sums, beta);  // the largest relative residual of the tasks that are not done
      if (worst < 0.9 * best) best = worst, best_at = k;
      if (worst == 0 || k >= kernels::most_iterations || k - best_at > kernels::most_stagnant) break;
      require_not_stopped(stop);
      turn(beta, drop);
      const Products<F> pq = apply();
      Factor<F> alpha;
      for (int f = 0; f < F; ++f) {
        const Complex product = pq.plain(f);
        alpha.set(f, done_[f] || product == 0.0 ? Complex(0) : rho_[f] / product);
      }
      sums = advance(alpha);
    }
    renew_energy();
    store_tasks();
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  /// Sums over particles: rᵀ·z, rᵀ·r, and the mass-weighted products of z with the free motions, which will be removed
  /// from z (`drop`).
  struct Sums {
    Products<F> rz, rr;
    L drop[kernels::most_free_motions];
    void add(const Sums& o) {
      rz.add(o.rz), rr.add(o.rr);
      for (std::size_t m = 0; m < kernels::most_free_motions; ++m) drop[m] += o.drop[m];
    }
  };

  /// Calls work(body, sums), which adds the terms of one body to `sums`, for all bodies in parallel. Returns the sums
  /// over all bodies.
  template <class Work>
  Sums sum(Work&& work) {
#pragma omp parallel for schedule(static)
    for (std::size_t block = 0; block < partial_.size(); ++block) {
      Sums own;
      for (std::size_t i = block * chunk; i < std::min(n_, (block + 1) * chunk); ++i) work(i, own);
      partial_[block] = own;
    }
    Sums out;
    for (const Sums& s : partial_) out.add(s);
    return out;
  }

  /// Sets `out` to the values `of(task, number)`, for every task and every component `number` of the task's vector.
  template <class Of>
  void load(LaneVector<F>& out, Of&& of) const {
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < n_; ++i) {
      const std::size_t from = 6 * static_cast<std::size_t>(layout_.particle[i]);
      for (std::size_t c = 0; c < 6; ++c) {
        for (int f = 0; f < F; ++f) out[6 * i + c].set(f, of(*tasks_[static_cast<std::size_t>(f)], from + c));
      }
    }
  }
  /// Sets r to the loads f.
  void load_right() {
    load(r_, [](const LinearTask&, std::size_t) { return Complex(0); });
    for (int f = 0; f < F; ++f) {
      for (const ParticleLoad& on : tasks_[static_cast<std::size_t>(f)]->right) {
        const std::size_t at = 6 * static_cast<std::size_t>(layout_.body_of(on.particle));
        for (std::size_t c = 0; c < 6; ++c) r_[at + c].set(f, on.load[c]);
      }
    }
  }
  /// Sets r to the loads and x to the starts of the tasks.
  void load_tasks() {
    load_right();
    load(x_, [](const LinearTask& task, std::size_t i) { return task.motion.empty() ? Complex(0) : task.motion[i]; });
  }
  /// Writes the solutions into the tasks.
  void store_tasks() {
    for (LinearTask* task : tasks_) task->motion.resize(6 * n_);
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < n_; ++i) {
      const std::size_t to = 6 * static_cast<std::size_t>(layout_.particle[i]);
      for (std::size_t c = 0; c < 6; ++c) {
        for (int f = 0; f < F; ++f) tasks_[static_cast<std::size_t>(f)]->motion[to + c] = x_[6 * i + c].at(f);
      }
    }
  }

  /// Updates the state of each task and computes β = rᵀz / (rᵀz of the previous iteration). For tasks that are done β
  /// is 0, and their solutions no longer change. Returns the largest relative residual of the tasks that are not done,
  /// or 0 if all are done.
  double judge(int k, const Sums& sums, Factor<F>& beta) {
    double worst = 0;
    for (int f = 0; f < F; ++f) {
      LinearTask& task = *tasks_[static_cast<std::size_t>(f)];
      if (!done_[f]) {
        const double residual = std::sqrt(sums.rr.conjugated(f)) / scale_[f];
        task.energy = energy_of(sums, f);
        done_[f] = residual <= task.tolerance && task.energy <= task.energy_limit;
        task.converged = done_[f];
        task.iterations += k > 0;
        if (!std::isfinite(residual)) done_[f] = true;  // this task cannot converge any more, but the other tasks can
        if (!done_[f]) worst = std::max(worst, residual);
      }
      const Complex rho = done_[f] ? Complex(0) : sums.rz.plain(f) + coarse_product_.plain(f);
      beta.set(f, done_[f] || k == 0 || rho_[f] == 0.0 ? Complex(0) : rho / rho_[f]);
      rho_[f] = rho;
    }
    return worst;
  }

  /// Returns rᴴ·P⁻¹·r of a task, not below 0.
  double energy_of(const Sums& sums, int f) const {
    return std::max(sums.rz.conjugated(f) + coarse_product_.conjugated(f), 0.0);
  }
  /// Computes rᴴ·P⁻¹·r of every task from the true residual r = f − K·x, because the r that the iteration updates has
  /// accumulated rounding errors.
  void renew_energy() {
    load_right();
    const Sums sums = start();
    L drop[kernels::most_free_motions];
    precondition(sums, drop);
    for (int f = 0; f < F; ++f) tasks_[static_cast<std::size_t>(f)]->energy = energy_of(sums, f);
  }

  /// Computes r = f − K·x (r must hold f on entry) and the fine level of z. Returns rᵀ·z, rᵀ·r and the products with
  /// the free motions.
  Sums start() {
    find_pressures(x_);
    return sum([&](std::size_t i, Sums& own) {
      L kx[6];
      apply_row<F>(system_, stiffness_, i, x_, pressures_, kx);
      for (std::size_t c = 0; c < 6; ++c) r_[6 * i + c] -= kx[c];
      fine(i, own);
    });
  }

  /// Computes z = K_ii⁻¹·r of one body (the fine level), and adds the terms of this body to the sums `own`.
  void fine(std::size_t i, Sums& own) {
    const double* inverse = &inverse_[36 * i];
    const L* r = &r_[6 * i];
    L* z = &z_[6 * i];
    for (std::size_t a = 0; a < 6; ++a) {
      L sum;
      for (std::size_t b = 0; b < 6; ++b) sum += inverse[6 * a + b] * r[b];
      z[a] = sum;
      own.rz.add(r[a], sum);
      own.rr.add(r[a], r[a]);
      for (std::size_t m = 0; m < free_; ++m) {
        own.drop[m] += (system_.mass[2 * i + a / 3] * system_.motion[(i * free_ + m) * 6 + a]) * sum;
      }
    }
  }

  /// Computes the coarse level, coarse = (RᵀKR)⁻¹·Rᵀ·r. Stores in `drop` the mass-weighted products of the complete z,
  /// with both levels, with the free motions.
  void precondition(const Sums& sums, L (&drop)[kernels::most_free_motions]) {
    const std::size_t boxes = system_.boxes();
#pragma omp parallel for schedule(static)
    for (std::size_t b = 0; b < boxes; ++b) {
      L own[6];
      for_each_body(b,
                    [&](std::size_t i) { kernels::add_to_box(system_.lever[i], kernels::to_twist(&r_[6 * i]), own); });
      for (std::size_t c = 0; c < 6; ++c) load_[6 * b + c] = own[c];
    }
#pragma omp parallel for schedule(static)
    for (std::size_t a = 0; a < 6 * boxes; ++a) {
      L sum;
      const double* row = system_.coarse.data() + a * 6 * boxes;
      for (std::size_t b = 0; b < 6 * boxes; ++b) sum += row[b] * load_[b];
      coarse_[a] = sum;
    }
    coarse_product_ = {};
    for (std::size_t a = 0; a < 6 * boxes; ++a) coarse_product_.add(load_[a], coarse_[a]);
    for (std::size_t m = 0; m < free_; ++m) {
      drop[m] = sums.drop[m];
      for (std::size_t a = 0; a < 6 * boxes; ++a) drop[m] += system_.weight[m * 6 * boxes + a] * coarse_[a];
    }
  }

  template <class Work>
  void for_each_body(std::size_t box, Work&& work) const {
    const auto end = static_cast<std::size_t>(system_.box_body[box + 1]);
    for (auto i = static_cast<std::size_t>(system_.box_body[box]); i < end; ++i) work(i);
  }

  /// Computes p = z + β·p, after adding the coarse level to z and removing the free motions from it.
  void turn(const Factor<F>& beta, const L (&drop)[kernels::most_free_motions]) {
#pragma omp parallel for schedule(static)
    for (std::size_t b = 0; b < system_.boxes(); ++b) {
      L y[6];
      for (std::size_t c = 0; c < 6; ++c) y[c] = coarse_[6 * b + c];
      for_each_body(b, [&](std::size_t i) {
        L add[6];
        kernels::to_array(kernels::moved_with_box(system_.lever[i], y), add);
        for (std::size_t c = 0; c < 6; ++c) {
          L z = z_[6 * i + c] + add[c];
          for (std::size_t m = 0; m < free_; ++m) z -= system_.motion[(i * free_ + m) * 6 + c] * drop[m];
          p_[6 * i + c] = z + beta(p_[6 * i + c]);
        }
      });
    }
  }

  /// Computes the pressures of all cells under the motion `of`, if the system has cells.
  void find_pressures(const LaneVector<F>& of) {
    pressures_.resize(system_.cells.size());
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < pressures_.size(); ++i) pressures_[i] = pressure_of<F>(system_, stiffness_, i, of);
  }

  /// Computes q = K·p and returns pᵀ·q.
  Products<F> apply() {
    find_pressures(p_);
    return sum([&](std::size_t i, Sums& own) {
             L q[6];
             apply_row<F>(system_, stiffness_, i, p_, pressures_, q);
             for (std::size_t c = 0; c < 6; ++c) {
               q_[6 * i + c] = q[c];
               own.rz.add(p_[6 * i + c], q[c]);
             }
           })
        .rz;
  }

  /// Computes x += α·p, r −= α·q and the fine level of z. Returns rᵀ·z, rᵀ·r and the products with the free motions.
  Sums advance(const Factor<F>& alpha) {
    return sum([&](std::size_t i, Sums& own) {
      for (std::size_t c = 0; c < 6; ++c) {
        x_[6 * i + c] += alpha(p_[6 * i + c]);
        r_[6 * i + c] -= alpha(q_[6 * i + c]);
      }
      fine(i, own);
    });
  }

  const kernels::LinearSystem& system_;
  const std::vector<double>& inverse_;
  const kernels::Layout& layout_;
  const std::vector<LinearTask*>& tasks_;
  std::size_t n_, free_;
  BlockStiffness<F> stiffness_;
  LaneVector<F> x_, r_, p_, q_, z_, load_, coarse_, pressures_;
  Products<F> coarse_product_;
  Complex rho_[F] = {};
  bool done_[F] = {};
  double scale_[F];
  std::vector<Sums, kernels::AlignedAllocator<Sums>> partial_;
};

}  // namespace

void solve_block(const kernels::LinearSystem& system, const std::vector<double>& inverse, const kernels::Layout& layout,
                 std::vector<LinearTask*> tasks, const std::function<bool()>& stop) {
  for (LinearTask* task : tasks) task->converged = false;
  if (tasks.size() == 1) {
    BlockCocg<1>(system, inverse, layout, tasks).solve(stop);
    return;
  }
  // This task fills the lanes that have no task. With its infinite tolerance it is done before the first iteration.
  LinearTask spare = *tasks.front();
  spare.tolerance = std::numeric_limits<double>::infinity();
  while (tasks.size() < static_cast<std::size_t>(kernels::most_loads)) tasks.push_back(&spare);
  BlockCocg<kernels::most_loads>(system, inverse, layout, tasks).solve(stop);
}

}  // namespace macadam::harmonic
