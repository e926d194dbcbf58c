// SPDX-License-Identifier: GPL-3.0-or-later
/// \file body_arrays.hpp  Defines the base class of both executors on devices (ExecCuda and ExecCudaTiles take steps on
/// GPUs). It owns the team of devices, the bodies, the walls' table, and the arrays of the groups.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "kernels/contact/contact_readout.hpp"
#include "kernels/cuda/common/crossing_contacts.hpp"
#include "kernels/cuda/common/divergence.hpp"
#include "kernels/cuda/common/host_copy.hpp"
#include "kernels/cuda/device/part_clock.hpp"
#include "kernels/cuda/common/load_record_order.hpp"
#include "kernels/cuda/common/sample_buffer.hpp"
#include "kernels/cuda/multi_gpu/device_team.hpp"
#include "kernels/cuda/device/device_store.hpp"
#include "kernels/cuda/common/wall_table.hpp"
#include "kernels/step/executor.hpp"

namespace macadam::kernels {

/// Owns the arrays that ExecCuda and ExecCudaTiles have in common. P is the precision.
template <class P>
class CudaBodyArrays {
 public:
  using Policy = P;
  using R = typename P::Particle;
  using G = typename P::Geometry;
  static constexpr int lanes = 32;

  CudaBodyArrays(const ContactNetwork& network, const Layout& layout, const StepperOptions& options, RecordOrder order)
      : team_(options.devices, options.ranks),
        layout_(layout),
        cuts_(team_, layout),
        lists_(network, layout, cuts_, order),
        views_(layout.groups.size()),
        master_(cuts_.bodies(), velocity_words),
        displacement_(cuts_.bodies(), displacement_words),
        velocity_(cuts_.bodies(), std::is_same_v<G, R> ? 0 : velocity_words) {
    if (team_.ranks()) crossing_.emplace(team_, network, layout, cuts_, lists_);
  }
  CudaBodyArrays(const CudaBodyArrays&) = delete;

  /// Waits until all queued kernels have ended, also after an error; arrays may then be freed.
  void end_steps() noexcept { team_.wait_for_the_last(); }

  void use_device() const { team_.use(); }

  const R* wall_table(std::size_t most_values) { return wall_rows_.prepare(most_values); }
  /// Enqueues the upload of rows of the walls' table. Every device waits for them.
  void set_wall_rows(const std::vector<R>& rows) {
    team_.join_streams();
    wall_rows_.put(rows, team_);
    team_.join_streams();
  }

  BodyView<P> set_bodies(const std::vector<R>& inverse, const std::vector<R>& weight) {
    if (inverse_.size() == 0) inverse_ = DeviceArray<R>(cuts_.bodies(), 2);
    inverse_.upload(inverse.data());
    Shares particles = cuts_.bodies();
    particles.back().end -= walls;
    weight_ = DeviceArray<R>::of(weight, particles);
    return {gathered(),
            master_.data(),
            displacement_.data(),
            inverse_.data(),
            weight.empty() ? nullptr : weight_.data(),
            static_cast<std::int32_t>(layout_.particles())};
  }

  /// Waits for all steps. An error of a kernel is reported here.
  void wait() const { team_.wait("time steps"); }

  std::vector<R> velocities() const { return master_.download(); }
  std::vector<double> displacements() const { return displacement_.download(); }
  std::vector<double> wall_displacements() const { return of_walls(displacement_.data(), displacement_words); }
  std::vector<R> wall_velocities() const { return of_walls(master_.data(), velocity_words); }
  void set_displacements(const std::vector<double>& u) { displacement_.upload(u.data()); }
  void set_velocities(const std::vector<R>& v) {
    master_.upload(v.data());
    if constexpr (!std::is_same_v<G, R>) {
      const std::vector<G> rounded(v.begin(), v.end());
      velocity_.upload(rounded.data());
    }
  }

  /// With several ranks, completes on every device the arrays that a step changes.
  void gather() const {
    whole_bodies(master_.data(), velocity_words);
    whole_bodies(displacement_.data(), displacement_words);
    whole_bodies(velocity_.data(), velocity_words);
    for (std::size_t g = 0; g < views_.size(); ++g) {
      const GroupLayout& group = layout_.groups[g];
      const auto packet = [&](std::size_t m) { return std::size_t{group.tile_packet[cuts_.tile(m)]}; };
      const auto words = [](int count) { return static_cast<std::size_t>(count) * lanes; };
      const ContactView<P>& view = views_[g];
      const auto row = [&](std::size_t m) {
        return view.by_points ? std::size_t{group.packet_layer[packet(m)]} : packet(m);
      };
      queue_whole(team_, view.chain, words(view.components * (1 + view.units)), row);
      queue_whole(team_, view.frame, words(view.frame_words), packet);
    }
  }

