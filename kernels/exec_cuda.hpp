// SPDX-License-Identifier: GPL-3.0-or-later
/// \file exec_cuda.hpp  How the step runs on a CUDA device: a thread a contact, a thread a body, sums over fixed rows.
///
/// Every contact writes its two ends' loads to records of its own; a body sums its row of records in fixed order. No
/// atomics, so the same device gives the same bits every run.
#pragma once

#include <cuda_runtime.h>
#include <thrust/copy.h>
#include <thrust/device_vector.h>
#include <thrust/fill.h>

#include <memory>
#include <string>

#include "kernels/contact_forces.hpp"
#include "kernels/layout.hpp"
#include "kernels/particle_motion.hpp"
#include "kernels/state_list.hpp"
#include "macadam/error.hpp"

namespace macadam::kernels {

/// \throws RunError naming what was done and what CUDA says.
inline void check_cuda(cudaError_t status, const char* what) {
  if (status != cudaSuccess) throw RunError(std::string("CUDA: ") + what + ": " + cudaGetErrorString(status));
}

/// Runs body(i) for i < n.
template <class Body>
__global__ void for_each_index(Body body, std::uint32_t n) {
  const std::uint32_t i = blockIdx.x * blockDim.x + threadIdx.x;
  if (i < n) body(i);
}

/// The only launch: skips empty ranges and checks every time.
template <class Body>
void launch(const char* name, std::uint32_t n, const Body& body) {
  if (n == 0) return;
  constexpr unsigned threads = 128;
  for_each_index<<<(n + threads - 1) / threads, threads>>>(body, n);
  check_cuda(cudaGetLastError(), name);
}

/// One contact of a packet of 32.
struct LaneItem {
  std::uint32_t lane;
  template <class R>
  using Value = R;

  MACADAM_HD static constexpr std::size_t lanes() { return 32; }
  template <class R>
  MACADAM_HD R load(const R* p) const {
    return p[lane];
  }
  template <class R>
  MACADAM_HD void store(R* p, R x) const {
    p[lane] = x;
  }
  template <class R>
  MACADAM_HD R& ref(R* p) const {
    return p[lane];
  }
  template <class To, class From>
  MACADAM_HD static To convert(From x) {
    return static_cast<To>(x);
  }
  MACADAM_HD static double copysign_one(double z) { return ::copysign(1.0, z); }
  MACADAM_HD static float copysign_one(float z) { return ::copysignf(1.0f, z); }
  template <class T>
  MACADAM_HD static T select(bool mask, T yes, T no) {
    return mask ? yes : no;
  }
  template <class R>
  MACADAM_HD Twist<R> twist(const R* velocity, const std::int32_t* body) const {
    const R* v = velocity + static_cast<std::size_t>(body[lane]) * velocity_words;
    return {{v[0], v[1], v[2]}, {v[4], v[5], v[6]}};
  }
  template <class To, class R>
  MACADAM_HD Vec3<To> vector(const R* displacement, const std::int32_t* body) const {
    const R* u = displacement + static_cast<std::size_t>(body[lane]) * displacement_words;
    return {static_cast<To>(u[0]), static_cast<To>(u[1]), static_cast<To>(u[2])};
  }
  template <class To, class R>
  MACADAM_HD Vec3<To> relative(const R* displacement, const std::int32_t* a, const std::int32_t* b) const {
    const R* ua = displacement + static_cast<std::size_t>(a[lane]) * displacement_words;
    const R* ub = displacement + static_cast<std::size_t>(b[lane]) * displacement_words;
    return {static_cast<To>(ub[0] - ua[0]), static_cast<To>(ub[1] - ua[1]), static_cast<To>(ub[2] - ua[2])};
  }
};

/// Records of loads: slot s of all groups has its A end at 2s and its B end at 2s + 1, eight words each.
template <class P>
struct LoadRecords {
  typename P::Geometry* words;
  const std::uint32_t* row_begin;  ///< [body + 1]
  const std::uint32_t* row;        ///< record numbers

  MACADAM_HD Twist<typename P::Particle> sum(std::int32_t body) const {
    Twist<typename P::Particle> total{};
    for (std::uint32_t r = row_begin[body]; r < row_begin[body + 1]; ++r) {
      const auto* w = words + static_cast<std::size_t>(row[r]) * velocity_words;
      total.linear += {w[0], w[1], w[2]};
      total.angular += {w[4], w[5], w[6]};
    }
    return total;
  }
};

/// Steps contact `slot` and writes its record.
template <class Forces>
struct StepContact {
  using P = typename Forces::Policy;
  Forces forces;
  MotionView<P> motion;
  typename P::Geometry* records;  ///< of this group's first slot

