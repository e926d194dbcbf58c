// SPDX-License-Identifier: GPL-3.0-or-later
/// \file exec_cpu.hpp  Defines the executor on the CPU, which owns the arrays and runs the steps. A packet of contacts
/// is stepped in SIMD registers; tiles (parts of the specimen) are divided among threads.
#pragma once

#include <omp.h>

#include <algorithm>
#include <memory>

#include "kernels/base/barrier.hpp"
#include "kernels/contact/contact_readout.hpp"
#include "kernels/cpu/cpu_blocks.hpp"
#include "kernels/step/executor.hpp"
#include "kernels/cpu/subnormals.hpp"
#include "kernels/cpu/thread_choice.hpp"
#include "kernels/cpu/tile_accumulators.hpp"

namespace macadam::kernels {

/// Owns the arrays of a specimen in precision P and runs steps over them. `width`: contacts per packet, 4 or 8; results
/// do not depend on it. The loops over bodies and contacts are inlined completely (`flatten`). gcc represents a packet
/// that is wider than a register (in mixed precision without AVX-512, in double without AVX) as a tuple. Without
/// `flatten`, the many small functions of this tuple would become calls, and steps would be up to four times slower.
template <class P, class Laws, std::size_t width = packet_width<P>>
class ExecCpu : public NoSamples<typename P::Particle> {
 public:
  using Policy = P;
  using AnyLaw = Laws;
  using R = typename P::Particle;
  using Item = PackItem<width>;
  static constexpr int lanes = static_cast<int>(Item::lanes());
  static constexpr bool five_units_in_registers = false;

  using Plan = LayoutPlan;
  static std::optional<Plan> plan(const Specimen& specimen, const ContactNetwork& network, const StepperOptions&) {
    // The states of 1024 contacts (200 kB with three Kelvin units in double precision) fit the L2 cache of a core
    return Plan{make_layout(specimen, network, lanes, {1024})};
  }

  ExecCpu(const ContactNetwork& network, const Plan& plan, const StepperOptions& options)
      : layout_(plan.layout),
        accumulators_(network, layout_),
        groups_(layout_.groups.size()),
        blocks_(layout_, accumulators_),
        threads_(
            std::min(options.threads > 0 ? options.threads : omp_get_max_threads(), static_cast<int>(layout_.tiles()))),
        choice_(threads_, options.threads > 0) {}

  bool can_restart_with(const ExecStart&) const { return true; }

  void begin(const ExecStart& start) {
    const std::size_t bodies = layout_.particles() + walls;
    states_.clear();
    sums_.assign(accumulators_.size() * velocity_words, R(0));
    master_.assign(bodies * velocity_words, R(0));
    displacement_.assign(bodies * displacement_words, 0.0);
    if constexpr (!std::is_same_v<typename P::Geometry, R>) velocity_.assign(bodies * velocity_words, 0);
    states_.add("sums", "N, N m", sums_);  // not reordered, because the tiles are the same on all CPUs
    const auto by_body = [this] { return body_order(layout_, velocity_words); };
    states_.add("velocity", "m/s, rad/s", master_, by_body);
    states_.add("displacement", "m, rad", displacement_, by_body);
    states_.add("gathered_velocity", "m/s, rad/s", velocity_, by_body);
    blocks_.begin(start);
    blocks_.add_states(states_);
  }

  BodyView<P> set_bodies(std::vector<R> inverse, std::vector<R> weight) {
    inverse_ = std::move(inverse);
    weight_ = std::move(weight);
    return {gathered(),
            master_.data(),
            displacement_.data(),
            inverse_.data(),
            weight_.empty() ? nullptr : weight_.data(),
            static_cast<std::int32_t>(layout_.particles())};
  }

  const R* wall_table(std::size_t most_values) {
    wall_table_.resize(most_values);
    return wall_table_.data();
  }
  void set_wall_rows(const std::vector<R>& rows) { std::copy(rows.begin(), rows.end(), wall_table_.begin()); }

  template <class L, class Forces>
  void set_group(std::size_t number, bool first, const L& law, ContactArrays<P> arrays, const Forces& forces) {
    using Group = CpuGroupOf<P, width, L, Forces>;
    auto& group = groups_[number];
    if (first) {
      group = std::make_unique<Group>();
      group->layout = &layout_.groups[number];
      group->end_a = accumulators_.end_a[number].data();
      group->end_b = accumulators_.end_b[number].data();
      group->arrays = std::move(arrays);
    } else {
      std::swap(group->arrays.chain, arrays.chain);
      std::swap(group->arrays.frame, arrays.frame);
    }
    auto& all = static_cast<Group&>(*group);  // law, form and geometry are of the same types as at the first start
    auto& own = all.forces;
    own = forces;
    all.law = law;
    own.view = group->arrays.shape;
    group->arrays.for_each_array(own.view, [&](auto name, auto unit, auto& array, auto& pointer) {
      constexpr bool state = !std::is_const_v<std::remove_pointer_t<std::decay_t<decltype(pointer)>>>;
      pointer = array.data();
      const GroupLayout& of = layout_.groups[number];
      if constexpr (state)
        states_.add(std::string(name) + "_" + to_string(of.pair), unit, array,
                    state_order(layout_, of, own.view, &pointer == &own.view.chain));
    });
    blocks_.use(*group, number, states_);
  }

