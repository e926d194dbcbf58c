// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cuda_team.hpp  The devices that share a specimen.
///
/// Every launch of a step is cut by runs of tiles, one for each device. An array keeps one range of addresses: its
/// pages lie on the device that works on them, and all others reach them too. So a contact across a cut is stepped by
/// the same code from the same numbers as any other, and results do not depend on the number of devices.
///
/// Devices of several processes are cut in the same way, a run of tiles for each rank. There an array is whole on every
/// device, and what another rank has written of it comes by message (cuda_rank_exchange.hpp).
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "kernels/cuda_array.hpp"
#include "kernels/layout.hpp"

namespace macadam::kernels {

/// Where kernels of several streams are ready.
enum class KernelOrder {
  usual,
  first,  ///< before usual ones: many short kernels would each wait for a long one
};

/// Streams of the devices that share a specimen. One device named twice takes two shares. Of several processes, each
/// has one member: that of the number of its rank.
class DeviceTeam {
 public:
  /// `order`: of its kernels and those of others on the same device.
  /// \throws RunError for two devices that cannot reach each other's memory.
  explicit DeviceTeam(const DeviceList& devices, Ranks* ranks = nullptr, KernelOrder order = KernelOrder::usual)
      : ranks_(ranks && ranks->count() > 1 ? ranks : nullptr) {
    if (ranks_ && devices.size() > 1) {
      throw InputError("device: found " + to_string(devices) + " beside " + std::to_string(ranks_->count()) +
                       " ranks, expected one for each rank");
    }
    for (const int device : devices) member_.push_back({device, nullptr, nullptr});
    for (Member& m : member_) {
      for (const Member& other : member_) reach(m.device, other.device);
      check_cuda(cudaSetDevice(m.device), "device");
      int last = 0, first = 0;
      check_cuda(cudaDeviceGetStreamPriorityRange(&last, &first), "stream");
      check_cuda(
          cudaStreamCreateWithPriority(&m.stream, cudaStreamNonBlocking, order == KernelOrder::first ? first : last),
          "stream");
      check_cuda(cudaEventCreateWithFlags(&m.here, cudaEventDisableTiming), "event");
    }
    use();
    if (ranks_) ranks_->connect(devices.front());
  }
  DeviceTeam(const DeviceTeam&) = delete;
  ~DeviceTeam() {
    for (const Member& m : member_) {
      cudaSetDevice(m.device);
      cudaStreamDestroy(m.stream);
      cudaEventDestroy(m.here);
    }
    use();
  }

  /// The processes of the team; null: this one alone.
  Ranks* ranks() const { return ranks_; }
  /// Of all processes.
  std::size_t size() const { return ranks_ ? static_cast<std::size_t>(ranks_->count()) : member_.size(); }
  /// The first member of this process.
  std::size_t first() const { return ranks_ ? static_cast<std::size_t>(ranks_->number()) : 0; }
  /// Of a member of this process.
  int device(std::size_t m) const { return here(m).device; }
  cudaStream_t stream(std::size_t m) const { return here(m).stream; }
  cudaStream_t stream() const { return member_[0].stream; }
  /// How many members of this process are the device of member m.
  int shares_of(std::size_t m) const {
    return static_cast<int>(
        std::count_if(member_.begin(), member_.end(), [&](const Member& other) { return other.device == device(m); }));
  }
  /// Makes the device of member m the calling thread's; that it answers is known by then.
  void use(std::size_t m) const { cudaSetDevice(device(m)); }
  void use() const { use(first()); }

  /// Calls f(m) for every member of this process, with its device in use.
  template <class F>
  void each(F&& f) const {
    if (member_.size() == 1) return f(first());
    const struct Back {  // also after an error
      const DeviceTeam& team;
      ~Back() { team.use(); }
    } back{*this};
    for (std::size_t m = 0; m < member_.size(); ++m) {
      use(m);
      f(m);
    }
  }

  /// What any member of this process queues from now on waits for all that its members have queued.
  void meet() const {
    if (member_.size() == 1) return;
    each([&](std::size_t m) { check_cuda(cudaEventRecord(member_[m].here, member_[m].stream), "event"); });
    each([&](std::size_t m) {
      for (std::size_t other = 0; other < member_.size(); ++other) {
        if (other != m) check_cuda(cudaStreamWaitEvent(member_[m].stream, member_[other].here, 0), "event");
      }
    });
  }
  /// What f() queues, as a graph for the stream of the first member.
  template <class F>
  cudaGraphExec_t record(F&& f) const {
    check_cuda(cudaStreamBeginCapture(stream(), cudaStreamCaptureModeThreadLocal), "graph");
    check_cuda(cudaEventRecord(member_[0].here, stream()), "graph");
    for (std::size_t m = 1; m < member_.size(); ++m)
      check_cuda(cudaStreamWaitEvent(member_[m].stream, member_[0].here, 0), "graph");
    f();
    for (std::size_t m = 1; m < member_.size(); ++m) {
      use(m);
      check_cuda(cudaEventRecord(member_[m].here, member_[m].stream), "graph");
      use();
      check_cuda(cudaStreamWaitEvent(stream(), member_[m].here, 0), "graph");
    }
    cudaGraph_t graph = nullptr;
    cudaGraphExec_t out = nullptr;
    check_cuda(cudaStreamEndCapture(stream(), &graph), "graph");
    check_cuda(cudaGraphInstantiate(&out, graph, 0), "graph");
    check_cuda(cudaGraphDestroy(graph), "graph");
    return out;
  }

