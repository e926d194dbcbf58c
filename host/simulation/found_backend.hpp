// SPDX-License-Identifier: GPL-3.0-or-later
/// \file found_backend.hpp  Looks for the backend of a run in another thread, while the specimen is made.
#pragma once

#include <chrono>
#include <future>

#include "host/backends/choose_devices.hpp"
#include "host/simulation/refused_combinations.hpp"
#include "macadam/simulation.hpp"

namespace macadam {

/// The backend that runs the scene. Another thread looks for it: the devices are counted and start up while the
/// specimen is made.
class FoundBackend {
 public:
  /// Begins to look for the backend, and waits for the result for at most `wait`. \throws as select_backend(), if the
  /// search fails within that time. That a device exists but cannot be used may become known only later.
  FoundBackend(const Scene& scene, std::chrono::milliseconds wait) : asked_(requested_backend(scene)) {
    const auto select = [asked = asked_, devices = scene.solver.devices] {
      return select_backend(asked, nullptr, devices);
    };
    if (asked_ == Backend::cuda || asked_ == Backend::automatic) {
      waking_ = std::async(select);  // runs in this thread if no other thread can be started
      waking_.wait_for(wait);
      look();
    } else {
      asked_ = select();
    }
  }
  /// Checks whether the search for a backend has failed by now, so that a scene that cannot run is not prepared to the
  /// end. \throws as select_backend() if it has.
  void look() {
    if (waking_.valid() && waking_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) get();
  }
  /// Waits for the backend and returns it. \throws as select_backend().
  Backend get() { return waking_.valid() ? asked_ = waking_.get() : asked_; }

 private:
  Backend asked_;
  std::future<Backend> waking_;
};

}  // namespace macadam
