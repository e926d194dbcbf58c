// SPDX-License-Identifier: GPL-3.0-or-later
/// \file ranks.hpp  Processes that step one specimen together, on one host or several, each with a device of its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace macadam {

/// The processes that `mpirun` began, as one of them sees them. All make the same scene and call the same functions of
/// their steppers in the same order; each keeps all arrays, steps its own run of tiles, and sends what the others read
/// of it. The calls of one process are those of one thread. docs/devices.md.
class Ranks {
 public:
  virtual ~Ranks() = default;

  /// Of this process, from 0.
  virtual int number() const = 0;
  /// How many there are.
  virtual int count() const = 0;
  /// Of this process among those on its host, from 0.
  virtual int number_on_host() const = 0;
  /// How many are on this process's host.
  virtual int count_on_host() const = 0;

  /// Overwrites `size` bytes on all others by those of the first. Waits for all. \throws RunError
  virtual void take_of_first(void* data, std::size_t size) = 0;
  /// The least of what all ranks have. Waits for all. \throws RunError
  virtual double least(double value) = 0;

  /// Makes ready for messages between devices, `device` being that in use. Waits for all. \throws RunError naming the
  /// device that cannot.
  virtual void connect(int device) = 0;
  /// A run of bytes on the device for another rank, or from it.
  struct Message {
    int rank = 0;
    void* data = nullptr;
    std::size_t size = 0;  ///< [byte]
  };
  /// Queues messages in the stream, a cudaStream_t, all of which go together. For each that one rank sends to another
  /// there is one that this one receives from it, of the same size. \throws RunError
  virtual void queue(const std::vector<Message>& sent, const std::vector<Message>& received, void* stream) = 0;
  /// \throws RunError where messages that were queued can no longer arrive.
  virtual void require_link() = 0;
  /// Whether queue() may be recorded into a graph of launches.
  virtual bool goes_into_graphs() const = 0;

  /// The run is done: to be called by all before they end. A rank that ends without it ends the others.
  virtual void leave() = 0;
  /// Ends all processes at once, this one with `code`: after an error, which the others would wait through for ever.
  [[noreturn]] virtual void end_all(int code) = 0;

  /// What the first rank has. Waits for all. \throws RunError
  double of_first(double value) {
    take_of_first(&value, sizeof value);
    return value;
  }
  /// Whether any rank says so. Waits for all. \throws RunError
  bool any(bool value) { return least(value ? 0 : 1) == 0; }
  /// \throws RunError where ranks differ: they no longer run the same scene, and would wait for each other for ever.
  void require_same(const std::string& what, std::int64_t value);
};

/// What a plugin of ranks exports, under the C name `macadam_ranks_plugin`. `join`: the processes of which this one is,
/// which are there until the program ends. \throws RunError
struct RanksPlugin {
  int interface;        ///< ranks_interface of its build
  const char* version;  ///< of Macadam
  Ranks* (*join)();
};
/// Counted up with every change of Ranks.
inline constexpr int ranks_interface = 1;

/// Joins the processes that `mpirun` or its like began with this one, each of which calls this: from then on they run
/// scenes together. Returns them, or null where this one was begun alone. \throws RunError where libmacadam_ranks.so,
/// which needs MPI and NCCL, is not there or fails, or was built with another MPI than that which began them.
Ranks* join_ranks();

/// The processes that join_ranks() has joined; null where this one is alone.
Ranks* ranks();

/// Whether this process writes results: one that is alone, or the first of several.
inline bool is_first_rank() {
  const Ranks* team = ranks();
  return !team || team->number() == 0;
}
/// What the first of several processes has; of one that is alone, the value itself.
inline double of_first_rank(double value) {
  Ranks* team = ranks();
  return team ? team->of_first(value) : value;
}

}  // namespace macadam