  __device__ void operator()(std::uint32_t slot) const {
    const auto load = forces(LaneItem{slot % 32}, slot / 32, motion);
    auto* a = records + static_cast<std::size_t>(slot) * 2 * velocity_words;
    auto* b = a + velocity_words;
    a[0] = load.force_a.x, a[1] = load.force_a.y, a[2] = load.force_a.z;
    a[4] = load.moment_a.x, a[5] = load.moment_a.y, a[6] = load.moment_a.z;
    b[0] = -load.force_a.x, b[1] = -load.force_a.y, b[2] = -load.force_a.z;
    b[4] = load.moment_b.x, b[5] = load.moment_b.y, b[6] = load.moment_b.z;
  }
};

/// Moves one body.
template <class P>
struct StepBody {
  ParticleMotion<P> motion;
  LoadRecords<P> records;
  std::int64_t k;
  __device__ void operator()(std::uint32_t body) const {
    const auto i = static_cast<std::int32_t>(body);
    motion(i, i < motion.body.particles ? records.sum(i) : Twist<typename P::Particle>{}, k);
  }
};

/// Writes the summed load of one body.
template <class P>
struct SumBody {
  LoadRecords<P> records;
  Twist<typename P::Particle>* out;
  std::int32_t first;
  __device__ void operator()(std::uint32_t i) const { out[i] = records.sum(first + static_cast<std::int32_t>(i)); }
};

/// Owns the arrays of a scene on the device and runs bodies and contacts over them.
template <class P>
class ExecCuda {
 public:
  using Policy = P;
  using R = typename P::Particle;
  static constexpr int lanes = 32;
  static constexpr std::size_t tile_contacts = 4096;  ///< only the order matters here

  ExecCuda(const ContactNetwork& network, const Layout& layout, int) : layout_(layout) {
    const std::size_t bodies = layout.particles() + walls;
    master_.assign(bodies * velocity_words, R(0));
    displacement_.assign(bodies * displacement_words, 0.0);
    if constexpr (!std::is_same_v<typename P::Geometry, R>) velocity_.assign(bodies * velocity_words, 0);
    make_rows(network);
    add_state("records", "N, N m", records_);
    add_state("velocity", "m/s, rad/s", master_);
    add_state("displacement", "m, rad", displacement_);
    add_state("gathered_velocity", "m/s, rad/s", velocity_);
  }

  BodyView<P> set_bodies(const std::vector<R>& inverse) {
    inverse_ = inverse;
    return {gathered(), raw(master_), raw(displacement_), raw(inverse_),
            static_cast<std::int32_t>(layout_.particles())};
  }

  template <class Forces>
  void add_group(ContactArrays<P> arrays, Forces forces) {
    auto group = std::make_unique<GroupOf<Forces>>();
    group->slots = static_cast<std::uint32_t>(arrays.body_a.size());
    group->forces = forces;
    group->forces.view = arrays.shape;
    arrays.for_each_array(group->forces.view, [&](auto name, auto unit, auto& array, auto& pointer) {
      auto& copy = group->storage.add(array);
      pointer = raw(copy);
      const auto size = static_cast<std::int64_t>(array.size() * sizeof(array[0]));
      bytes_ += size;
      if constexpr (!std::is_const_v<std::remove_pointer_t<std::decay_t<decltype(pointer)>>>) {
        state_bytes_ += size;
        add_state(std::string(name) + "_" + to_string(layout_.groups[groups_.size()].pair), unit, copy);
      }
    });
    group->first_slot = groups_.empty() ? 0 : groups_.back()->first_slot + groups_.back()->slots;
    groups_.push_back(std::move(group));
  }

  void bodies(const ParticleMotion<P>& motion, std::int64_t k) {
    launch("bodies", static_cast<std::uint32_t>(layout_.particles() + walls), StepBody<P>{motion, records(), k});
  }
  void contacts() {
    for (const auto& group : groups_) group->run({gathered(), raw(displacement_)}, raw(records_));
  }

  /// Queues all steps and waits for them, so that a failing kernel is reported here.
  template <class F>
  void repeat(std::int64_t first, std::int64_t steps, F&& f) {
    for (std::int64_t k = first; k < first + steps; ++k) f(*this, k);
    check_cuda(cudaDeviceSynchronize(), "time steps");
  }

