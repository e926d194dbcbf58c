// SPDX-License-Identifier: GPL-3.0-or-later
// device_solver.cu  Arrays of a system on the device, and the queue of iterations.
#include <algorithm>
#include <limits>

#include "kernels/cuda_launch.hpp"
#include "kernels/harmonic/cocg_kernels.hpp"
#include "kernels/harmonic/cocg_setup.hpp"

namespace macadam::kernels {
namespace {

using Complex = std::complex<double>;

/// The vectors of an iteration of F loads.
template <int F>
struct Vectors {
  static constexpr std::size_t lanes = 2 * F;
  DeviceArray<double> x, r, p, q, z, products, segment_sums, sums, boxes_move;
  DeviceArray<CocgScalars<F>> scalars;

  Vectors(std::size_t bodies, std::size_t segments, std::size_t boxes)
      : x(6 * bodies * lanes),
        r(x.size()),
        p(x.size()),
        q(x.size()),
        z(x.size()),
        products(segments * 2 * lanes),
        segment_sums(segments * box_sums * lanes),
        sums(boxes * box_sums * lanes),
        boxes_move(6 * boxes * lanes),
        scalars(1) {}
};

class Solver : public DeviceSolver {
 public:
  Solver(const LinearSystem& system, std::int64_t& loose) : free_(system.free) {
    check_cuda(cudaGetDevice(&device_), "device");
    bodies_ = system.bodies();
    row_begin_ = DeviceArray<std::size_t>::of(system.row_begin);
    ends_ = DeviceArray<ContactEnd>::of(system.ends);
    mass_ = DeviceArray<double>::of(system.mass);
    coarse_ = DeviceArray<double>::of(system.coarse);
    motion_ = DeviceArray<double>::of(system.motion);
    weight_ = DeviceArray<double>::of(system.weight);
    lever_ = DeviceArray<Lever>::of(system.lever);
    inverse_ = DeviceArray<double>(36 * bodies_);
    make_segments(system);
    ticket_ = DeviceArray<unsigned>(1);
    box_ticket_ = DeviceArray<unsigned>(boxes_);
    loose = invert(system.typical);
  }

  std::vector<LinearState> solve(const std::vector<LinearLoad>& loads, const std::vector<const Complex*>& right,
                                 const std::vector<Complex*>& motion, const std::function<void()>& look) override {
    check_cuda(cudaSetDevice(device_), "device");
    if (loads.size() == 1) return solve_with(one_, loads, right, motion, look);
    return solve_with(four_, loads, right, motion, look);
  }

 private:
  /// About as many segments as the device has room for blocks, of some warps' bodies each.
  void make_segments(const LinearSystem& system) {
    boxes_ = system.boxes();
    int multiprocessors = 0;
    check_cuda(cudaDeviceGetAttribute(&multiprocessors, cudaDevAttrMultiProcessorCount, device_), "device");
    const std::size_t wanted = bodies_ / (static_cast<std::size_t>(multiprocessors) * 8) + 1;
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
  }

  std::int64_t invert(const RealStiffness& typical) {
    constexpr unsigned long long none = std::numeric_limits<unsigned long long>::max();
    DeviceArray<unsigned long long> loose(1);
    loose.upload(&none);
    constexpr unsigned threads = 128;
    launch("particle blocks", invert_blocks, (bodies_ + threads - 1) / threads, threads, 0, nullptr, bodies_,
           row_begin_.data(), ends_.data(), typical, inverse_.data(), loose.data());
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
            free_};
  }

  template <int F>
  static CocgScalars<F> scalars_of(const std::vector<LinearLoad>& loads) {
    CocgScalars<F> out{};
    out.inert = out.running = true;
    out.best = std::numeric_limits<double>::infinity();
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
      out.most_iterations = std::max(out.most_iterations, load.most_iterations);
    }
    return out;
  }

