// SPDX-License-Identifier: GPL-3.0-or-later
/// \file device_team.hpp  Defines the team of devices (GPUs) that step one specimen together.
///
/// The tiles of the layout (ranges of neighbouring particles) are divided into one range per device (TeamCuts). Every
/// kernel of a step is launched once per device, for the tiles of that device. With several devices of one process, an
/// array has one range of addresses. Its pages lie on the device that works on them, and all other devices can access
/// them. So a contact between particles of two devices is stepped by the same code and from the same numbers as any
/// other contact, and results do not depend on the number of devices.
///
/// With several processes (ranks), the tiles are cut in the same way, one part per rank. Every device then has whole
/// arrays, and receives the changes that other ranks make by messages (rank_exchange.hpp).
///
/// Words: a member is one device of the team with its stream; its number m counts over all processes. A share is a
/// member's part of an array (spread_memory.hpp).
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "kernels/cuda/device/array.hpp"
#include "kernels/layout/layout.hpp"

namespace macadam::kernels {

/// Which kernels run first if kernels of several streams are ready.
enum class KernelOrder {
  usual,
  first,  ///< before other kernels: many short kernels would otherwise each wait for a long one
};

/// Streams of the devices that step a specimen. A device that is named twice counts as two members. With several ranks
/// each process has one member, numbered by its rank.
class DeviceTeam {
 public:
  /// `order`: priority of the team's kernels over other kernels on the same device. \throws RunError if two devices
  /// cannot access each other's memory, InputError for several devices together with ranks.
  explicit DeviceTeam(const DeviceList& devices, Ranks* ranks = nullptr, KernelOrder order = KernelOrder::usual)
      : ranks_(ranks && ranks->count() > 1 ? ranks : nullptr) {
    if (ranks_ && devices.size() > 1) {
      throw InputError("device: found " + to_string(devices) + " beside " + std::to_string(ranks_->count()) +
                       " ranks, expected one device per rank");
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

  /// The ranks of the team; null with one process.
  Ranks* ranks() const { return ranks_; }
  /// Number of members, over all processes.
  std::size_t size() const { return ranks_ ? static_cast<std::size_t>(ranks_->count()) : member_.size(); }
  /// Number of the first member of this process.
  std::size_t first() const { return ranks_ ? static_cast<std::size_t>(ranks_->number()) : 0; }
  /// Device and stream of member m, which must be of this process; without m, the stream of the first one.
  int device(std::size_t m) const { return here(m).device; }
  cudaStream_t stream(std::size_t m) const { return here(m).stream; }
  cudaStream_t stream() const { return member_[0].stream; }
  /// Returns how many members of this process use the device of member m.
  int shares_of(std::size_t m) const {
    return static_cast<int>(
        std::count_if(member_.begin(), member_.end(), [&](const Member& other) { return other.device == device(m); }));
  }
  /// Makes the device of member m current for the calling thread. Ignores errors, because the device has been used
  /// before.
  void use(std::size_t m) const { cudaSetDevice(device(m)); }
  void use() const { use(first()); }

  /// Calls f(m) for every member of this process, with its device current.
  template <class F>
  void each(F&& f) const {
    if (member_.size() == 1) return f(first());
    const struct Back {  // restores the device also after an error
      const DeviceTeam& team;
      ~Back() { team.use(); }
    } back{*this};
    for (std::size_t m = 0; m < member_.size(); ++m) {
      use(m);
      f(m);
    }
  }

  /// Joins the streams: everything that a member of this process enqueues from now on waits for everything that its
  /// members have enqueued so far.
  void join_streams() const {
    if (member_.size() == 1) return;
    each([&](std::size_t m) { check_cuda(cudaEventRecord(member_[m].here, member_[m].stream), "event"); });
    each([&](std::size_t m) {
      for (std::size_t other = 0; other < member_.size(); ++other) {
        if (other != m) check_cuda(cudaStreamWaitEvent(member_[m].stream, member_[other].here, 0), "event");
      }
    });
  }
  /// Records everything that f() enqueues as a graph for the stream of the first member.
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

  /// Waits for the enqueued work of every member and ignores errors. Called before arrays are freed.
  void wait_for_the_last() const noexcept {
    for (const Member& m : member_) {
      cudaSetDevice(m.device);
      cudaStreamSynchronize(m.stream);
    }
    use();
  }
  /// Returns a function that makes the first member's later work wait for an event of another stream. join_streams()
  /// passes this on to the other members.
  std::function<void(void*)> behind() const {
    return
        [this](void* event) { check_cuda(cudaStreamWaitEvent(stream(), static_cast<cudaEvent_t>(event), 0), "event"); };
  }
  /// Waits until everything enqueued has finished. With several devices, polls all of them: if one fails, others may
  /// wait for it forever. \throws RunError
  void wait(const char* what) const {
    if (member_.size() == 1 && !ranks_) return check_cuda(cudaStreamSynchronize(stream()), what);
    while (!at_rest(what)) std::this_thread::yield();
  }
  /// Waits until an event has happened; like wait(), polls all devices if there are several.
  void wait_for(cudaEvent_t event, const char* what) const {
    if (member_.size() == 1) return check_cuda(cudaEventSynchronize(event), what);
    for (cudaError_t status = cudaErrorNotReady; status != cudaSuccess; status = cudaEventQuery(event)) {
      if (status != cudaErrorNotReady) check_cuda(status, what);
      at_rest(what);
      std::this_thread::yield();
    }
  }
  /// Returns whether any device that has not failed is still computing.
  bool works() const noexcept {
    bool out = false;
    each([&](std::size_t m) { out = out || cudaStreamQuery(stream(m)) == cudaErrorNotReady; });
    return out;
  }

 private:
  /// Returns whether everything enqueued has finished. \throws RunError naming a device that has failed.
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

  /// Lets device `from` access the memory of device `to`. \throws RunError if it cannot.
  static void reach(int from, int to) {
    if (from == to) return;
    int can = 0;
    check_cuda(cudaDeviceCanAccessPeer(&can, from, to), "device");
    if (!can) {
      throw RunError("CUDA: device " + std::to_string(from) + " cannot reach the memory of device " +
                     std::to_string(to) + ", so these two devices cannot share a specimen");
    }
    check_cuda(cudaSetDevice(from), "device");
    const cudaError_t status = cudaDeviceEnablePeerAccess(to, 0);
    if (status == cudaErrorPeerAccessAlreadyEnabled)
      cudaGetLastError();
    else
      check_cuda(status, "access to another device's memory");
    cudaMemPool_t pool = nullptr;  // pool of the other device's arrays
    check_cuda(cudaDeviceGetDefaultMemPool(&pool, to), "memory of another device");
    cudaMemAccessDesc reader{};
    reader.location = {cudaMemLocationTypeDevice, from};
    reader.flags = cudaMemAccessFlagsProtReadWrite;
    check_cuda(cudaMemPoolSetAccess(pool, &reader, 1), "access to another device's memory");
  }

  const Member& here(std::size_t m) const { return member_[m - first()]; }

  Ranks* ranks_;
  std::vector<Member> member_;  // members of this process
};

/// The parts into which the tiles of a layout are cut, one for each member of a team.
class TeamCuts {
 public:
  TeamCuts(const DeviceTeam& team, const Layout& layout) : team_(team), layout_(layout) {
    for (std::size_t m = 0; m <= team.size(); ++m) tile_.push_back(m * layout.tiles() / team.size());
  }

  std::size_t members() const { return team_.size(); }
  /// First tile of member m; the number of tiles for m = number of members.
  std::size_t tile(std::size_t m) const { return tile_[m]; }
  /// First body of member m; the last member also has the walls.
  std::size_t body(std::size_t m) const {
    return static_cast<std::size_t>(layout_.tile_body[tile_[m]]) + (m == team_.size() ? walls : 0);
  }
  /// Returns the member that owns a body.
  std::size_t owner(std::size_t body) const {
    std::size_t m = 0;
    while (body >= this->body(m + 1)) ++m;
    return m;
  }
  /// First slot of member m in a group.
  std::size_t slot(const GroupLayout& group, std::size_t m) const {
    return group.tile_packet[tile_[m]] * static_cast<std::size_t>(layout_.lanes);
  }

  Shares bodies() const {
    return of([&](std::size_t m) { return body(m); });
  }
  Shares slots(const GroupLayout& group) const {
    return of([&](std::size_t m) { return slot(group, m); });
  }
  /// Divides the slots of all groups among the members, one group after the other.
  Shares all_slots() const {
    Shares out;
    for (const auto& group : layout_.groups) {
      const std::size_t before = out.empty() ? 0 : out.back().end;
      for (const Share& share : slots(group)) out.push_back({before + share.end, share.device});
    }
    return team_.ranks() ? Shares{out.back()} : out;
  }
  /// Divides items among the members: member m gets the items first(m) … first(m + 1) − 1. With several ranks, the
  /// result is one share with the items of all members, because every rank's device has whole arrays.
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
