// SPDX-License-Identifier: GPL-3.0-or-later
// device_solver.cu  Solves linear systems of the frequency domain on devices: uploads a system, and enqueues the
// iterations (cocg_view.hpp lists their kernels).
#include <limits>

#include "kernels/cuda/device/multiprocessor_lease.hpp"
#include "kernels/cuda/harmonic/cocg_apply.hpp"
#include "kernels/cuda/harmonic/cocg_memory.hpp"
#include "kernels/cuda/harmonic/cocg_setup.hpp"
#include "kernels/cuda/harmonic/cocg_vectors.hpp"
#include "kernels/cuda/multi_gpu/pinned_copies.hpp"

namespace macadam::kernels {
namespace {

using Complex = std::complex<double>;

/// The vectors of an iteration of F loads, and some iterations recorded as a graph.
template <int F>
struct Vectors : VectorMemory<F> {
  using VectorMemory<F>::VectorMemory;
  cudaGraphExec_t batch = nullptr;

  Vectors(const Vectors&) = delete;
  ~Vectors() {
    if (batch) cudaGraphExecDestroy(batch);
  }
};

/// The solver on the devices of a team; solves one load, or up to four side by side.
class Solver : public DeviceSolver {
 public:
  Solver(const LinearSystem& system, const DeviceList& devices, std::int64_t& singular_body)
      : devices_(devices), team_(devices, nullptr, KernelOrder::first), system_(system, team_) {
    singular_body = invert(system);
  }

  std::vector<LinearState> solve(const std::vector<LinearLoad>& loads, const std::function<void()>& look) override {
    team_.use(0);
    last_single_ = loads.size() == 1;
    return last_single_ ? solve_with(one_, loads, look) : solve_with(four_, loads, look);
  }

  void solution(std::size_t load, const TakePart& take) override {
    team_.use(0);
    if (last_single_)
      fetch(*one_, load, take);
    else
      fetch(*four_, load, take);
  }

 private:
  /// Inverts the diagonal blocks of all bodies. Returns the first body that has more free motions of its own than the
  /// system says, or −1.
  std::int64_t invert(const LinearSystem& system) {
    constexpr unsigned long long none = std::numeric_limits<unsigned long long>::max();
    DeviceArray<unsigned long long> singular_body(1);
    singular_body.upload(&none);
    DeviceArray<std::uint8_t> own_motions(system.own_motions.size());
    own_motions.upload(system.own_motions.data());
    launch("particle blocks", invert_blocks, (system_.bodies + short_kernel_threads - 1) / short_kernel_threads,
           short_kernel_threads, 0, team_.stream(), system_.bodies, system_.row_begin.data(), system_.ends.data(),
           system_.series.size() > 0 ? system_.series.data() : nullptr, system.typical, own_motions.data(),
           system_.inverse.data(), singular_body.data());
    team_.wait("particle blocks");
    const unsigned long long found = singular_body.download().front();
    return found == none ? -1 : static_cast<std::int64_t>(found);
  }

  /// Returns the scalars with which the iteration of some loads begins.
  template <int F>
  static CocgScalars<F> scalars_of(const std::vector<LinearLoad>& loads) {
    CocgScalars<F> out{};
    out.inert = out.running = true;
    out.best = std::numeric_limits<double>::infinity();
    out.most_iterations = most_iterations;
    for (std::size_t f = 0; f < F; ++f) {
      out.done[f] = f >= loads.size();
      if (out.done[f]) continue;
      const LinearLoad& load = loads[f];
      for (std::size_t pair = 0; pair < pair_types; ++pair) {
        out.k[pair][f] = {load.k[pair].real(), load.k[pair].imag()};
        out.alpha[pair] = load.alpha[pair];
      }
      out.inertia[f] = {load.inertia.real(), load.inertia.imag()};
      if (load.inertia != 0.0) out.inert = false;
      out.scale[f] = load.scale;
      out.tolerance[f] = load.tolerance;
      out.energy_limit[f] = load.energy_limit;
    }
    return out;
  }

  template <int F>
  std::vector<LinearState> solve_with(std::unique_ptr<Vectors<F>>& own, const std::vector<LinearLoad>& loads,
                                      const std::function<void()>& look) {
    if (!own) own = std::make_unique<Vectors<F>>(system_, team_);
    Vectors<F>& v = *own;
    v.x.clear();
    for (std::size_t f = 0; f < loads.size(); ++f) {
      if (!loads[f].start) continue;
      DeviceArray<double2> staged(6 * system_.bodies);
      staged.upload(reinterpret_cast<const double2*>(loads[f].start));
      over_numbers("starts", to_lanes<F>, 6 * system_.bodies, staged.data(), system_.particle.data(), v.x.data(),
                   6 * system_.bodies, int(f));
    }
    std::vector<DeviceArray<BodyLoad>> right;
    for (const LinearLoad& load : loads) right.push_back(DeviceArray<BodyLoad>::of(load.right));
    const auto start_from_right_sides = [&](const CocgScalars<F>& start) {
      for (auto& member : v.members) member.scalars.upload(&start);
      v.p.clear();
      v.r.clear();
      for (std::size_t f = 0; f < loads.size(); ++f) {
        over_numbers("loads", set_loads<F>, 6 * right[f].size(), right[f].data(), right[f].size(), v.r.data(), int(f));
      }
    };
    CocgScalars<F> start = scalars_of<F>(loads);
    start_from_right_sides(start);
    CocgScalars<F> end, judged;
    {
      const MultiprocessorLease::ForSolution lease(devices_, team_.behind());
      end = iterate(v, look);
      start.most_iterations = 0;  // compute only the residual
      start_from_right_sides(start);
      judged = judge(v);
    }
    std::vector<LinearState> out;
    for (std::size_t f = 0; f < loads.size(); ++f) {
      out.push_back(end.state[f]);
      out.back().energy = judged.state[f].energy;
    }
    return out;
  }

