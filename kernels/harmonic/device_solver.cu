// SPDX-License-Identifier: GPL-3.0-or-later
// device_solver.cu  Arrays of a system on the devices, and the queue of iterations.
#include <algorithm>
#include <limits>

#include "kernels/cuda_team.hpp"
#include "kernels/device_room.hpp"
#include "kernels/harmonic/cocg_kernels.hpp"
#include "kernels/harmonic/cocg_setup.hpp"

namespace macadam::kernels {
namespace {

using Complex = std::complex<double>;

/// The vectors of an iteration of F loads, and some iterations as a graph.
template <int F>
struct Vectors {
  static constexpr std::size_t lanes = 2 * F;
  DeviceArray<double> x, r, p, q, z, products, segment_sums, sums, boxes_move;
  DeviceArray<CocgScalars<F>> scalars;
  cudaGraphExec_t batch = nullptr;

  Vectors(const Shares& bodies, std::size_t segments, std::size_t boxes)
      : x(bodies, 6 * lanes),
        r(bodies, 6 * lanes),
        p(bodies, 6 * lanes),
        q(bodies, 6 * lanes),
        z(bodies, 6 * lanes),
        products(segments * 2 * lanes),
        segment_sums(segments * box_sums * lanes),
        sums(boxes * box_sums * lanes),
        boxes_move(6 * boxes * lanes),
        scalars(1) {}
  Vectors(const Vectors&) = delete;
  ~Vectors() {
    if (batch) cudaGraphExecDestroy(batch);
  }
};

class Solver : public DeviceSolver {
 public:
  Solver(const LinearSystem& system, const DeviceList& devices, std::int64_t& loose)
      : devices_(devices), team_(devices, nullptr, KernelOrder::first), free_(system.free), bodies_(system.bodies()) {
    make_segments(system);
    const Shares rows = share([&](std::size_t body) { return body + (body == bodies_); }),
                 ends = share([&](std::size_t body) { return system.row_begin[body]; });
    by_body_ = share([](std::size_t body) { return body; });
    particle_ = DeviceArray<std::int32_t>::of(system.particle, by_body_);
    row_begin_ = DeviceArray<std::size_t>::of(system.row_begin, rows);
    ends_ = DeviceArray<ContactEnd>::of(system.ends, ends);
    mass_ = DeviceArray<double>::of(system.mass, by_body_);
    coarse_ = DeviceArray<double>::of(system.coarse);
    motion_ = DeviceArray<double>::of(system.motion, by_body_);
    weight_ = DeviceArray<double>::of(system.weight);
    lever_ = DeviceArray<Lever>::of(system.lever, by_body_);
    inverse_ = DeviceArray<double>(by_body_, 36);
    ticket_ = DeviceArray<unsigned>(1);
    box_ticket_ = DeviceArray<unsigned>(boxes_);
    loose = invert(system.typical);
  }

  std::vector<LinearState> solve(const std::vector<LinearLoad>& loads, const std::function<void()>& look) override {
    team_.use(0);
    last_single_ = loads.size() == 1;
    return last_single_ ? solve_with(one_, loads, look) : solve_with(four_, loads, look);
  }

  void solution(std::size_t load, Complex* out) override {
    team_.use(0);
    if (last_single_)
      fetch(*one_, load, out);
    else
      fetch(*four_, load, out);
  }

 private:
  /// About as many segments as the device has room for blocks, of some warps' bodies each; as many for a team as for
  /// one device, and each member has a run of them.
  void make_segments(const LinearSystem& system) {
    boxes_ = system.boxes();
    int multiprocessors = 0;
    check_cuda(cudaDeviceGetAttribute(&multiprocessors, cudaDevAttrMultiProcessorCount, team_.device(0)), "device");
    const std::size_t wanted = bodies_ / (static_cast<std::size_t>(multiprocessors) * segments_a_multiprocessor) + 1;
    const auto length = static_cast<std::int32_t>((wanted + 31) / 32 * 32);
    std::vector<Segment> segments;
    std::vector<std::int32_t> box_segment{0};
    for (std::size_t b = 0; b < boxes_; ++b) {
      for (std::int32_t i = system.box_body[b]; i < system.box_body[b + 1]; i += length) {
        segments.push_back({i, std::min(i + length, system.box_body[b + 1]), static_cast<std::int32_t>(b)});
      }
      box_segment.push_back(static_cast<std::int32_t>(segments.size()));
    }
    segment_ = DeviceArray<Segment>::of(segments);
    box_segment_ = DeviceArray<std::int32_t>::of(box_segment);
    for (std::size_t m = 0; m <= team_.size(); ++m) {
      first_segment_.push_back(m * segments.size() / team_.size());
      first_body_.push_back(m == team_.size() ? bodies_
                                              : static_cast<std::size_t>(segments[first_segment_.back()].first));
    }
  }

