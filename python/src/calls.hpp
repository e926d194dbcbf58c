// SPDX-License-Identifier: GPL-3.0-or-later
/// \file calls.hpp  Long calls: the interpreter is free meanwhile, and Ctrl-C or a callback that raises ends them.
#pragma once

#include <nanobind/nanobind.h>

#include <chrono>
#include <mutex>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "macadam/error.hpp"
#include "macadam/simulation.hpp"

namespace macadam::python {

namespace nb = nanobind;

/// One long call. Threads of other calls, and of Python, run beside it.
class LongCall {
 public:
  /// `progress`: None, or what is called with (stage, share) as the work goes on.
  explicit LongCall(nb::object progress = nb::none()) : progress_(std::move(progress)) {}

  /// Whether the work is to end: asked by the work itself, at any rate.
  bool stop() {
    const auto now = Clock::now();
    if (now - looked_ < std::chrono::milliseconds(50)) return raised_.has_value();
    looked_ = now;
    const nb::gil_scoped_acquire acquire;
    if (!raised_ && PyErr_CheckSignals() != 0) raised_.emplace();
    return raised_.has_value();
  }

  /// Calls something of Python from within the work. What it raises ends the work.
  template <class F>
  void tell(F&& f) {
    const nb::gil_scoped_acquire acquire;
    if (raised_) return;
    try {
      f();
    } catch (nb::python_error& error) { raised_.emplace(std::move(error)); }
  }

  /// Tells how far the work is. \throws InterruptedError where it is to end.
  void progress(const std::string& stage, double share) {
    show(stage, share);
    if (stop()) throw InterruptedError("interrupted at: " + stage + "; nothing was written");
  }
  /// The same of work that asks stop() itself.
  void show(const std::string& stage, double share) {
    if (!progress_.is_none()) tell([&] { progress_(stage, share); });
  }
  Progress progress_function() {
    return [this](const std::string& stage, double share) { progress(stage, share); };
  }

  /// Does the work without the interpreter's lock, and raises what a callback raised, or Ctrl-C, however the work
  /// ended.
  template <class F>
  auto operator()(F&& work) {
    try {
      if constexpr (std::is_void_v<decltype(work())>) {
        released(work);
        raise("interrupted");
      } else {
        auto result = released(work);
        raise("interrupted");
        return result;
      }
    } catch (const Error& error) {
      raise(error.what());
      throw;
    }
  }

 private:
  using Clock = std::chrono::steady_clock;

  template <class F>
  static auto released(F&& work) {
    const nb::gil_scoped_release release;
    return work();
  }

  /// Raises what Python raised meanwhile, Ctrl-C with what the work says of its end.
  void raise(const char* text) {
    if (!raised_) return;
    nb::python_error error = std::move(*raised_);
    raised_.reset();
    if (!error.matches(PyExc_KeyboardInterrupt)) throw error;
    PyErr_SetString(PyExc_KeyboardInterrupt, text);
    throw nb::python_error();
  }

  nb::object progress_;
  Clock::time_point looked_ = Clock::now();
  std::optional<nb::python_error> raised_;
};

}  // namespace macadam::python
