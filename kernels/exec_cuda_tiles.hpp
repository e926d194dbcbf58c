// SPDX-License-Identifier: GPL-3.0-or-later
/// \file exec_cuda_tiles.hpp  Blocks of steps over tiles on a CUDA device: condensed contacts, mixed and single
/// precision, laws that have blocks, walls driven by displacements.
#pragma once

#include <optional>

#include "kernels/block_length.hpp"
#include "kernels/cuda_body_arrays.hpp"
#include "kernels/cuda_run_report.hpp"
#include "kernels/cuda_tile_runner.hpp"

namespace macadam::kernels {

template <class P, class Laws>
class ExecCudaTiles : public CudaBodyArrays<P> {
  using Base = CudaBodyArrays<P>;

 public:
  using AnyLaw = Laws;
  using R = typename P::Particle;
  static constexpr bool room_for_five = true;

  /// A tile a multiprocessor where the scene fits the chip, else tiles so small that two share one.
  static TileSize tile_size(const ContactNetwork& network, const StepperOptions& options) {
    const DeviceTeam team(options.devices, options.ranks);
    const DeviceLimits limits = DeviceLimits::of_each(team, options.multiprocessors);
    auto chips = static_cast<std::size_t>(limits.multiprocessors) * team.size();
    const auto shared = static_cast<std::size_t>(limits.shared);
    const std::size_t contacts = network.contacts.size();
    if (options.side_by_side > 1) {
      // In a part of the chip, only where registers hold all states. Else they would be fetched at every step, and the
      // cache would have to hold those of all that are side by side: three full specimens took 44 us a step each so
      // (H200), and would take 20 us where they take turns.
      const std::size_t part = std::max<std::size_t>(1, chips / static_cast<std::size_t>(options.side_by_side));
      constexpr double computed = 1.3;  // times, a contact: those across the faces of tiles by both sides
      if (computed * static_cast<double>(contacts) <= static_cast<double>(part * contacts_in_registers)) chips = part;
    }
    if (team.ranks() || expected_resident_bytes<P>(network, chips) > shared)
      return {std::min<std::size_t>(1500, shared / 115)};
    return {std::max<std::size_t>(128, contacts / (chips + 1) + 1), true};
  }

  /// Thrown where the device cannot run a scene so; ExecCuda can.
  struct Impossible {};

  /// Steps of a block; 0: not to be stepped so.
  static int block_of(const StepperOptions& options, const FactsTable& laws, const Vec3d& size) {
    return options.form == ContactForm::condensed ? block_steps(options, laws, size) : 0;
  }

  /// \throws Impossible
  ExecCudaTiles(const ContactNetwork& network, const Layout& layout, const StepperOptions& options)
      : Base(network, layout, options, RecordOrder::by_number),
        tiles_(network, layout, options, this->team_, this->cuts_, this->parts_, this->crossing_) {
    if (!tiles_.possible()) throw Impossible{};
  }

  ~ExecCudaTiles() { end_steps(); }

  bool suits(const ExecStart& start) const { return block_of(start.options, start.laws, start.size) > 0; }

  void begin(const ExecStart& start) {
    this->rest();
    report_.forget();
    dt_ = start.options.dt;
    tiles_.begin(block_of(start.options, start.laws, start.size), !blocks_are_exact(start.options.geometry, start.laws),
                 start.options.observed_every > 0);
    if (start.first) this->require_memory(start.group_bytes + tiles_.bytes_to_come(this->rows_.records));
  }

  template <class L, class Forces>
  void set_group(std::size_t number, bool first, const L& law, ContactArrays<P> arrays, const Forces&) {
    const ContactView<P> view = this->take_group(number, first, arrays);
    if constexpr (has_blocks<L> && Forces::form_of == ContactForm::condensed) {
      if (first) tiles_.add_contacts(static_cast<int>(number), arrays, view);
      tiles_.template set_group<Forces::geometry_of>(static_cast<int>(number), law, view, dt_);
    }
  }

  void prepare(const ParticleMotion<P>& motion) {
    tiles_.prepare(motion, this->rows_);
    this->add_body_states();
    tiles_.add_states(this->states_);
  }

