// SPDX-License-Identifier: GPL-3.0-or-later
/// \file exec_cuda.hpp  How the step runs on a CUDA device: in blocks of steps over tiles (cuda_tile_runner.hpp), or
/// two kernels a step, queued as graphs of many steps.
///
/// The latter serves any form, law and precision: every contact writes its two ends' loads to records of its own, which
/// lie in the order of the bodies; a body sums its run of records in fixed order. No floating-point atomics anywhere,
/// so the same device gives the same bits every run.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "kernels/cuda_divergence.hpp"
#include "kernels/cuda_tile_runner.hpp"
#include "kernels/layout.hpp"
#include "kernels/state_list.hpp"

namespace macadam::kernels {

/// Owns the arrays of a scene on the device and runs bodies and contacts over them.
template <class P>
class ExecCuda {
 public:
  using Policy = P;
  using R = typename P::Particle;
  using G = typename P::Geometry;
  static constexpr int lanes = 32;
  static constexpr bool room_for_five = true;  ///< Kelvin units in registers, beside exactly three
  static constexpr bool blocks = !std::is_same_v<P, DoublePrecision>;  ///< steps may be taken in blocks

  /// Contacts of a tile: a tile a multiprocessor where the scene fits the chip, else so few that several tiles share
  /// one. A contact takes some 75 bytes of shared memory there: two slots of loads and its share of the bodies.
  static std::size_t tile_contacts_of(const ContactNetwork& network) {
    const DeviceLimits limits = DeviceLimits::query();
    const auto chips = static_cast<std::size_t>(limits.multiprocessors),
               shared = static_cast<std::size_t>(limits.shared);
    const std::size_t contacts = network.contacts.size();
    if (contacts > shared / 75 * chips) return std::min<std::size_t>(1000, shared / 100);
    return std::max<std::size_t>(128, contacts / (chips + 1) + 1);
  }

  ExecCuda(const ContactNetwork& network, const Layout& layout, int)
      : network_(network),
        layout_(layout),
        master_(bodies() * velocity_words),
        displacement_(bodies() * displacement_words),
        velocity_(std::is_same_v<G, R> ? 0 : bodies() * velocity_words),
        step_(1) {
    check_cuda(cudaStreamCreate(&stream_), "stream");
    make_rows(network);
  }
  ExecCuda(const ExecCuda&) = delete;
  ~ExecCuda() {
    for (auto* graph : {many_, one_}) {
      if (graph) cudaGraphExecDestroy(graph);
    }
    cudaStreamDestroy(stream_);
  }

  /// Decides whether steps are taken in blocks. `height`: of the specimen [m]; `group_bytes`: of the groups to come.
  /// \throws RunError where the device has not enough memory for all that is to come.
  void set_options(const StepperOptions& options, const std::array<std::optional<Law>, pair_types>& laws, double height,
                   std::size_t group_bytes) {
    dt_ = options.dt;
    if constexpr (blocks) {
      const int block = options.form == ContactForm::condensed ? block_steps(options, laws, height) : 0;
      if (block > 0) tiles_ = std::make_unique<TileRunner<P>>(network_, layout_, options, block, stream_);
      if (tiles_ && !tiles_->possible()) tiles_.reset();
    }
    const std::size_t records = record_count_ * record_words * sizeof(G);
    require_memory(group_bytes + (tiles_ ? tiles_->bytes_to_come(record_count_) : records));
    if (!tiles_) records_ = DeviceArray<G>(record_count_ * record_words);
  }

  BodyView<P> set_bodies(const std::vector<R>& inverse) {
    inverse_ = DeviceArray<R>::of(inverse);
    return {gathered(), master_.data(), displacement_.data(), inverse_.data(),
            static_cast<std::int32_t>(layout_.particles())};
  }