  /// Of items, the first of a member being first(its first body).
  template <class First>
  Shares share(First&& first) const {
    Shares out;
    for (std::size_t m = 0; m < team_.size(); ++m) out.push_back({first(first_body_[m + 1]), team_.device(m)});
    return out;
  }

  std::int64_t invert(const RealStiffness& typical) {
    constexpr unsigned long long none = std::numeric_limits<unsigned long long>::max();
    DeviceArray<unsigned long long> loose(1);
    loose.upload(&none);
    constexpr unsigned threads = 128;
    launch("particle blocks", invert_blocks, (bodies_ + threads - 1) / threads, threads, 0, team_.stream(), bodies_,
           row_begin_.data(), ends_.data(), typical, inverse_.data(), loose.data());
    team_.wait("particle blocks");
    const unsigned long long found = loose.download().front();
    return found == none ? -1 : static_cast<std::int64_t>(found);
  }

  template <int F>
  CocgView<F> view(const Vectors<F>& v) const {
    return {segment_.data(),
            box_segment_.data(),
            row_begin_.data(),
            ends_.data(),
            mass_.data(),
            inverse_.data(),
            coarse_.data(),
            motion_.data(),
            weight_.data(),
            lever_.data(),
            v.x.data(),
            v.r.data(),
            v.p.data(),
            v.q.data(),
            v.z.data(),
            v.products.data(),
            v.segment_sums.data(),
            v.sums.data(),
            v.boxes_move.data(),
            ticket_.data(),
            box_ticket_.data(),
            v.scalars.data(),
            static_cast<unsigned>(segment_.size()),
            static_cast<unsigned>(boxes_),
            free_,
            team_.size() > 1};
  }

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
    if (!own) own = std::make_unique<Vectors<F>>(by_body_, segment_.size(), boxes_);
    Vectors<F>& v = *own;
    v.x.clear();
    for (std::size_t f = 0; f < loads.size(); ++f) {
      if (!loads[f].start) continue;
      DeviceArray<double2> staged(6 * bodies_);
      staged.upload(reinterpret_cast<const double2*>(loads[f].start));
      over_numbers("starts", to_lanes<F>, 6 * bodies_, staged.data(), particle_.data(), v.x.data(), 6 * bodies_,
                   int(f));
    }
    std::vector<DeviceArray<BodyLoad>> right;
    for (const LinearLoad& load : loads) right.push_back(DeviceArray<BodyLoad>::of(load.right));
    const auto start_from_right_sides = [&](const CocgScalars<F>& start) {
      v.scalars.upload(&start);
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
      const DeviceRoom::ForSolution room(devices_, team_.behind());
      end = iterate(v, look);
      start.most_iterations = 0;  // only judges
      start_from_right_sides(start);
      judged = iterate(v, look);
    }
    std::vector<LinearState> out;
    for (std::size_t f = 0; f < loads.size(); ++f) {
      out.push_back(end.state[f]);
      out.back().energy = judged.state[f].energy;
    }
    return out;
  }

  template <int F>
  void fetch(const Vectors<F>& v, std::size_t load, Complex* out) {
    DeviceArray<double2> staged(6 * bodies_);
    over_numbers("solutions", from_lanes<F>, 6 * bodies_, v.x.data(), particle_.data(), staged.data(), 6 * bodies_,
                 int(load));
    copy_now(out, staged.data(), staged.bytes(), "solutions");
  }

  /// A kernel of a thread for each of `count`, on the first device, to its end.
  template <class Kernel, class... Arguments>
  void over_numbers(const char* name, Kernel kernel, std::size_t count, Arguments... arguments) {
    if (count == 0) return;
    launch(name, kernel, (count + cocg_threads - 1) / cocg_threads, cocg_threads, 0, team_.stream(), arguments...);
    team_.wait(name);
  }