  void set_wall_rows(const std::vector<R>& rows) {
    noticed([&] { Base::set_wall_rows(rows); });
  }
  void run(std::int64_t first, std::int64_t steps) {
    noticed([&] { tiles_.run(first, steps); });
  }
  void wait() {
    noticed([&] {
      report_.forget();
      const unsigned asked = queue_report();
      tiles_.end_of_steps();
      Base::wait();
      report_.arrived(asked);
    });
    tiles_.leave_room();
  }
  void end_steps() noexcept {
    if (std::exchange(failed_, false)) tiles_.release();
    Base::end_steps();
    tiles_.leave_room();
  }

  std::vector<Twist<R>> forces(std::int32_t first, std::size_t count) const {
    if (static_cast<std::size_t>(first) == this->layout_.particles() && count == walls) {
      if (const auto* report = report_.find(report_.force))
        return Base::twists({std::begin(report->force), std::end(report->force)});
    }
    std::vector<R> out(count * velocity_words);
    check_cuda(cudaMemcpyAsync(out.data(), tiles_.forces() + static_cast<std::size_t>(first) * velocity_words,
                               out.size() * sizeof(R), cudaMemcpyDeviceToHost, this->team_.stream()),
               "sums");
    check_cuda(cudaStreamSynchronize(this->team_.stream()), "sums");
    return Base::twists(out);
  }
  bool forces_with_weight() const { return true; }
  std::vector<double> wall_displacements() const {
    const auto* report = report_.find(report_.motion);
    if (!report) return Base::wall_displacements();
    return {std::begin(report->displacement), std::end(report->displacement)};
  }
  std::vector<R> wall_velocities() const {
    const auto* report = report_.find(report_.motion);
    if (!report) return Base::wall_velocities();
    return {std::begin(report->velocity), std::end(report->velocity)};
  }
  std::int64_t first_divergent(const std::vector<double>& radius, double dt) const {
    const auto* report = report_.find(report_.divergence);
    return report ? Base::number_or_none(report->divergent[0]) : Base::first_divergent(radius, dt);
  }
  void set_velocities(const std::vector<R>& v) {
    report_.forget();
    Base::set_velocities(v);
  }
  void set_displacements(const std::vector<double>& u) {
    report_.forget();
    Base::set_displacements(u);
  }
  /// Whoever has them may change them.
  const StateList& states() const {
    report_.forget();
    return Base::states();
  }
  void gather() const {
    if (!this->team_.ranks()) return;
    Base::gather();
    tiles_.gather();
    Base::wait();
  }

  GroupState<P> group_state(std::size_t number, std::size_t chain, std::size_t frame) const {
    GroupState<P> out = Base::group_state(number, chain, frame);
    out.change = tiles_.changes(number);
    return out;
  }

  std::string description() const { return this->described(tiles_.description()); }
  std::vector<KernelUse> kernels() const { return tiles_.kernels(); }
  std::int64_t traffic() const { return tiles_.traffic() + this->body_traffic(); }
  Traffic traffic_by_place() const { return tiles_.traffic_by_place(traffic()); }
  std::int64_t bytes() const { return this->held_bytes() + tiles_.bytes(); }

 private:
  /// Queues what was asked for after the last run, of one device; which parts.
  unsigned queue_report() {
    unsigned asked = report_.asked();
    if (!this->divergence_) asked &= ~report_.divergence;  // asked for in vain, as there was no memory for it
    if (this->team_.ranks() || this->team_.size() > 1) return 0;
    using Content = typename RunReport<R>::Content;
    const cudaStream_t stream = this->team_.stream();
    const std::size_t walls_from = this->layout_.particles();
    if (asked & report_.force) report_.copy(&Content::force, tiles_.forces() + walls_from * velocity_words, stream);
    if (asked & report_.motion) {
      report_.copy(&Content::velocity, this->master_.data() + walls_from * velocity_words, stream);
      report_.copy(&Content::displacement, this->displacement_.data() + walls_from * displacement_words, stream);
    }
    if (asked & report_.divergence) {
      this->divergence_->queue(this->master_.data(), dt_, 0, walls_from, stream);
      report_.copy(&Content::divergent, this->divergence_->first(), stream);
    }
    return asked;
  }

  /// f(), whose errors are those of a device.
  template <class F>
  void noticed(F&& f) {
    try {
      f();
    } catch (...) {
      failed_ = true;
      throw;
    }
  }

  double dt_ = 0;
  bool failed_ = false;
  TileRunner<P, AnyLaw> tiles_;
  RunReport<R> report_;
};

}  // namespace macadam::kernels
