// SPDX-License-Identifier: GPL-3.0-or-later
/// \file thread_ranks.hpp  Ranks (usually processes that share the work) that are threads of one process and use one
/// device. Tests can run any number of them without MPI.
#pragma once

#include <cuda_runtime.h>

#include <algorithm>
#include <barrier>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "macadam/ranks.hpp"

namespace macadam::test {

/// Data that all ranks share.
struct RankHub {
  explicit RankHub(std::size_t count)
      : all(static_cast<std::ptrdiff_t>(count)), values(count), first(nullptr), sent(count), ready(count), done(count) {
    for (std::size_t k = 0; k < ready.size(); ++k) {
      cudaEventCreateWithFlags(&ready[k], cudaEventDisableTiming);
      cudaEventCreateWithFlags(&done[k], cudaEventDisableTiming);
    }
  }
  std::barrier<> all;
  std::vector<double> values;
  void* first;
  std::vector<std::vector<Ranks::Message>> sent;  // messages sent, by rank of the sender
  std::vector<cudaEvent_t> ready, done;
};

/// A rank that sends a message as a copy on the device. The copy waits for the sender's stream; the sender's later work
/// waits for the copy.
class ThreadRank final : public Ranks {
 public:
  ThreadRank(RankHub& hub, int number) : hub_(hub), number_(number) {}
  int number() const override { return number_; }
  int count() const override { return static_cast<int>(hub_.values.size()); }
  int number_on_host() const override { return number_; }
  int count_on_host() const override { return count(); }
  void require_link() override {}
  void take_of_first(void* data, std::size_t size) override {
    if (number_ == 0) hub_.first = data;
    hub_.all.arrive_and_wait();
    if (number_ > 0 && size > 0) std::memcpy(data, hub_.first, size);
    hub_.all.arrive_and_wait();
  }
  double least(double value) override {
    hub_.values[own()] = value;
    hub_.all.arrive_and_wait();
    const double out = *std::min_element(hub_.values.begin(), hub_.values.end());
    hub_.all.arrive_and_wait();
    return out;
  }
  void connect(int) override {}
  void queue(const std::vector<Message>& sent, const std::vector<Message>& received, void* stream) override {
    const auto to = static_cast<cudaStream_t>(stream);
    hub_.sent[own()] = sent;
    cudaEventRecord(hub_.ready[own()], to);
    hub_.all.arrive_and_wait();
    for (const Message& m : received) {
      const auto& theirs = hub_.sent[static_cast<std::size_t>(m.rank)];
      const auto found = std::find_if(theirs.begin(), theirs.end(),
                                      [&](const Message& s) { return s.rank == number_ && s.size == m.size; });
      if (found == theirs.end()) std::abort();  // without the message the other ranks would wait for ever
      cudaStreamWaitEvent(to, hub_.ready[static_cast<std::size_t>(m.rank)], 0);
      cudaMemcpyAsync(m.data, found->data, m.size, cudaMemcpyDeviceToDevice, to);
    }
    cudaEventRecord(hub_.done[own()], to);
    hub_.all.arrive_and_wait();
    for (const cudaEvent_t event : hub_.done) cudaStreamWaitEvent(to, event, 0);
    hub_.all.arrive_and_wait();
  }
  bool goes_into_graphs() const override { return false; }
  void leave() override {}
  void end_all(int code) override { std::_Exit(code); }

 private:
  std::size_t own() const { return static_cast<std::size_t>(number_); }
  RankHub& hub_;
  int number_;
};

/// Calls f(rank) for each of `count` ranks, each in a thread.
inline void for_ranks(int count, const std::function<void(Ranks&)>& f) {
  RankHub hub(static_cast<std::size_t>(count));
  std::vector<std::thread> threads;
  for (int number = 0; number < count; ++number) {
    threads.emplace_back([&, number] {
      cudaSetDevice(0);
      ThreadRank rank(hub, number);
      try {
        f(rank);
      } catch (const std::exception& error) {  // without this rank the others would wait for ever
        std::fprintf(stderr, "rank %d: %s\n", number, error.what());
        std::_Exit(1);
      }
    });
  }
  for (std::thread& t : threads) t.join();
}

}  // namespace macadam::test