  /// Takes a group: its arrays, and the functor that steps its contacts.
  template <class Forces>
  void add_group(ContactArrays<P> arrays, Forces forces) {
    const auto slots = static_cast<std::uint32_t>(arrays.body_a.size());
    forces.view = arrays.shape;
    arrays.for_each_array(forces.view, [&](auto name, auto unit, auto& array, auto& pointer) {
      pointer = store_.keep(array);
      const auto size = static_cast<std::int64_t>(array.size() * sizeof(array[0]));
      bytes_ += size;
      if constexpr (!std::is_const_v<std::remove_pointer_t<std::decay_t<decltype(pointer)>>>) {
        state_bytes_ += size;
        const char* pair = to_string(layout_.groups[static_cast<std::size_t>(groups_)].pair);
        add_device_state(states_, std::string(name) + "_" + pair, unit, pointer, array.size());
      }
    });
    if (tiles_)
      add_to_tiles(arrays, forces);
    else
      contacts_.add(forces, slots_, slots);
    slots_ += slots;
    ++groups_;
  }

  /// Ends the set-up.
  void prepare(const ParticleMotion<P>& motion) {
    std::vector<std::uint32_t> long_rows;
    for (std::size_t i = 0; i < bodies(); ++i) {
      if (row_lengths_[i + 1] - row_lengths_[i] > long_row) long_rows.push_back(static_cast<std::uint32_t>(i));
    }
    if (tiles_) tiles_->prepare(motion, row_begin_.data(), place_.data(), record_count_, long_rows);
    row_lengths_ = {};
    const auto add = [&](const char* name, const char* unit, const auto& array) {
      add_device_state(states_, name, unit, array.data(), array.size());
    };
    add("velocity", "m/s, rad/s", master_);
    add("displacement", "m, rad", displacement_);
    add("gathered_velocity", "m/s, rad/s", velocity_);
    add("loads", "N, N m", records_);
    if (tiles_) tiles_->add_states(states_);
  }

  void bodies(const ParticleMotion<P>& motion, std::int64_t) {
    const std::size_t blocks = long_body_.size() + (bodies() + bodies_a_block - 1) / bodies_a_block;
    launch("bodies", step_bodies<P>, blocks, body_threads, 0, stream_, motion, records(), long_body_.data(),
           static_cast<std::uint32_t>(long_body_.size()), step_.data());
  }
  void contacts() { contacts_.run(stream_, {gathered(), displacement_.data()}, records(), step_.data()); }

  /// Queues all steps, as graphs of many, and waits for them, so that a failing kernel is reported here. The number of
  /// the step is counted on the device.
  template <class F>
  void repeat(std::int64_t first, std::int64_t steps, F&& f) {
    if (tiles_) {
      tiles_->run(first, steps);
      check_cuda(cudaStreamSynchronize(stream_), "time steps");
      return;
    }
    step_.upload(&first);
    const auto queue = [&](cudaGraphExec_t& graph, std::int64_t n) {
      if (!graph)
        graph = record([&] {
          for (std::int64_t k = 0; k < n; ++k) f(*this, k);
        });
      check_cuda(cudaGraphLaunch(graph, stream_), "time steps");
      steps -= n;
    };
    while (steps >= steps_a_graph) queue(many_, steps_a_graph);
    while (steps > 0) queue(one_, 1);
    check_cuda(cudaStreamSynchronize(stream_), "time steps");
  }

  std::vector<Twist<R>> forces(std::int32_t first, std::size_t count) const {
    const std::vector<R> words = tiles_ ? tile_forces(first, count) : sums(first, count);
    std::vector<Twist<R>> out(count);
    for (std::size_t i = 0; i < count; ++i) {
      const R* w = &words[i * velocity_words];
      out[i] = {{w[0], w[1], w[2]}, {w[4], w[5], w[6]}};
    }
    return out;
  }
  std::vector<R> velocities() const { return master_.download(); }
  std::vector<double> displacements() const { return displacement_.download(); }
  void set_displacements(const std::vector<double>& u) { displacement_.upload(u.data()); }
  void set_velocities(const std::vector<R>& v) {
    master_.upload(v.data());
    if constexpr (!std::is_same_v<G, R>) {
      const std::vector<G> rounded(v.begin(), v.end());
      velocity_.upload(rounded.data());
    }
  }

