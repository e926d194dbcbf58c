// SPDX-License-Identifier: GPL-3.0-or-later
/// \file exec_cuda.hpp  Defines the executor for CUDA devices with two kernels per step, for any contact form, law and
/// precision. Many steps are enqueued as one graph.
///
/// step_bodies (step_bodies.hpp) sums the loads of each body and moves it; step_contacts (step_contacts.hpp) steps each
/// contact. A contact writes the loads on its two bodies to records of its own. The records of a body are consecutive,
/// and the body sums them in fixed order. No floating-point atomics are used, so the same device gives the same bits in
/// every run.
#pragma once

#include <algorithm>

#include "kernels/cuda/common/body_arrays.hpp"
#include "kernels/cuda/two_kernels/step_bodies.hpp"
#include "kernels/cuda/two_kernels/step_contacts.hpp"

namespace macadam::kernels {

/// Executor for CUDA devices with precision P and a list of laws; see executor.hpp for its functions.
template <class P, class Laws>
class ExecCuda : public CudaBodyArrays<P> {
  using Base = CudaBodyArrays<P>;

 public:
  using AnyLaw = Laws;
  using R = typename P::Particle;
  using G = typename P::Geometry;
  /// ContactForces is compiled for exactly three and for up to five Kelvin units. Both versions keep the states of the
  /// units in registers. A third version, for any number of units, does not.
  static constexpr bool five_units_in_registers = true;

  using Plan = LayoutPlan;
  /// The size of the tiles (1024 contacts) does not depend on the device, because it determines the layout, and loads
  /// are summed in the order of the layout.
  static std::optional<Plan> plan(const Specimen& specimen, const ContactNetwork& network, const StepperOptions&) {
    return Plan{make_layout(specimen, network, Base::lanes, {1024})};
  }

  ExecCuda(const ContactNetwork& network, const Plan& plan, const StepperOptions& options)
      : Base(network, plan.layout, options, RecordOrder::as_written),
        step_(1),
        wall_row_(walls * WallMotion<R>::words),
        wall_loads_(walls * velocity_words) {}
  ~ExecCuda() {
    this->end_steps();
    forget_graphs();
  }

  bool can_restart_with(const ExecStart&) const { return true; }

  void begin(const ExecStart& start) {
    forget_graphs();
    this->rest();
    contacts_ = std::vector<ContactLaunches<P, AnyLaw>>(this->team_.size());
    slots_ = 0;
    if (!start.first) return records_.clear();
    this->require_memory(start.group_bytes + this->lists_.records * record_words * sizeof(G));
    records_ = DeviceArray<G>(this->lists_.shares, record_words);
  }

  template <class L, class Forces>
  void set_group(std::size_t number, bool first, const L&, ContactArrays<P> arrays, Forces forces) {
    forces.view = this->take_group(number, first, arrays);
    const GroupLayout& group = this->layout_.groups[number];
    this->team_.each([&](std::size_t m) {
      contacts_[m].add(forces, slots_, static_cast<std::uint32_t>(this->cuts_.slot(group, m)),
                       static_cast<std::uint32_t>(this->cuts_.slot(group, m + 1)), has_series());
    });
    slots_ += static_cast<std::uint32_t>(group.contact.size());
  }

  void prepare(const ParticleMotion<P>& motion) {
    motion_ = motion;
    if (this->crossing_ && !std::exchange(crosses_, true)) {
      moved_.add(this->gathered(), velocity_words, this->crossing_->bodies);
      moved_.add(this->displacement_.data(), displacement_words, this->crossing_->bodies);
      loads_.add(records_.data(), record_words, this->crossing_->records);
      moved_.make_ready(this->team_);
      loads_.make_ready(this->team_);
    }
    clock_ = {};
    if (motion.wall.driven > 0)
      clock_ = {step_.data(), motion.wall.table, wall_row_.data(), static_cast<unsigned>(motion.wall.row_words())};
    motion_.wall.table = wall_row_.data();
    this->add_body_states();
    add_device_state(this->states_, "loads", "N, N m", records_.data(), records_.size(),
                     [this] { return this->lists_.state_order(this->layout_); });
  }

  /// Enqueues steps. `row`: row of the walls' table for the first step.
  void run(std::int64_t, std::int64_t steps, std::int64_t row) {
    const Range range("time steps");
    this->team_.join_streams();  // the start may have written to memory on other streams
    if (clock_.step) launch("walls", start_clock<R>, 1, 32, 0, this->team_.stream(), clock_, row);
    this->team_.join_streams();
    const Ranks* ranks = this->team_.ranks();
    if (waits_for_launches() || this->parts_.runs() || (ranks && !ranks->goes_into_graphs())) {
      for (; steps > 0; --steps) step();
    }
    const auto queue = [&](cudaGraphExec_t& graph, std::int64_t n) {
      if (!graph) {
        graph = this->team_.record([&] {
          for (std::int64_t k = 0; k < n; ++k) step();
        });
      }
      check_cuda(cudaGraphLaunch(graph, this->team_.stream()), "time steps");
      steps -= n;
    };
    while (steps >= steps_per_graph) queue(many_, steps_per_graph);
    while (steps > 0) queue(one_, 1);
  }

