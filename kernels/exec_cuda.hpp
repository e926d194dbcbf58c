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
#include "kernels/cuda_record_rows.hpp"
#include "kernels/cuda_tile_runner.hpp"
#include "kernels/cuda_wall_table.hpp"
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
  static std::size_t tile_contacts_of(const ContactNetwork& network, const StepperOptions& options) {
    check_cuda(cudaSetDevice(options.device.value()), "device");
    const DeviceLimits limits = DeviceLimits::query();
    const auto chips = static_cast<std::size_t>(limits.multiprocessors),
               shared = static_cast<std::size_t>(limits.shared);
    const std::size_t contacts = network.contacts.size();
    if (contacts > shared / 75 * chips) return std::min<std::size_t>(1000, shared / 100);
    return std::max<std::size_t>(128, contacts / (chips + 1) + 1);
  }

  /// Takes what the options leave to every start: the device.
  ExecCuda(const ContactNetwork& network, const Layout& layout, const StepperOptions& options)
      : device_(options.device.value()),
        network_(&network),
        layout_(layout),
        views_(layout.groups.size()),
        rows_(network, layout),
        master_(bodies() * velocity_words),
        displacement_(bodies() * displacement_words),
        velocity_(std::is_same_v<G, R> ? 0 : bodies() * velocity_words),
        step_(1) {
    check_cuda(cudaStreamCreate(&stream_), "stream");
  }
  ExecCuda(const ExecCuda&) = delete;
  ~ExecCuda() {
    forget_graphs();
    cudaStreamDestroy(stream_);
  }

  /// Makes the stepper's device the calling thread's; that it answers is known by then.
  void use_device() const { cudaSetDevice(device_); }

  /// Whether groups once taken may be stepped with these options: in blocks or not, as before.
  bool suits(const StepperOptions& options, const std::array<std::optional<Law>, pair_types>& laws,
             double height) const {
    return (block_of(options, laws, height) > 0) == in_blocks_;
  }

  /// Puts all bodies at rest.
  void begin() {
    forget_graphs();
    states_.clear();
    contacts_ = {};
    slots_ = 0;
    master_.clear();
    displacement_.clear();
    velocity_.clear();
    records_.clear();
  }

  /// Decides, the first time, whether steps are taken in blocks. `height`: of the specimen [m]; `group_bytes`: of the
  /// groups to come. \throws RunError where the device has not enough memory for all that is to come.
  void set_options(const StepperOptions& options, const std::array<std::optional<Law>, pair_types>& laws, double height,
                   bool first, std::size_t group_bytes) {
    dt_ = options.dt;
    const int block = block_of(options, laws, height);
    in_blocks_ = block > 0;
    if constexpr (blocks) {
      if (first && in_blocks_) tiles_ = std::make_unique<TileRunner<P>>(*network_, layout_, options, stream_);
      if (tiles_ && !tiles_->possible()) tiles_.reset();
    }
    if (tiles_) tiles_->begin(block, options.observed_every > 0);
    if (!first) return;
    network_ = nullptr;
    const std::size_t records = rows_.records * record_words * sizeof(G);
    require_memory(group_bytes + (tiles_ ? tiles_->bytes_to_come(rows_.records) : records));
    if (!tiles_) records_ = DeviceArray<G>(rows_.records * record_words);
  }

  BodyView<P> set_bodies(const std::vector<R>& inverse, const std::vector<R>& weight) {
    if (inverse_.size() == 0) inverse_ = DeviceArray<R>(inverse.size());
    inverse_.upload(inverse.data());
    weight_ = DeviceArray<R>::of(weight);
    return {gathered(),
            master_.data(),
            displacement_.data(),
            inverse_.data(),
            weight.empty() ? nullptr : weight_.data(),
            static_cast<std::int32_t>(layout_.particles())};
  }

  /// Where the table of the walls will be; then its rows.
  const double* wall_table(std::size_t most_values) { return wall_rows_.prepare(most_values); }
  void set_wall_rows(const std::vector<double>& rows) { wall_rows_.put(rows, stream_); }

  /// Takes group `number` for good, the first time, or its states alone; and the functor that steps its contacts.
  template <class Forces>
  void set_group(std::size_t number, bool first, ContactArrays<P> arrays, Forces forces) {
    const auto& group = layout_.groups[number];
    const auto slots = static_cast<std::uint32_t>(group.contact.size());
    forces.view = first ? arrays.shape : views_[number];
    arrays.for_each_array(forces.view, [&](auto name, auto unit, auto& array, auto& pointer) {
      constexpr bool state = !std::is_const_v<std::remove_pointer_t<std::decay_t<decltype(pointer)>>>;
      const auto size = static_cast<std::int64_t>(array.size() * sizeof(array[0]));
      if (first) {
        pointer = store_.keep(array);
        bytes_ += size;
        if (state) state_bytes_ += size;
      }
      if constexpr (state) {
        if (!first && size > 0) {
          check_cuda(cudaMemcpy(pointer, array.data(), static_cast<std::size_t>(size), cudaMemcpyHostToDevice),
                     "states of the start");
        }
        add_device_state(states_, std::string(name) + "_" + to_string(group.pair), unit, pointer, array.size());
      }
    });
    views_[number] = forces.view;
    if (tiles_)
      add_to_tiles(static_cast<int>(number), first, arrays, forces);
    else
      contacts_.add(forces, slots_, slots);
    slots_ += slots;
  }

  /// Ends the set-up.
  void prepare(const ParticleMotion<P>& motion) {
    if (tiles_) tiles_->prepare(motion, rows_);
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
    const std::size_t blocks = rows_.long_particle.size() + (bodies() + bodies_a_block - 1) / bodies_a_block;
    launch("bodies", step_bodies<P>, blocks, body_threads, 0, stream_, motion, records(), rows_.long_particle.data(),
           static_cast<std::uint32_t>(rows_.long_particle.size()), step_.data());
  }
  void contacts() { contacts_.run(stream_, {gathered(), displacement_.data()}, records(), step_.data()); }

  /// Queues all steps, as graphs of many. The row of the walls' table is counted on the device.
  template <class F>
  void repeat(std::int64_t first, std::int64_t steps, F&& f) {
    if (tiles_) {
      tiles_->run(first, steps);
      return;
    }
    check_cuda(cudaMemsetAsync(step_.data(), 0, sizeof(std::int64_t), stream_), "time steps");
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
  }
  /// Waits until all steps are taken: a failing kernel is reported here.
  void wait() const { check_cuda(cudaStreamSynchronize(stream_), "time steps"); }
  /// Whether forces() has the body forces in it.
  bool forces_with_weight() const { return static_cast<bool>(tiles_); }

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
  std::vector<double> wall_displacements() const {
    std::vector<double> out(walls * displacement_words);
    check_cuda(cudaMemcpy(out.data(), displacement_.data() + layout_.particles() * displacement_words,
                          out.size() * sizeof(double), cudaMemcpyDeviceToHost),
               "walls");
    return out;
  }
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
    check_cuda(cudaGetDeviceProperties(&properties, device_), "device properties");
    return "cuda" + (device_ > 0 ? " device " + std::to_string(device_) : "") + ", " + properties.name + ", " +
           (tiles_ ? tiles_->description() : "two kernels a step");
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
    return bytes_ + state_bytes_ + static_cast<std::int64_t>(bodies + 2 * records_.bytes() + rows_.place.bytes());
  }
  /// Everything that a step changes.
  const StateList& states() const { return states_; }

  std::int64_t bytes() const {
    return bytes_ +
           static_cast<std::int64_t>(master_.bytes() + displacement_.bytes() + inverse_.bytes() + velocity_.bytes() +
                                     records_.bytes() + rows_.place.bytes()) +
           (tiles_ ? tiles_->bytes() : 0);
  }

 private:
  static constexpr std::int64_t steps_a_graph = 64;

  std::size_t bodies() const { return layout_.particles() + walls; }

  static int block_of(const StepperOptions& options, const std::array<std::optional<Law>, pair_types>& laws,
                      double height) {
    return blocks && options.form == ContactForm::condensed ? block_steps(options, laws, height) : 0;
  }
  void forget_graphs() {
    for (auto* graph : {&many_, &one_}) {
      if (*graph) cudaGraphExecDestroy(*graph);
      *graph = nullptr;
    }
  }

  void require_memory(std::size_t needed) const {
    std::size_t free = 0, total = 0;
    check_cuda(cudaMemGetInfo(&free, &total), "memory");
    if (needed <= free) return;
    const auto mib = [](std::size_t bytes) { return std::to_string((bytes >> 20) + 1) + " MiB"; };
    throw RunError("CUDA: the scene of " + std::to_string(layout_.particles()) + " particles and " +
                   std::to_string(rows_.records / 2) + " contacts needs another " + mib(needed) +
                   " on the device: found " + mib(free) + " free of " + mib(total));
  }

  template <class LawStep, int Units, ContactForm form, Geometry geometry>
  void add_to_tiles(int number, bool first, const ContactArrays<P>& arrays,
                    const ContactForces<P, LawStep, Units, form, geometry>& forces) {
    if constexpr (form == ContactForm::condensed) {
      if (first) tiles_->add_contacts(number, arrays, forces.view);
      tiles_->template set_group<geometry>(number, arrays.law, forces.view, dt_);
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

  LoadRecords<G> records() const { return {records_.data(), rows_.begin.data(), rows_.place.data()}; }
  G* gathered() const {
    if constexpr (std::is_same_v<G, R>)
      return master_.data();
    else
      return velocity_.data();
  }

  /// Nothing in double precision, which takes no blocks.
  struct NoTiles {
    void run(std::int64_t, std::int64_t) {}
    void begin(int, bool) {}
    template <class... Any>
    void prepare(Any&&...) {}
    template <class... Any>
    void add_contacts(Any&&...) {}
    template <Geometry, class... Any>
    void set_group(Any&&...) {}
    const R* forces() const { return nullptr; }
    std::string description() const { return ""; }
    std::vector<KernelUse> kernels() const { return {}; }
    void add_states(StateList&) {}
    std::size_t bytes_to_come(std::size_t) const { return 0; }
    std::int64_t bytes() const { return 0; }
    std::int64_t traffic() const { return 0; }
  };

  int device_;
  const ContactNetwork* network_;  // until it is known whether steps are taken in blocks
  const Layout& layout_;
  std::vector<ContactView<P>> views_;  // of the groups
  RecordRows rows_;
  bool in_blocks_ = false;  // wanted, whether or not the device can
  double dt_ = 0;
  std::unique_ptr<std::conditional_t<blocks, TileRunner<P>, NoTiles>> tiles_;
  cudaStream_t stream_ = nullptr;
  cudaGraphExec_t many_ = nullptr, one_ = nullptr;
  DeviceArray<R> master_, inverse_, weight_;
  WallRowsOnDevice wall_rows_;
  DeviceArray<double> displacement_;
  DeviceArray<G> velocity_, records_;
  DeviceArray<std::int64_t> step_;
  mutable std::unique_ptr<DivergenceSearch<P>> divergence_;  // made when first asked
  DeviceStore store_;
  StateList states_;
  ContactLaunches<P> contacts_;
  std::uint32_t slots_ = 0;
  std::int64_t bytes_ = 0, state_bytes_ = 0;  // of the groups; states are what a step writes
};

}  // namespace macadam::kernels