  template <int F>
  std::vector<LinearState> solve_with(std::unique_ptr<Vectors<F>>& own, const std::vector<LinearLoad>& loads,
                                      const std::vector<const Complex*>& right, const std::vector<Complex*>& motion,
                                      const std::function<void()>& look) {
    if (!own) own = std::make_unique<Vectors<F>>(bodies_, segment_.size(), boxes_);
    Vectors<F>& v = *own;
    const CocgScalars<F> start = scalars_of<F>(loads);
    v.scalars.upload(&start);
    const std::size_t size = 6 * bodies_, blocks = (size + cocg_threads - 1) / cocg_threads;
    DeviceArray<double2> staged(size);
    for (auto* array : {&v.x, &v.r, &v.p}) check_cuda(cudaMemset(array->data(), 0, array->bytes()), "vectors");
    for (std::size_t f = 0; f < loads.size(); ++f) {
      staged.upload(reinterpret_cast<const double2*>(right[f]));
      launch("loads", to_lanes<F>, blocks, cocg_threads, 0, nullptr, staged.data(), v.r.data(), size, int(f));
      staged.upload(reinterpret_cast<const double2*>(motion[f]));
      launch("loads", to_lanes<F>, blocks, cocg_threads, 0, nullptr, staged.data(), v.x.data(), size, int(f));
    }
    const CocgScalars<F> end = iterate(v, look);
    std::vector<LinearState> out;
    for (std::size_t f = 0; f < loads.size(); ++f) {
      launch("motions", from_lanes<F>, blocks, cocg_threads, 0, nullptr, v.x.data(), staged.data(), size, int(f));
      check_cuda(cudaMemcpy(motion[f], staged.data(), staged.bytes(), cudaMemcpyDeviceToHost), "motions");
      out.push_back(end.state[f]);
    }
    return out;
  }

  /// Some iterations are always queued ahead of those that are looked at; once all is done they do nothing.
  template <int F>
  CocgScalars<F> iterate(Vectors<F>& v, const std::function<void()>& look) {
    const CocgView<F> d = view(v);
    const std::size_t segments = segment_.size(), rows = (6 * boxes_ + cocg_threads / 32 - 1) / (cocg_threads / 32);
    const auto improve = [&](const double* from, bool first) {
      launch("apply", cocg_apply<F>, segments, cocg_threads, 0, nullptr, d, from, first);
      launch("advance", cocg_advance<F>, segments, cocg_threads, 0, nullptr, d);
      launch("coarse", cocg_coarse<F>, rows, cocg_threads, 0, nullptr, d);
    };
    improve(v.x.data(), true);  // r = f − K·x: x does not move along p = 0
    const PinnedScalars<F> looked;
    for (int batch = 0;; ++batch) {
      for (int k = 0; k < batch_length; ++k) {
        launch("turn", cocg_turn<F>, segments, cocg_threads, 0, nullptr, d);
        improve(v.p.data(), false);
      }
      looked.copy(v.scalars, batch % 2);
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
    PinnedScalars() {
      check_cuda(cudaMallocHost(&host_, 2 * sizeof(CocgScalars<F>)), "pinned memory");
      for (cudaEvent_t& e : copied_) check_cuda(cudaEventCreateWithFlags(&e, cudaEventDisableTiming), "event");
    }
    PinnedScalars(const PinnedScalars&) = delete;
    ~PinnedScalars() {
      cudaDeviceSynchronize();  // a copy may be under way
      cudaFreeHost(host_);
      for (cudaEvent_t e : copied_) cudaEventDestroy(e);
    }
    void copy(const DeviceArray<CocgScalars<F>>& from, int slot) const {
      check_cuda(cudaMemcpyAsync(&host_[slot], from.data(), from.bytes(), cudaMemcpyDeviceToHost), "iterations");
      check_cuda(cudaEventRecord(copied_[slot]), "iterations");
    }
    const CocgScalars<F>& wait(int slot) const {
      check_cuda(cudaEventSynchronize(copied_[slot]), "iterations");
      return host_[slot];
    }

   private:
    CocgScalars<F>* host_ = nullptr;
    cudaEvent_t copied_[2] = {};
  };

  static constexpr int batch_length = 8;

  int device_ = 0, free_;
  std::size_t bodies_ = 0, boxes_ = 0;
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

std::unique_ptr<DeviceSolver> make_device_solver(const LinearSystem& system, std::int64_t& loose) {
  return std::make_unique<Solver>(system, loose);
}

}  // namespace macadam::kernels