  /// Returns how many samples can be taken before the host reads them; 0 with several devices or ranks. `radius` in
  /// specimen order [m].
  std::size_t max_samples(const std::vector<double>& radius) {
    if (this->team_.ranks() || this->team_.size() > 1) return 0;
    this->require_divergence_search(radius);
    return samples_per_read;
  }
  /// Enqueues sample number `k` behind the enqueued steps.
  void take_sample(std::size_t k) {
    const cudaStream_t stream = this->team_.stream();
    launch("sums", sum_loads<R, G>, walls, body_threads, 0, stream, records(), wall_loads_.data(),
           static_cast<std::uint32_t>(this->layout_.particles()));
    this->queue_sample(samples_, k, motion_.dt, wall_loads_.data());
  }
  /// Waits for all steps and returns the first `number` samples.
  std::vector<WallSample<R>> wait_for_samples(std::size_t number) {
    samples_.read(number, this->team_.stream());
    this->wait();
    return Base::wall_samples(samples_, number);
  }

  std::vector<Twist<R>> forces(std::int32_t first, std::size_t count) const {
    DeviceArray<R> out(count * velocity_words);
    launch("sums", sum_loads<R, G>, count, body_threads, 0, this->team_.stream(), records(), out.data(),
           static_cast<std::uint32_t>(first));
    if (static_cast<std::size_t>(first) == this->layout_.particles()) this->of_last(out.data(), out.size());
    check_cuda(cudaStreamSynchronize(this->team_.stream()), "sums");
    return Base::twists(out.download());
  }
  bool forces_with_weight() const { return false; }
  void gather() const {
    if (!this->team_.ranks()) return;
    Base::gather();
    queue_whole(this->team_, records_.data(), record_words, [this](std::size_t m) { return this->lists_.cut[m]; });
    this->wait();
  }

  std::string description() const {
    return this->described(has_series() && this->team_.ranks()
                               ? "two kernels a step, because tiles of several ranks cannot step rock in series"
                               : "two kernels a step");
  }
  std::vector<KernelUse> kernels() const {
    std::vector<KernelUse> out = contacts_.front().kernels();
    out.push_back(kernel_use("bodies", step_bodies<P, false>, body_threads, 0));
    return out;
  }
  std::int64_t traffic() const {
    return this->group_bytes_ + this->state_bytes_ + this->body_traffic() +
           static_cast<std::int64_t>(2 * records_.bytes() + this->lists_.place.bytes());
  }
  Traffic traffic_by_place() const { return {traffic(), 0, 0}; }
  std::int64_t bytes() const {
    return this->held_bytes() + samples_.bytes() + static_cast<std::int64_t>(records_.bytes());
  }

 private:
  /// Returns whether some contact has rock in series.
  bool has_series() const {
    return std::ranges::any_of(this->layout_.groups, [](const GroupLayout& g) { return g.series; });
  }
  /// Takes one step: Eq. 1–2 for every body, then Eq. 3–17 for every contact.
  void step() {
    const bool has_external_loads = motion_.wall.by_force || motion_.body.weight;
    const auto& team = this->team_;
    team.each([&](std::size_t m) {
      const auto [long_body, long_lists] = this->lists_.long_lists(m, has_external_loads);
      const std::size_t first = this->cuts_.body(m), end = this->cuts_.body(m + 1);
      launch("bodies", has_external_loads ? step_bodies<P, true> : step_bodies<P, false>,
             long_lists + (end - first + bodies_a_block - 1) / bodies_a_block, body_threads, 0, team.stream(m), motion_,
             records(), long_body, long_lists, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(end));
    });
    team.join_streams();
    this->parts_.end_of("bodies", team.stream());
    send(moved_);
    team.each([&](std::size_t m) {
      contacts_[m].run(team.stream(m), {this->gathered(), this->displacement_.data()}, records(),
                       m == team.first() ? clock_ : WallClock<R>{});
    });
    team.join_streams();
    this->parts_.end_of("contacts", team.stream());
    send(loads_);
  }
  /// Sends messages between ranks; does nothing with one process.
  void send(const RankExchange& messages) {
    if (!this->team_.ranks()) return;
    messages.queue(this->team_);
    this->parts_.end_of("messages", this->team_.stream());
  }

  void forget_graphs() {
    for (auto* graph : {&many_, &one_}) {
      if (*graph) cudaGraphExecDestroy(*graph);
      *graph = nullptr;
    }
  }
  LoadRecords<G> records() const { return {records_.data(), this->lists_.begin.data(), this->lists_.place.data()}; }

  ParticleMotion<P> motion_{};
  cudaGraphExec_t many_ = nullptr, one_ = nullptr;
  DeviceArray<G> records_;
  DeviceArray<std::int64_t> step_;
  DeviceArray<R> wall_row_;  // row of the current step
  WallClock<R> clock_;
  DeviceArray<R> wall_loads_;  // of the sample that is taken
  DeviceSamples<R> samples_;
  std::vector<ContactLaunches<P, AnyLaw>> contacts_;  // [member]
  std::uint32_t slots_ = 0;                           // number of slots of the groups set so far
  bool crosses_ = false;
  // With several ranks: moved_ is sent after the bodies have moved, loads_ after the contacts were stepped
  RankExchange moved_, loads_;
};

}  // namespace macadam::kernels