  void prepare(const ParticleMotion<P>& motion) { motion_ = motion; }

  /// Takes all steps, in pieces; the number of threads is chosen for each piece.
  void run(std::int64_t first, std::int64_t steps, std::int64_t) {
    for (std::int64_t row = 0; row < steps;) {
      const ThreadChoice::Next next = choice_.next();
      const std::int64_t n =
          blocks_.next(first + row, std::min(steps - row, next.steps), groups_, displacement_, next.threads);
      const double start = omp_get_wtime();
      run_rows(next.threads, row, row + n);
      choice_.took(n, omp_get_wtime() - start);
      row += n;
    }
  }
  void wait() const {}
  void gather() const {}
  void end_steps() noexcept {}
  void use_device() const {}

 private:
  /// Computes the part of a step that belongs to one thread.
  struct Team {
    ExecCpu& exec;
    std::size_t thread, threads;
    Barrier& barrier;

    /// Moves all bodies by the loads that the last call of contacts() has summed. k: row of the walls' table.
    [[gnu::flatten]] void bodies(const ParticleMotion<P>& motion, std::int64_t k) const {
      for_own_tiles([&](std::size_t tile) {
        std::uint32_t own = exec.accumulators_.tile_begin[tile];
        for (auto i = exec.layout_.tile_body[tile]; i < exec.layout_.tile_body[tile + 1]; ++i) {
          motion(i, exec.sum(i, own++), k);
        }
      });
      if (thread == 0) {
        for (auto i = motion.body.particles; i < motion.body.particles + walls; ++i)
          motion(i, motion.wall.by_force ? exec.sum(i, none) : Twist<R>{}, k);
      }
      barrier.wait();
    }

    /// Steps all contacts and adds up their loads.
    void contacts() const {
      const MotionView<P> motion{exec.gathered(), exec.displacement_.data()};
      for_own_tiles([&](std::size_t tile) {
        const auto *begin = exec.accumulators_.tile_begin.data() + tile, *end = begin + 1;
        exec.blocks_.begin_sums(*begin * velocity_words, *end * velocity_words, exec.sums_);
        for (const auto& group : exec.groups_)
          group->run(group->layout->tile_packet[tile], group->layout->tile_packet[tile + 1], motion, exec.sums_.data());
      });
      barrier.wait();
    }

   private:
    template <class F>
    void for_own_tiles(F&& f) const {
      const std::size_t tiles = exec.layout_.tiles();
      for (std::size_t tile = tiles * thread / threads; tile < tiles * (thread + 1) / threads; ++tile) f(tile);
    }
  };

 public:
  /// Returns the current force and moment on the bodies first … first + count − 1.
  std::vector<Twist<R>> forces(std::int32_t first, std::size_t count) const {
    std::vector<Twist<R>> out;
    std::size_t tile = 0;
    for (std::int32_t body = first; out.size() < count; ++body) {
      while (tile < layout_.tiles() && body >= layout_.tile_body[tile + 1]) ++tile;
      out.push_back(
          tile == layout_.tiles()
              ? sum(body, none)
              : sum(body, accumulators_.tile_begin[tile] + static_cast<std::uint32_t>(body - layout_.tile_body[tile])));
    }
    return out;
  }

  /// The next functions return copies of the bodies' arrays, or replace the contents of these arrays.
  std::vector<R> velocities() const { return {master_.begin(), master_.end()}; }
  std::vector<double> displacements() const { return {displacement_.begin(), displacement_.end()}; }
  std::vector<double> wall_displacements() const {
    return {displacement_.end() - walls * displacement_words, displacement_.end()};
  }
  std::vector<R> wall_velocities() const { return {master_.end() - walls * velocity_words, master_.end()}; }
  void set_displacements(const std::vector<double>& u) { std::copy(u.begin(), u.end(), displacement_.begin()); }
  void set_velocities(const std::vector<R>& v) {
    std::copy(v.begin(), v.end(), master_.begin());
    if constexpr (!std::is_same_v<typename P::Geometry, R>) {
      std::transform(v.begin(), v.end(), velocity_.begin(), [](R x) { return static_cast<typename P::Geometry>(x); });
    }
  }

  bool forces_with_weight() const { return false; }

  std::int64_t first_divergent(const std::vector<double>& radius, double dt) const {
    std::int64_t first = -1;
    for (std::size_t b = 0; b < layout_.particles(); ++b) {
      const auto i = static_cast<std::int64_t>(layout_.particle[b]);
      const R* w = &master_[b * velocity_words];
      const double travel = dt * std::sqrt(double(w[0]) * w[0] + double(w[1]) * w[1] + double(w[2]) * w[2]);
      const double turn = dt * std::sqrt(double(w[4]) * w[4] + double(w[5]) * w[5] + double(w[6]) * w[6]);
      // written so that a NaN makes `sensible` false
      const bool sensible = travel <= radius[static_cast<std::size_t>(i)] && turn <= 1.0;
      if (!sensible && (first < 0 || i < first)) first = i;
    }
    return first;
  }