  /// Returns the number (specimen order) of the first particle that moves too far in a step, or −1.
  std::int64_t first_divergent(const std::vector<double>& radius, double dt) const {
    require_divergence_search(radius);
    Ranks* const ranks = team_.ranks();
    const std::size_t begin = ranks ? cuts_.body(team_.first()) : 0;
    const std::size_t end = ranks ? std::min(cuts_.body(team_.first() + 1), layout_.particles()) : layout_.particles();
    const std::uint32_t own = divergence_->find(master_.data(), dt, begin, end, team_.stream());
    if (!ranks) return number_or_none(own);
    const auto none = static_cast<double>(layout_.particles());
    const double least = ranks->least(own == UINT32_MAX ? none : static_cast<double>(own));
    return least == none ? -1 : static_cast<std::int64_t>(least);
  }

  GroupState<P> group_state(std::size_t number, std::size_t chain, std::size_t frame) const {
    return {chain_on_host_.copy(views_[number].chain, chain), frame_on_host_.copy(views_[number].frame, frame), {}};
  }

  const StateList& states() const { return states_; }

  void start_clock() { parts_.start(team_.stream()); }
  std::vector<PartTime> stop_clock() { return parts_.stop(); }

  /// Returns the device addresses of the bodies' motion, for callers that read it on the device.
  DeviceMotion device_motion() const {
    return {team_.device(team_.first()), sizeof(R) == 8, master_.data(), displacement_.data(), layout_.particle};
  }

 private:
  /// Returns the walls' part of an array of bodies.
  template <class T>
  std::vector<T> of_walls(const T* bodies, std::size_t words) const {
    std::vector<T> out(walls * words);
    of_last(bodies + layout_.particles() * words, out.size());
    team_.wait("walls");
    copy_now(out.data(), bodies + layout_.particles() * words, out.size() * sizeof(T), "walls");
    return out;
  }

 protected:
  std::size_t bodies() const { return layout_.particles() + walls; }

  /// Completes an array of all bodies, walls included, on every rank.
  template <class T>
  void whole_bodies(T* data, std::size_t words) const {
    queue_whole(team_, data, words, [this](std::size_t m) { return cuts_.body(m); });
  }
  /// Sends `size` numbers from the last rank, which owns the walls, to all ranks.
  template <class T>
  void of_last(T* data, std::size_t size) const {
    queue_whole(team_, data, size, [this](std::size_t m) { return m == team_.size() ? 1 : 0; });
  }

  /// Sets all bodies to rest and clears the list of states.
  void rest() {
    states_.clear();
    master_.clear();
    displacement_.clear();
    velocity_.clear();
  }

  /// Uploads the arrays of group `number` at the first start; at later starts, only its states.
  ContactView<P> take_group(std::size_t number, bool first, ContactArrays<P>& arrays) {
    ContactView<P> view = first ? arrays.shape : views_[number];
    arrays.for_each_array(view, [&](auto name, auto unit, auto& array, auto& pointer) {
      constexpr bool state = !std::is_const_v<std::remove_pointer_t<std::decay_t<decltype(pointer)>>>;
      const auto size = static_cast<std::int64_t>(array.size() * sizeof(array[0]));
      if (first) {
        pointer = store_.keep(array, array_shares(array.size(), layout_.groups[number]));
        group_bytes_ += size;
        if (state) state_bytes_ += size;
      }
      if constexpr (state) {
        if (!first && size > 0) {
          copy_now(pointer, array.data(), static_cast<std::size_t>(size), "states of the start");
        }
        const GroupLayout& group = layout_.groups[number];
        add_device_state(states_, std::string(name) + "_" + to_string(group.pair), unit, pointer, array.size(),
                         state_order(layout_, group, view, &pointer == &view.chain));
      }
    });
    return views_[number] = view;
  }

  /// Adds the motion of the bodies to the states of a checkpoint.
  void add_body_states() {
    const auto add = [&](const char* name, const char* unit, const auto& array) {
      add_device_state(states_, name, unit, array.data(), array.size(),
                       [this] { return body_order(layout_, velocity_words); });
    };
    add("velocity", "m/s, rad/s", master_);
    add("displacement", "m, rad", displacement_);
    add("gathered_velocity", "m/s, rad/s", velocity_);
  }

  /// Checks the memory of every device. \throws RunError if a device has less free memory than its part of `needed`
  /// bytes.
  void require_memory(std::size_t needed) const {
    if (!team_.ranks()) needed = needed / team_.size() * static_cast<std::size_t>(team_.shares_of(0));
    team_.each([&](std::size_t m) {
      std::size_t free = 0, total = 0;
      check_cuda(cudaMemGetInfo(&free, &total), "memory");
      if (needed <= free) return;
      const auto mib = [](std::size_t bytes) { return std::to_string((bytes >> 20) + 1) + " MiB"; };
      throw RunError("CUDA: the scene of " + std::to_string(layout_.particles()) + " particles and " +
                     std::to_string(lists_.records / 2) + " contacts needs another " + mib(needed) + " on device " +
                     std::to_string(team_.device(m)) + ": found " + mib(free) + " free of " + mib(total));
    });
  }

