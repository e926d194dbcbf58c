// SPDX-License-Identifier: GPL-3.0-or-later
/// \file part_clock.hpp  Measures how long the parts of a step take on a device, by events between them.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "kernels/cuda/device/launch.hpp"

namespace macadam::kernels {

/// Records an event after each part of a step. Does nothing before start() is called.
class PartClock {
 public:
  PartClock() = default;
  PartClock(const PartClock&) = delete;
  ~PartClock() { forget(); }

  bool runs() const { return runs_; }
  void start(cudaStream_t stream) {
    forget();
    runs_ = true;
    end_of("", stream);
  }
  /// Marks the end of `part`: it consists of everything enqueued since the last call.
  void end_of(const char* part, cudaStream_t stream) {
    if (!runs_) return;
    cudaEvent_t event = nullptr;
    check_cuda(cudaEventCreate(&event), "event");
    marks_.emplace_back(part, event);
    check_cuda(cudaEventRecord(event, stream), "event");
  }
  /// Waits for the last event and returns the total seconds of each part.
  std::vector<PartTime> stop() {
    std::map<std::string, double> seconds;
    if (!marks_.empty()) check_cuda(cudaEventSynchronize(marks_.back().second), "event");
    for (std::size_t k = 1; k < marks_.size(); ++k) {
      float ms = 0;
      check_cuda(cudaEventElapsedTime(&ms, marks_[k - 1].second, marks_[k].second), "event");
      seconds[marks_[k].first] += 1e-3 * static_cast<double>(ms);
    }
    forget();
    std::vector<PartTime> out;
    for (const auto& [name, time] : seconds) out.push_back({name, time});
    return out;
  }

 private:
  void forget() {
    for (const auto& [name, event] : marks_) cudaEventDestroy(event);
    marks_.clear();
    runs_ = false;
  }

  bool runs_ = false;
  std::vector<std::pair<std::string, cudaEvent_t>> marks_;
};

}  // namespace macadam::kernels
