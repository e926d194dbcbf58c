// SPDX-License-Identifier: GPL-3.0-or-later
/// \file step_contacts.hpp  Defines the kernel that steps the contacts of all groups in one launch (second of the two
/// kernels of ExecCuda). Each thread block belongs to one group, so that all threads of a warp run the same code.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <type_traits>

#include "kernels/contact/law_functors.hpp"
#include "kernels/cuda/common/lane_item.hpp"
#include "kernels/cuda/common/load_records.hpp"
#include "kernels/cuda/device/launch.hpp"
#include "kernels/cuda/device/tuning.hpp"

namespace macadam::kernels {

/// The functors of the groups of a launch, passed to the kernel by value. `Units`: as in ContactForces; laws without
/// memory fit any number.
template <class P, class AnyLaw, ContactForm form, Geometry geometry, int Units, LaunchKind kind>
struct ContactGroups;
template <class P, class... L, ContactForm form, Geometry geometry, int Units, LaunchKind kind>
struct ContactGroups<P, std::variant<L...>, form, geometry, Units, kind> {
  struct Group {
    std::uint32_t first_block = UINT32_MAX;  ///< first thread block of this group
    /// first_slot: number of the group's first slot among the slots of all groups. begin, end: the group's slots in
    /// this launch.
    std::uint32_t first_slot = 0, begin = 0, end = 0;
    AnyFunctor<typename StepFunctor<P, L, form, geometry, Units, kind>::type...> functor;
  };
  Group group[pair_types];
  int groups = 0;
  std::uint32_t blocks = 0;  ///< thread blocks of all groups

  /// Adds a group. Its thread blocks follow the thread blocks of the groups added before.
  template <class Forces>
  void add(std::uint32_t first_slot, std::uint32_t begin, std::uint32_t end, const Forces& forces) {
    Group& g = group[groups++];
    g.first_block = blocks, g.first_slot = first_slot, g.begin = begin, g.end = end;
    g.functor.put(forces);
    blocks += (end - begin + contact_threads - 1) / contact_threads;
  }
};

/// Counts the steps on the device. One warp copies the row of the walls' table for the current step to a fixed address,
/// where step_bodies reads it.
template <class R>
struct WallClock {
  std::int64_t* step = nullptr;  ///< number of rows copied so far; null: no driven walls
  const R* table = nullptr;
  R* now = nullptr;    ///< [words] the row of the current step
  unsigned words = 0;  ///< size of a row

  /// Copies the row of the current step and increments the counter.
  __device__ __forceinline__ void tick() const {
    const unsigned lane = threadIdx.x;
    if (lane >= 32) return;
    const std::int64_t row = *step;
    if (lane < words) now[lane] = table[static_cast<std::size_t>(row) * words + lane];
    __syncwarp();
    if (lane == 0) *step = row + 1;
  }
};
/// Sets the counter to `row` and copies this row.
template <class R>
__global__ void start_clock(const WallClock<R> clock, std::int64_t row) {
  if (threadIdx.x == 0) *clock.step = row;
  __syncwarp();
  clock.tick();
}

/// Steps every contact of a launch and writes its loads. If walls are driven, the first thread block advances the step
/// counter of the walls (WallClock) and steps no contact.
template <class P, class AnyLaw, ContactForm form, Geometry geometry, int Units, LaunchKind kind>
__global__ void __launch_bounds__(contact_threads, contact_blocks)
    step_contacts(const __grid_constant__ ContactGroups<P, AnyLaw, form, geometry, Units, kind> groups,
                  const MotionView<P> motion, const LoadRecords<typename P::Geometry> records,
                  const WallClock<typename P::Particle> clock) {
  std::uint32_t block = blockIdx.x;
  if (clock.step && block-- == 0) return clock.tick();
  int number = 0;
  while (number + 1 < groups.groups && groups.group[number + 1].first_block <= block) ++number;
  const auto& group = groups.group[number];
  const std::uint32_t slot = group.begin + (block - group.first_block) * contact_threads + threadIdx.x;
  if (slot >= group.end) return;  // either all threads of a warp return, or none
  group.functor.visit([&](const auto& forces) {
    records.store_by_warp(group.first_slot + slot, forces(LaneItem{slot % 32}, slot / 32, motion));
  });
}

/// The launches that step all contacts of a device: one for each kind and number of Kelvin units that has
/// its own code.
template <class P, class AnyLaw>
class ContactLaunches {
 public:
  using Records = LoadRecords<typename P::Geometry>;
  using Clock = WallClock<typename P::Particle>;

  /// Adds the slots begin … end − 1 of a group; `first_slot` is the number of its first slot among all groups.
  /// `series`: whether some contact of any group has rock in series.
  template <class Forces>
  void add(const Forces& forces, std::uint32_t first_slot, std::uint32_t begin, std::uint32_t end, bool series) {
    if constexpr (any_series_law(std::type_identity<AnyLaw>{}) && !Forces::coupled) {
      if (series) return add_to_launch(forces, first_slot, begin, end);
    }
    add_to_launch(forces.without_series(), first_slot, begin, end);
  }
  /// Enqueues the step of all contacts. Only the first launch advances the clock.
  void run(cudaStream_t stream, const MotionView<P>& motion, const Records& records, Clock clock) const {
    for (const auto& [key, to] : launches_) {
      to.run(stream, motion, records, clock);
      clock = {};
    }
  }
  std::vector<KernelUse> kernels() const {
    std::vector<KernelUse> out;
    for (const auto& [key, to] : launches_) out.push_back(to.use);
    return out;
  }

 private:
  template <class LawStep, int Units, ContactForm form, Geometry geometry, bool series>
  void add_to_launch(const ContactForces<P, LawStep, Units, form, geometry, series>& forces, std::uint32_t first_slot,
                     std::uint32_t begin, std::uint32_t end) {
    constexpr int units = LawStep::memoryless ? 3 : Units;  // so that one launch suffices for most scenes
    constexpr LaunchKind kind = coupled_step<LawStep> ? LaunchKind::coupled
                                : series              ? LaunchKind::series
                                                      : LaunchKind::plain;
    using Groups = ContactGroups<P, AnyLaw, form, geometry, units, kind>;
    const auto kernel = step_contacts<P, AnyLaw, form, geometry, units, kind>;
    Launch& to = launches_[{units, kind}];
    if (!to.groups) to.groups = std::make_shared<Groups>();
    auto groups = std::static_pointer_cast<Groups>(to.groups);
    groups->add(first_slot, begin, end, forces);
    to.run = [groups, kernel](cudaStream_t stream, const MotionView<P>& motion, const Records& records,
                              const Clock& clock) {
      launch("contacts", kernel, groups->blocks + (clock.step ? 1 : 0), contact_threads, 0, stream, *groups, motion,
             records, clock);
    };
    to.use = kernel_use("contacts", kernel, contact_threads, 0);
  }

  struct Launch {
    std::shared_ptr<void> groups;
    KernelUse use;
    std::function<void(cudaStream_t, const MotionView<P>&, const Records&, const Clock&)> run;
  };
  std::map<std::pair<int, LaunchKind>, Launch> launches_;  ///< by number of units and kind
};

}  // namespace macadam::kernels