  /// As Stepper::first_divergent(). `radius` in specimen order.
  std::int64_t first_divergent(const std::vector<double>& radius, double dt) const {
    if (!divergence_) divergence_ = std::make_unique<DivergenceSearch<P>>(layout_, radius);
    return divergence_->first(master_.data(), dt, stream_);
  }

  std::string description() const {
    cudaDeviceProp properties{};
    check_cuda(cudaGetDeviceProperties(&properties, 0), "device properties");
    return std::string("cuda, ") + properties.name + ", " + (tiles_ ? tiles_->description() : "two kernels a step");
  }
  /// The kernels of a step.
  std::vector<KernelUse> kernels() const {
    if (tiles_) return tiles_->kernels();
    std::vector<KernelUse> out = contacts_.kernels();
    out.push_back(kernel_use("bodies", step_bodies<P>, body_threads, 0));
    return out;
  }
  /// Bytes that a step moves at the least.
  std::int64_t traffic() const {
    const std::size_t bodies = 2 * (master_.bytes() + displacement_.bytes() + velocity_.bytes()) + inverse_.bytes();
    if (tiles_) return tiles_->traffic() + static_cast<std::int64_t>(bodies);
    return bytes_ + state_bytes_ + static_cast<std::int64_t>(bodies + 2 * records_.bytes() + place_.bytes());
  }
  /// Everything that a step changes.
  const StateList& states() const { return states_; }

  std::int64_t bytes() const {
    return bytes_ +
           static_cast<std::int64_t>(master_.bytes() + displacement_.bytes() + inverse_.bytes() + velocity_.bytes() +
                                     records_.bytes() + place_.bytes()) +
           (tiles_ ? tiles_->bytes() : 0);
  }

 private:
  static constexpr std::int64_t steps_a_graph = 64;

  std::size_t bodies() const { return layout_.particles() + walls; }

  void require_memory(std::size_t needed) const {
    std::size_t free = 0, total = 0;
    check_cuda(cudaMemGetInfo(&free, &total), "memory");
    if (needed <= free) return;
    const auto mib = [](std::size_t bytes) { return std::to_string((bytes >> 20) + 1) + " MiB"; };
    throw RunError("CUDA: the scene of " + std::to_string(layout_.particles()) + " particles and " +
                   std::to_string(network_.contacts.size()) + " contacts needs another " + mib(needed) +
                   " on the device: found " + mib(free) + " free of " + mib(total));
  }

  template <class LawStep, int Units, ContactForm form, Geometry geometry>
  void add_to_tiles(const ContactArrays<P>& arrays, const ContactForces<P, LawStep, Units, form, geometry>& forces) {
    if constexpr (form == ContactForm::condensed) {
      tiles_->template add_group<geometry>(groups_, arrays, forces.view, dt_);
    }
  }

  std::vector<R> sums(std::int32_t first, std::size_t count) const {
    DeviceArray<R> out(count * velocity_words);
    launch("sums", sum_loads<R, G>, count, body_threads, 0, stream_, records(), out.data(),
           static_cast<std::uint32_t>(first));
    check_cuda(cudaStreamSynchronize(stream_), "sums");
    return out.download();
  }
  std::vector<R> tile_forces(std::int32_t first, std::size_t count) const {
    std::vector<R> out(count * velocity_words);
    check_cuda(cudaMemcpyAsync(out.data(), tiles_->forces() + static_cast<std::size_t>(first) * velocity_words,
                               out.size() * sizeof(R), cudaMemcpyDeviceToHost, stream_),
               "sums");
    check_cuda(cudaStreamSynchronize(stream_), "sums");
    return out;
  }

