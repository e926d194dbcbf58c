// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cuda_part_clock.hpp  How long the parts of a step take on a device: events between them.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "kernels/cuda_launch.hpp"

namespace macadam::kernels {

/// Does nothing until it is started.
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
  /// What was queued since the last call was `part`.
  void end_of(const char* part, cudaStream_t stream) {
    if (!runs_) return;
    cudaEvent_t event = nullptr;
    check_cuda(cudaEventCreate(&event), "event");
    marks_.emplace_back(part, event);
    check_cuda(cudaEventRecord(event, stream), "event");
  }
  /// Seconds of each part in all, once all is done.
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