  /// Returns the description of backend and devices; `way`: text that says how steps are taken.
  std::string described(const std::string& way) const {
    cudaDeviceProp properties{};
    check_cuda(cudaGetDeviceProperties(&properties, team_.device(team_.first())), "device properties");
    if (team_.ranks()) return "cuda, " + std::to_string(team_.size()) + " ranks, " + properties.name + ", " + way;
    DeviceList devices;
    for (std::size_t m = 0; m < team_.size(); ++m) devices.push_back(team_.device(m));
    const char* named = devices.size() > 1 ? " devices " : " device ";
    return "cuda" + (devices == DeviceList{0} ? "" : named + to_string(devices)) + ", " + properties.name + ", " + way;
  }

  /// body_traffic(): bytes of the bodies' arrays that a step reads and writes. held_bytes(): bytes of all arrays except
  /// the load records.
  std::int64_t body_traffic() const {
    return static_cast<std::int64_t>(2 * (master_.bytes() + displacement_.bytes() + velocity_.bytes()) +
                                     inverse_.bytes());
  }
  std::int64_t held_bytes() const {
    return group_bytes_ +
           static_cast<std::int64_t>(master_.bytes() + displacement_.bytes() + inverse_.bytes() + velocity_.bytes() +
                                     lists_.place.bytes() + weight_.bytes() + wall_rows_.bytes());
  }

  /// Makes the search for divergent particles when it is first needed. `radius` in specimen order [m]. \throws RunError
  /// if there is too little memory.
  void require_divergence_search(const std::vector<double>& radius) const {
    if (!divergence_) divergence_ = std::make_unique<DivergenceSearch<P>>(layout_, radius);
  }
  /// Returns −1 for UINT32_MAX (no particle), else the number.
  static std::int64_t number_or_none(std::uint32_t first_divergent) {
    return first_divergent == UINT32_MAX ? -1 : static_cast<std::int64_t>(first_divergent);
  }
  /// Enqueues sample `k` of the walls and of the first divergent particle. `wall_force`: loads on the walls, on the
  /// device.
  void queue_sample(DeviceSamples<R>& samples, std::size_t k, double dt, const R* wall_force) const {
    const cudaStream_t stream = team_.stream();
    const std::size_t from = layout_.particles();
    if (k == 0) samples.clear(stream);
    divergence_->queue(master_.data(), dt, 0, from, samples.divergent(k), stream);
    samples.take(k, wall_force, master_.data() + from * velocity_words,
                 displacement_.data() + from * displacement_words, stream);
  }
  /// Converts the first `number` samples, which must have been read.
  static std::vector<WallSample<R>> wall_samples(const DeviceSamples<R>& samples, std::size_t number) {
    const auto list = [](const auto& of) { return std::vector(std::begin(of), std::end(of)); };
    std::vector<WallSample<R>> out;
    for (std::size_t k = 0; k < number; ++k) {
      const auto& sample = samples[k];
      out.push_back({twists(list(sample.force)), list(sample.displacement), list(sample.velocity),
                     number_or_none(sample.divergent)});
    }
    return out;
  }
  /// Converts bodies from eight words to twists.
  static std::vector<Twist<R>> twists(const std::vector<R>& words) {
    std::vector<Twist<R>> out(words.size() / velocity_words);
    for (std::size_t i = 0; i < out.size(); ++i) {
      const R* w = &words[i * velocity_words];
      out[i] = {{w[0], w[1], w[2]}, {w[4], w[5], w[6]}};
    }
    return out;
  }
  G* gathered() const {
    if constexpr (std::is_same_v<G, R>)
      return master_.data();
    else
      return velocity_.data();
  }

  /// Returns how an array of a group is divided among the devices. An array with one item per slot is cut between
  /// slots; an array with one item per contact point is cut near the same contacts.
  Shares array_shares(std::size_t words, const GroupLayout& group) const {
    if (words % group.contact.size() == 0) return cuts_.slots(group);
    return cuts_.of([&](std::size_t m) {
      const std::size_t packet = group.tile_packet[cuts_.tile(m)], row = group.packet_layer[packet];
      return m == team_.size() ? words
                               : std::min<std::size_t>(words, row * (words / std::max(group.packet_layer.back(), 1u)));
    });
  }

  DeviceTeam team_;
  const Layout& layout_;
  TeamCuts cuts_;
  LoadLists lists_;
  std::optional<Crossing> crossing_;   // with several ranks
  std::vector<ContactView<P>> views_;  // [group]
  DeviceArray<R> master_, inverse_, weight_;
  DeviceArray<double> displacement_;
  DeviceArray<G> velocity_;
  WallRowsOnDevice<R> wall_rows_;
  mutable std::unique_ptr<DivergenceSearch<P>> divergence_;  // made when first needed
  mutable HostCopy<typename P::State> chain_on_host_, frame_on_host_;
  DeviceStore store_;
  StateList states_;
  PartClock parts_;
  std::int64_t group_bytes_ = 0, state_bytes_ = 0;
};

}  // namespace macadam::kernels