  /// Passes the solution of a load to `take`.
  template <int F>
  void fetch(const Vectors<F>& v, std::size_t load, const TakePart& take) {
    DeviceArray<double2> staged(6 * system_.bodies);
    over_numbers("solutions", from_lanes<F>, 6 * system_.bodies, v.x.data(), system_.particle.data(), staged.data(),
                 6 * system_.bodies, int(load));
    const auto* from = reinterpret_cast<const Complex*>(staged.data());
    if (staged.bytes() < worth_pinning) {
      usual_.resize(staged.size());
      copy_now(usual_.data(), from, staged.bytes(), "solutions");
      take(0, usual_.data(), usual_.size());
      return;
    }
    if (!parts_) parts_ = std::make_unique<PinnedParts<Complex>>(team_);
    parts_->copy(from, staged.size(), take);
  }

  /// Launches a kernel with one thread for each of `count` items, on the first device, and waits for it.
  template <class Kernel, class... Arguments>
  void over_numbers(const char* name, Kernel kernel, std::size_t count, Arguments... arguments) {
    if (count == 0) return;
    launch(name, kernel, (count + cocg_threads - 1) / cocg_threads, cocg_threads, 0, team_.stream(), arguments...);
    team_.wait(name);
  }

  /// Launches a kernel over all segments; each member of the team takes its own.
  template <int F, class Kernel, class... Arguments>
  void over_segments(const Vectors<F>& v, const char* name, Kernel kernel, Arguments... arguments) {
    team_.each([&](std::size_t m) {
      const std::size_t first = system_.first_segment[m], blocks = system_.first_segment[m + 1] - first;
      if (blocks == 0) return;
      launch(name, kernel, blocks, cocg_threads, 0, team_.stream(m), v.view(system_, m), static_cast<unsigned>(first),
             arguments...);
    });
  }
  /// Launches a kernel on every member; all members compute the same numbers.
  template <int F, class Kernel, class... Arguments>
  void by_each(const Vectors<F>& v, const char* name, Kernel kernel, unsigned blocks, Arguments... arguments) {
    team_.each([&](std::size_t m) {
      launch(name, kernel, blocks, cocg_threads, 0, team_.stream(m), v.view(system_, m), arguments...);
    });
  }

  /// Runs the kernels apply, step, advance and coarse, which compute r −= α·K·`from` and all sums of the iteration.
  /// `first`: α = 1.
  template <int F>
  void improve(const Vectors<F>& v, const double* from, bool first) {
    if (system_.series.size() > 0)
      over_segments(v, "apply", cocg_apply<F, true>, from);
    else
      over_segments(v, "apply", cocg_apply<F, false>, from);
    team_.join_streams();
    by_each(v, "step", cocg_step<F>, 1u, first);
    over_segments(v, "advance", cocg_advance<F>);
    team_.join_streams();
    by_each(v, "coarse", cocg_coarse<F>, row_blocks(system_.boxes) + 1);
  }

  /// Computes r = f − K·x. x does not change, because p = 0.
  template <int F>
  void begin(const Vectors<F>& v) {
    team_.join_streams();
    improve(v, v.x.data(), true);
  }

  /// Computes residual and energy of the loads without an iteration.
  template <int F>
  CocgScalars<F> judge(const Vectors<F>& v) {
    begin(v);
    team_.wait("residual");
    return v.members[0].scalars.download().front();
  }

  /// Runs batches of iterations until all loads are solved. The next batch is always enqueued before the result of a
  /// batch is examined. If all loads are already solved, the kernels of that batch do nothing.
  template <int F>
  CocgScalars<F> iterate(Vectors<F>& v, const std::function<void()>& look) {
    const auto queue_batch = [&] {
      for (int k = 0; k < iterations_per_batch; ++k) {
        over_segments(v, "turn", cocg_turn<F>);
        team_.join_streams();
        improve(v, v.p.data(), false);
      }
    };
    begin(v);
    team_.join_streams();  // a batch begins on the first member's stream
    if (!v.batch && !waits_for_launches()) v.batch = team_.record(queue_batch);
    const PinnedCopies<CocgScalars<F>> looked(team_);
    for (int batch = 0;; ++batch) {
      if (v.batch)
        check_cuda(cudaGraphLaunch(v.batch, team_.stream()), "iterations");
      else
        queue_batch();
      looked.copy(v.members[0].scalars.data(), 1, batch % 2);
      look();
      if (batch == 0) continue;
      const CocgScalars<F>& before = *looked.wait((batch - 1) % 2);
      if (!before.running) return before;
    }
  }

  /// Bytes from which on a solution is copied through pinned memory. Pinning memory takes milliseconds.
  static constexpr std::size_t worth_pinning = std::size_t{32} << 20;

  DeviceList devices_;
  DeviceTeam team_;
  SystemMemory system_;
  bool last_single_ = false;  ///< whether the last solve() had one load; its solution is then in one_
  std::vector<Complex> usual_;
  std::unique_ptr<PinnedParts<Complex>> parts_;
  std::unique_ptr<Vectors<1>> one_;
  std::unique_ptr<Vectors<4>> four_;
};

}  // namespace

std::unique_ptr<DeviceSolver> make_device_solver(const LinearSystem& system, const DeviceList& devices,
                                                 std::int64_t& singular_body) {
  return std::make_unique<Solver>(system, devices, singular_body);
}

}  // namespace macadam::kernels
