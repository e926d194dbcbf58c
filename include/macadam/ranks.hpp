// SPDX-License-Identifier: GPL-3.0-or-later
/// \file ranks.hpp  Declares ranks: processes that step one specimen together, on one host or several hosts, each with
/// its own device (GPU).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace macadam {

/// The processes started by `mpirun`, as seen by one of them. All read the same scene and call the same functions of
/// their steppers in the same order. Each process holds all arrays, steps its own tiles (groups of neighbouring
/// particles), and sends the data that other processes read. All calls of a process must come from one thread. See
/// docs/several-gpus.md.
class Ranks {
 public:
  virtual ~Ranks() = default;

  /// Returns the number of this process, from 0.
  virtual int number() const = 0;
  /// Returns the number of processes.
  virtual int count() const = 0;
  /// Returns the number of this process among those on its host, from 0.
  virtual int number_on_host() const = 0;
  /// Returns the number of processes on this process's host.
  virtual int count_on_host() const = 0;

  /// Copies `size` bytes from the first process to all others. Waits for all processes. \throws RunError
  virtual void take_of_first(void* data, std::size_t size) = 0;
  /// Returns the smallest value of all ranks. Waits for all processes. \throws RunError
  virtual double least(double value) = 0;

  /// Prepares messages between devices; `device` is the current one. Waits for all processes. \throws RunError naming a
  /// device that cannot be connected.
  virtual void connect(int device) = 0;
  /// Bytes in device memory that are sent to another rank, or received from another rank.
  struct Message {
    int rank = 0;
    void* data = nullptr;
    std::size_t size = 0;  ///< [byte]
  };
  /// Enqueues messages in the stream, a cudaStream_t; all these messages are transferred together. For each message
  /// that one rank sends there must be one of the same size that the other rank receives. \throws RunError
  virtual void queue(const std::vector<Message>& sent, const std::vector<Message>& received, void* stream) = 0;
  /// Checks the connections to the other ranks. \throws RunError if enqueued messages can no longer arrive.
  virtual void require_link() = 0;
  /// Returns whether queue() may be recorded into a CUDA graph.
  virtual bool goes_into_graphs() const = 0;

  /// Ends the collaboration. All processes must call this before they end; if a rank ends without this call, the other
  /// ranks are ended too.
  virtual void leave() = 0;
  /// Ends all processes at once, this one with exit code `code`. Called after an error, because the other processes
  /// would otherwise wait forever.
  [[noreturn]] virtual void end_all(int code) = 0;

  /// Returns the value of the first rank. Waits for all processes. \throws RunError
  double of_first(double value) {
    take_of_first(&value, sizeof value);
    return value;
  }
  /// Returns whether `value` is true on at least one rank. Waits for all processes. \throws RunError
  bool any(bool value) { return least(value ? 0 : 1) == 0; }
  /// Checks that all ranks pass the same value. \throws RunError if the values differ: the ranks then no longer run the
  /// same scene and would wait for each other forever.
  void require_same(const std::string& what, std::int64_t value);
};

/// The symbol that a ranks plugin exports, with the C name `macadam_ranks_plugin`. `join`: returns the processes that
/// this process belongs to; the returned object exists until the program ends. \throws RunError
struct RanksPlugin {
  int interface;        ///< ranks_interface of the plugin's build
  const char* version;  ///< version of Macadam
  Ranks* (*join)();
};
/// Version of the interface; increases with every change of Ranks.
inline constexpr int ranks_interface = 1;

/// Joins the processes that `mpirun` or a similar program started together with this one. Each of them calls this;
/// afterwards they run scenes together. Returns the processes, or null if this one was started alone. \throws RunError
/// if libmacadam_ranks.so, which needs MPI and NCCL, is missing or fails, or was built with another MPI than the one
/// that started the processes.
Ranks* join_ranks();

/// Returns the processes that join_ranks() has joined; null if this one is alone.
Ranks* ranks();

/// Returns whether this process writes results: it is alone, or the first of several.
inline bool is_first_rank() {
  const Ranks* team = ranks();
  return !team || team->number() == 0;
}
/// Returns the value of the first process; the value itself if this process is alone.
inline double of_first_rank(double value) {
  Ranks* team = ranks();
  return team ? team->of_first(value) : value;
}

}  // namespace macadam