  /// Some iterations are always queued ahead of those that are looked at; once all is done they do nothing.
  template <int F>
  CocgScalars<F> iterate(Vectors<F>& v, const std::function<void()>& look) {
    const CocgView<F> d = view(v);
    // a kernel over all segments, of which each member has a run
    const auto over_segments = [&](const char* name, auto kernel, auto... arguments) {
      team_.each([&](std::size_t m) {
        const std::size_t first = first_segment_[m];
        launch(name, kernel, first_segment_[m + 1] - first, cocg_threads, 0, team_.stream(m), d,
               static_cast<unsigned>(first), arguments...);
      });
      team_.meet();
    };
    const auto improve = [&](const double* from, bool first) {
      over_segments("apply", cocg_apply<F>, from, first);
      over_segments("advance", cocg_advance<F>);
      launch("coarse", cocg_coarse<F>, (6 * boxes_ + cocg_threads / 32 - 1) / (cocg_threads / 32), cocg_threads, 0,
             team_.stream(), d);
      team_.meet();
    };
    const auto queue_batch = [&] {
      for (int k = 0; k < batch_length; ++k) {
        over_segments("turn", cocg_turn<F>);
        improve(v.p.data(), false);
      }
    };
    team_.meet();
    improve(v.x.data(), true);  // r = f − K·x: x does not move along p = 0
    if (!v.batch && !waits_for_launches()) v.batch = team_.record(queue_batch);
    const PinnedScalars<F> looked(team_);
    for (int batch = 0;; ++batch) {
      if (v.batch)
        check_cuda(cudaGraphLaunch(v.batch, team_.stream()), "iterations");
      else
        queue_batch();
      looked.copy(v.scalars, batch % 2, team_.stream());
      look();
      if (batch == 0) continue;
      const CocgScalars<F>& before = looked.wait((batch - 1) % 2);
      if (!before.running) return before;
    }
  }

  /// Where the device copies its scalars while it goes on.
  template <int F>
  class PinnedScalars {
   public:
    explicit PinnedScalars(const DeviceTeam& team) : team_(team) {
      check_cuda(cudaMallocHost(&host_, 2 * sizeof(CocgScalars<F>)), "pinned memory");
      for (cudaEvent_t& e : copied_) check_cuda(cudaEventCreateWithFlags(&e, cudaEventDisableTiming), "event");
    }
    PinnedScalars(const PinnedScalars&) = delete;
    ~PinnedScalars() {
      cudaStreamSynchronize(team_.stream());  // a copy may be under way
      cudaFreeHost(host_);
      for (cudaEvent_t e : copied_) cudaEventDestroy(e);
    }
    void copy(const DeviceArray<CocgScalars<F>>& from, int slot, cudaStream_t stream) const {
      check_cuda(cudaMemcpyAsync(&host_[slot], from.data(), from.bytes(), cudaMemcpyDeviceToHost, stream),
                 "iterations");
      check_cuda(cudaEventRecord(copied_[slot], stream), "iterations");
    }
    const CocgScalars<F>& wait(int slot) const {
      check_cuda(cudaEventSynchronize(copied_[slot]), "iterations");
      return host_[slot];
    }

   private:
    const DeviceTeam& team_;
    CocgScalars<F>* host_ = nullptr;
    cudaEvent_t copied_[2] = {};
  };

  static constexpr int batch_length = 8;
  static constexpr std::size_t segments_a_multiprocessor = 16;  ///< few enough for one, enough for two devices

  DeviceList devices_;
  DeviceTeam team_;
  int free_;
  std::size_t bodies_, boxes_ = 0;
  std::vector<std::size_t> first_segment_, first_body_;  // [member + 1]
  bool last_single_ = false;                             ///< of the last solve(): its solution is in one_
  Shares by_body_;
  DeviceArray<std::int32_t> particle_;
  DeviceArray<std::size_t> row_begin_;
  DeviceArray<ContactEnd> ends_;
  DeviceArray<double> mass_, inverse_, coarse_, motion_, weight_;
  DeviceArray<Lever> lever_;
  DeviceArray<Segment> segment_;
  DeviceArray<std::int32_t> box_segment_;
  DeviceArray<unsigned> ticket_, box_ticket_;
  std::unique_ptr<Vectors<1>> one_;
  std::unique_ptr<Vectors<4>> four_;
};

}  // namespace

std::unique_ptr<DeviceSolver> make_device_solver(const LinearSystem& system, const DeviceList& devices,
                                                 std::int64_t& loose) {
  return std::make_unique<Solver>(system, devices, loose);
}

}  // namespace macadam::kernels