  template <class F>
  cudaGraphExec_t record(F&& f) {
    cudaGraph_t graph = nullptr;
    cudaGraphExec_t out = nullptr;
    check_cuda(cudaStreamBeginCapture(stream_, cudaStreamCaptureModeThreadLocal), "graph");
    f();
    check_cuda(cudaStreamEndCapture(stream_, &graph), "graph");
    check_cuda(cudaGraphInstantiate(&out, graph, 0), "graph");
    check_cuda(cudaGraphDestroy(graph), "graph");
    return out;
  }

  /// Gives every end of a contact its record.
  void make_rows(const ContactNetwork& network) {
    std::vector<std::uint32_t> begin(bodies() + 1, 0), place;
    const auto for_each_slot = [&](auto&& f) {
      for (const auto& group : layout_.groups) {
        for (const std::uint32_t c : group.contact) f(c);
      }
    };
    const auto body_of = [&](std::int32_t end) { return static_cast<std::size_t>(layout_.body_of(end)); };
    for_each_slot([&](std::uint32_t c) {
      if (c == inert) return;
      ++begin[body_of(network.contacts[c].a) + 1];
      ++begin[body_of(network.contacts[c].b) + 1];
    });
    std::vector<std::uint32_t> long_body;
    for (std::size_t i = 0; i < bodies(); ++i) {
      if (begin[i + 1] > long_row && i < layout_.particles()) long_body.push_back(static_cast<std::uint32_t>(i));
      begin[i + 1] += begin[i];
    }
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    for_each_slot([&](std::uint32_t c) {
      place.push_back(c == inert ? UINT32_MAX : next[body_of(network.contacts[c].a)]++);
      place.push_back(c == inert ? UINT32_MAX : next[body_of(network.contacts[c].b)]++);
    });
    row_begin_ = DeviceArray<std::uint32_t>::of(begin);
    place_ = DeviceArray<std::uint32_t>::of(place);
    long_body_ = DeviceArray<std::uint32_t>::of(long_body);
    record_count_ = begin.back();
    row_lengths_ = begin;
  }

  LoadRecords<G> records() const { return {records_.data(), row_begin_.data(), place_.data()}; }
  G* gathered() const {
    if constexpr (std::is_same_v<G, R>)
      return master_.data();
    else
      return velocity_.data();
  }

  /// Nothing in double precision, which takes no blocks.
  struct NoTiles {
    void run(std::int64_t, std::int64_t) {}
    template <class... Any>
    void prepare(Any&&...) {}
    template <Geometry, class... Any>
    void add_group(Any&&...) {}
    const R* forces() const { return nullptr; }
    std::string description() const { return ""; }
    std::vector<KernelUse> kernels() const { return {}; }
    void add_states(StateList&) {}
    std::size_t bytes_to_come(std::size_t) const { return 0; }
    std::int64_t bytes() const { return 0; }
    std::int64_t traffic() const { return 0; }
  };

  const ContactNetwork& network_;  // until prepare()
  const Layout& layout_;
  double dt_ = 0;
  std::size_t record_count_ = 0;
  std::vector<std::uint32_t> row_lengths_;
  std::unique_ptr<std::conditional_t<blocks, TileRunner<P>, NoTiles>> tiles_;
  cudaStream_t stream_ = nullptr;
  cudaGraphExec_t many_ = nullptr, one_ = nullptr;
  DeviceArray<R> master_, inverse_;
  DeviceArray<double> displacement_;
  DeviceArray<G> velocity_, records_;
  DeviceArray<std::uint32_t> row_begin_, place_, long_body_;
  DeviceArray<std::int64_t> step_;
  mutable std::unique_ptr<DivergenceSearch<P>> divergence_;  // made when first asked
  DeviceStore store_;
  StateList states_;
  ContactLaunches<P> contacts_;
  int groups_ = 0;
  std::uint32_t slots_ = 0;
  std::int64_t bytes_ = 0, state_bytes_ = 0;  // of the groups; states are what a step writes
};

}  // namespace macadam::kernels