  /// The same whatever fails, of every member: before what it works on goes.
  void wait_for_the_last() const noexcept {
    for (const Member& m : member_) {
      cudaSetDevice(m.device);
      cudaStreamSynchronize(m.stream);
    }
    use();
  }
  /// Makes what the first member queues from now on wait for an event of another stream; meet() brings it to the
  /// others.
  std::function<void(void*)> behind() const {
    return
        [this](void* event) { check_cuda(cudaStreamWaitEvent(stream(), static_cast<cudaEvent_t>(event), 0), "event"); };
  }
  /// Until all that is queued is done. Every device is asked again and again: what one that fails should have done,
  /// others may wait for in vain.
  void wait(const char* what) const {
    if (member_.size() == 1 && !ranks_) return check_cuda(cudaStreamSynchronize(stream()), what);
    while (!at_rest(what)) std::this_thread::yield();
  }
  /// The same until an event has come.
  void wait_for(cudaEvent_t event, const char* what) const {
    if (member_.size() == 1) return check_cuda(cudaEventSynchronize(event), what);
    for (cudaError_t status = cudaErrorNotReady; status != cudaSuccess; status = cudaEventQuery(event)) {
      if (status != cudaErrorNotReady) check_cuda(status, what);
      at_rest(what);
      std::this_thread::yield();
    }
  }
  /// Whether a device that has not failed still works.
  bool works() const noexcept {
    bool out = false;
    each([&](std::size_t m) { out = out || cudaStreamQuery(stream(m)) == cudaErrorNotReady; });
    return out;
  }

 private:
  /// Whether all that is queued is done. \throws RunError naming a device that has failed.
  bool at_rest(const char* what) const {
    bool out = true;
    if (ranks_) ranks_->require_link();
    each([&](std::size_t m) {
      const cudaError_t status = cudaStreamQuery(stream(m));
      if (status == cudaErrorNotReady)
        out = false;
      else if (status != cudaSuccess)
        throw RunError("CUDA: device " + std::to_string(device(m)) + ": " + what + ": " + cudaGetErrorString(status));
    });
    return out;
  }

  struct Member {
    int device;
    cudaStream_t stream;
    cudaEvent_t here;
  };

  static void reach(int from, int to) {
    if (from == to) return;
    int can = 0;
    check_cuda(cudaDeviceCanAccessPeer(&can, from, to), "device");
    if (!can) {
      throw RunError("CUDA: device " + std::to_string(from) + " cannot reach the memory of device " +
                     std::to_string(to) + ": the two cannot share a specimen");
    }
    check_cuda(cudaSetDevice(from), "device");
    const cudaError_t status = cudaDeviceEnablePeerAccess(to, 0);
    if (status == cudaErrorPeerAccessAlreadyEnabled)
      cudaGetLastError();
    else
      check_cuda(status, "access to another device's memory");
    cudaMemPool_t pool = nullptr;  // of the other's arrays
    check_cuda(cudaDeviceGetDefaultMemPool(&pool, to), "memory of another device");
    cudaMemAccessDesc reader{};
    reader.location = {cudaMemLocationTypeDevice, from};
    reader.flags = cudaMemAccessFlagsProtReadWrite;
    check_cuda(cudaMemPoolSetAccess(pool, &reader, 1), "access to another device's memory");
  }

  const Member& here(std::size_t m) const { return member_[m - first()]; }

  Ranks* ranks_;
  std::vector<Member> member_;  // of this process
};

/// The tiles of a layout, cut into as many runs as a team has members.
class TeamCuts {
 public:
  TeamCuts(const DeviceTeam& team, const Layout& layout) : team_(team), layout_(layout) {
    for (std::size_t m = 0; m <= team.size(); ++m) tile_.push_back(m * layout.tiles() / team.size());
  }

  std::size_t members() const { return team_.size(); }
  /// Of member m; that of the number of members is the end.
  std::size_t tile(std::size_t m) const { return tile_[m]; }
  /// Bodies; the last member has the walls.
  std::size_t body(std::size_t m) const {
    return static_cast<std::size_t>(layout_.tile_body[tile_[m]]) + (m == team_.size() ? walls : 0);
  }
  /// The member whose body it is.
  std::size_t owner(std::size_t body) const {
    std::size_t m = 0;
    while (body >= this->body(m + 1)) ++m;
    return m;
  }
  /// Slots of a group.
  std::size_t slot(const GroupLayout& group, std::size_t m) const {
    return group.tile_packet[tile_[m]] * static_cast<std::size_t>(layout_.lanes);
  }

  Shares bodies() const {
    return of([&](std::size_t m) { return body(m); });
  }
  Shares slots(const GroupLayout& group) const {
    return of([&](std::size_t m) { return slot(group, m); });
  }
  /// Of the slots of all groups, one group behind the other.
  Shares all_slots() const {
    Shares out;
    for (const auto& group : layout_.groups) {
      const std::size_t before = out.empty() ? 0 : out.back().end;
      for (const Share& share : slots(group)) out.push_back({before + share.end, share.device});
    }
    return team_.ranks() ? Shares{out.back()} : out;
  }
  /// Of any items, the first of member m being first(m). Of several processes, each has all.
  template <class First>
  Shares of(First&& first) const {
    if (team_.ranks()) return {{first(team_.size()), team_.device(team_.first())}};
    Shares out;
    for (std::size_t m = 0; m < team_.size(); ++m) out.push_back({first(m + 1), team_.device(m)});
    return out;
  }

 private:
  const DeviceTeam& team_;
  const Layout& layout_;
  std::vector<std::size_t> tile_;
};

}  // namespace macadam::kernels