  GroupState<P> group_state(std::size_t number, std::size_t, std::size_t) const {
    const CpuGroup<P, width>& group = *groups_[number];
    const ContactArrays<P>& arrays = group.arrays;
    return {{arrays.chain.data(), arrays.chain.size()}, {arrays.frame.data(), arrays.frame.size()}, group.changes()};
  }
  DeviceMotion device_motion() const { return {}; }

  const StateList& states() const { return states_; }

  std::string description() const {
    return "cpu, " + std::to_string(threads_) + (threads_ == 1 ? " thread" : " threads");
  }
  std::vector<KernelUse> kernels() const { return {}; }
  std::int64_t traffic() const {
    std::int64_t out = 0;
    for (const auto& group : groups_) out += group->step_bytes();
    return out + body_bytes() + blocks_.step_bytes();
  }
  Traffic traffic_by_place() const { return {traffic(), 0, 0}; }

  void start_clock() { bodies_time_ = contacts_time_ = 0, timed_ = true; }
  std::vector<PartTime> stop_clock() {
    timed_ = false;
    return {{"bodies", bodies_time_}, {"contacts", contacts_time_}};
  }
  std::int64_t bytes() const {
    std::int64_t out = 0;
    for (const auto& group : groups_) out += group->bytes();
    return out + body_bytes() + blocks_.bytes();
  }

 private:
  /// Bytes of the bodies, which a step reads or writes once.
  std::int64_t body_bytes() const {
    const std::size_t words = sums_.size() + master_.size() + inverse_.size() + weight_.size() + wall_table_.size();
    return static_cast<std::int64_t>(words * sizeof(R) + displacement_.size() * sizeof(double) +
                                     velocity_.size() * sizeof(typename P::Geometry));
  }

  /// Takes the steps of rows first … end − 1 of the walls' table: Eq. 1–2 for every body, then Eq. 3–17 for every
  /// contact.
  void run_rows(int threads, std::int64_t first, std::int64_t end) {
    Barrier barrier;
#pragma omp parallel num_threads(threads)
    {
#pragma omp single  // OpenMP may give fewer threads than requested
      barrier.set_threads(static_cast<unsigned>(omp_get_num_threads()));
      const SubnormalsAreZero<sizeof(typename P::Geometry) == sizeof(float)> while_stepping;
      const Team team{*this, static_cast<std::size_t>(omp_get_thread_num()),
                      static_cast<std::size_t>(omp_get_num_threads()), barrier};
      const bool times = timed_ && team.thread == 0;
      for (std::int64_t row = first; row < end; ++row) {
        const double begin = times ? omp_get_wtime() : 0;
        team.bodies(motion_, row);
        const double between = times ? omp_get_wtime() : 0;
        team.contacts();
        if (times) bodies_time_ += between - begin, contacts_time_ += omp_get_wtime() - between;
      }
    }
  }

  /// Returns the load on a body: its own accumulator `own` (`none` for walls) plus the accumulators of its halo row.
  Twist<R> sum(std::int32_t body, std::uint32_t own) const {
    const auto i = static_cast<std::size_t>(body);
    R total[velocity_words] = {};
    auto add = [&](std::uint32_t accumulator) {
      const R* words = sums_.data() + static_cast<std::size_t>(accumulator) * velocity_words;
      for (int w = 0; w < velocity_words; ++w) total[w] += words[w];
    };
    if (own != none) add(own);
    for (auto r = accumulators_.row_begin[i]; r < accumulators_.row_begin[i + 1]; ++r) add(accumulators_.row[r]);
    return {{total[0], total[1], total[2]}, {total[4], total[5], total[6]}};
  }
  typename P::Geometry* gathered() {
    if constexpr (std::is_same_v<typename P::Geometry, R>)
      return master_.data();
    else
      return velocity_.data();
  }

  static constexpr std::uint32_t none = UINT32_MAX;

  const Layout& layout_;
  TileAccumulators accumulators_;
  std::vector<std::unique_ptr<CpuGroup<P, width>>> groups_;
  CpuBlocks<P, width> blocks_;
  AlignedVector<R> sums_, master_;                // [accumulator][8], [body][8]
  AlignedVector<double> displacement_;            // [body][8]
  AlignedVector<typename P::Geometry> velocity_;  // [body][8], only if Geometry is not Particle
  ParticleMotion<P> motion_{};
  std::vector<R> inverse_, weight_, wall_table_;
  StateList states_;
  int threads_;
  ThreadChoice choice_;
  bool timed_ = false;
  double bodies_time_ = 0,
         contacts_time_ = 0;  // time of the first thread in each part of a step, with waits [s]
};

}  // namespace macadam::kernels