  std::vector<Twist<R>> forces(std::int32_t first, std::size_t count) const {
    thrust::device_vector<Twist<R>> sums(count);
    launch("sums", static_cast<std::uint32_t>(count),
           SumBody<P>{records(), thrust::raw_pointer_cast(sums.data()), first});
    return to_host(sums);
  }
  std::vector<R> velocities() const { return to_host(master_); }
  std::vector<double> displacements() const { return to_host(displacement_); }
  void set_displacements(const std::vector<double>& u) { displacement_ = u; }
  void set_velocities(const std::vector<R>& v) {
    master_ = v;
    if constexpr (!std::is_same_v<typename P::Geometry, R>) thrust::copy(v.begin(), v.end(), velocity_.begin());
  }

  /// Everything that a step changes.
  const StateList& states() const { return states_; }

  std::string description() const {
    cudaDeviceProp properties{};
    check_cuda(cudaGetDeviceProperties(&properties, 0), "device properties");
    return std::string("cuda, ") + properties.name;
  }
  std::int64_t state_bytes() const { return state_bytes_; }
  std::int64_t bytes() const {
    return bytes_ + static_cast<std::int64_t>(master_.size() * sizeof(R) + displacement_.size() * sizeof(double) +
                                              (velocity_.size() + records_.size()) * sizeof(typename P::Geometry));
  }

 private:
  /// Device copies of a group's arrays, whatever their types.
  struct Storage {
    std::vector<std::shared_ptr<void>> owned;
    template <class Array>
    auto& add(const Array& array) {
      using T = typename Array::value_type;
      auto copy = std::make_shared<thrust::device_vector<T>>(array.begin(), array.end());
      owned.push_back(copy);
      return *copy;
    }
  };
  struct Group {
    virtual ~Group() = default;
    virtual void run(const MotionView<P>& motion, typename P::Geometry* records) const = 0;
    std::uint32_t slots = 0, first_slot = 0;
    Storage storage;
  };
  template <class Forces>
  struct GroupOf final : Group {
    Forces forces;
    void run(const MotionView<P>& motion, typename P::Geometry* records) const override {
      launch("contacts", this->slots,
             StepContact<Forces>{forces, motion,
                                 records + static_cast<std::size_t>(this->first_slot) * 2 * velocity_words});
    }
  };

  /// The array must stay where it is.
  template <class T>
  void add_state(const std::string& name, const std::string& unit, thrust::device_vector<T>& array) {
    states_.add<T>(
        name, unit, array.size(), [&array] { return to_host(array); },
        [&array](const std::vector<T>& values) { thrust::copy(values.begin(), values.end(), array.begin()); });
  }

  void make_rows(const ContactNetwork& network) {
    std::vector<std::vector<std::uint32_t>> rows(layout_.particles() + walls);
    std::uint32_t slot = 0;
    for (const auto& group : layout_.groups) {
      for (const std::uint32_t c : group.contact) {
        if (c != inert) {
          rows[static_cast<std::size_t>(layout_.body_of(network.contacts[c].a))].push_back(2 * slot);
          rows[static_cast<std::size_t>(layout_.body_of(network.contacts[c].b))].push_back(2 * slot + 1);
        }
        ++slot;
      }
    }
    std::vector<std::uint32_t> begin{0}, flat;
    for (const auto& r : rows) {
      flat.insert(flat.end(), r.begin(), r.end());
      begin.push_back(static_cast<std::uint32_t>(flat.size()));
    }
    row_begin_ = begin;
    row_ = flat;
    records_.assign(static_cast<std::size_t>(slot) * 2 * velocity_words, 0);
  }

  LoadRecords<P> records() const {
    auto* words = const_cast<typename P::Geometry*>(thrust::raw_pointer_cast(records_.data()));
    return {words, thrust::raw_pointer_cast(row_begin_.data()), thrust::raw_pointer_cast(row_.data())};
  }
  typename P::Geometry* gathered() {
    if constexpr (std::is_same_v<typename P::Geometry, R>)
      return raw(master_);
    else
      return raw(velocity_);
  }
  template <class T>
  static T* raw(thrust::device_vector<T>& v) {
    return thrust::raw_pointer_cast(v.data());
  }
  template <class T>
  static std::vector<T> to_host(const thrust::device_vector<T>& v) {
    std::vector<T> out(v.size());
    thrust::copy(v.begin(), v.end(), out.begin());
    return out;
  }

  const Layout& layout_;
  StateList states_;
  std::vector<std::unique_ptr<Group>> groups_;
  thrust::device_vector<R> master_, inverse_;
  thrust::device_vector<double> displacement_;
  thrust::device_vector<typename P::Geometry> velocity_, records_;
  thrust::device_vector<std::uint32_t> row_begin_, row_;
  std::int64_t bytes_ = 0, state_bytes_ = 0;  // of the groups; states are what a step writes
};

}  // namespace macadam::kernels
