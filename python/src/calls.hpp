// SPDX-License-Identifier: GPL-3.0-or-later
/// \file calls.hpp  Runs long work of the library from Python. The interpreter's lock is released while the library
/// works, so other Python threads run. Ctrl-C, or an exception in a callback, ends the work.
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

/// One long call from Python. The work asks stop() regularly, or calls progress(), which also asks stop(). An exception
/// of Python that occurs during the work (Ctrl-C, or raised by a callback) is stored, ends the work, and is raised
/// again when the work has returned.
class LongCall {
 public:
  /// progress: None, or a callable that is called with the stage of the work and the fraction of it that is done, 0
  /// to 1.
  explicit LongCall(nb::object progress = nb::none()) : progress_(std::move(progress)) {}

  /// Returns true if the work must end. The work may ask as often as it likes, because signals are checked at most
  /// every 50 ms.
  bool stop() {
    const auto now = Clock::now();
    if (now - last_look_ < std::chrono::milliseconds(50)) return raised_.has_value();
    last_look_ = now;
    const nb::gil_scoped_acquire acquire;
    if (!raised_ && PyErr_CheckSignals() != 0) raised_.emplace();
    return raised_.has_value();
  }

  /// Calls f, which runs Python code, from within the work. An exception of f is stored and ends the work; later calls
  /// of this function do nothing.
  template <class F>
  void call_python(F&& f) {
    const nb::gil_scoped_acquire acquire;
    if (raised_) return;
    try {
      f();
    } catch (nb::python_error& error) { raised_.emplace(std::move(error)); }
  }

  /// Reports progress to Python. \throws InterruptedError if the work must end.
  void progress(const std::string& stage, double fraction) {
    show(stage, fraction);
    if (stop()) throw InterruptedError("interrupted at: " + stage + "; nothing was written");
  }
  /// Reports progress to Python and never throws. Used for work that asks stop() itself.
  void show(const std::string& stage, double fraction) {
    if (!progress_.is_none()) call_python([&] { progress_(stage, fraction); });
  }
  /// Returns progress() as a function for the library. The function must not outlive this object.
  Progress progress_function() {
    return [this](const std::string& stage, double fraction) { progress(stage, fraction); };
  }

  /// Does the work without the interpreter's lock and returns its result. If a callback has raised an exception, or
  /// Ctrl-C was pressed, raises that exception or KeyboardInterrupt instead, whether the work returned or threw.
  template <class F>
  auto operator()(F&& work) {
    try {
      if constexpr (std::is_void_v<decltype(work())>) {
        without_lock(work);
        raise("interrupted");
      } else {
        auto result = without_lock(work);
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
  static auto without_lock(F&& work) {
    const nb::gil_scoped_release release;
    return work();
  }

  /// Raises the stored exception of Python, if there is one. `text` says where the work ended; it becomes the message
  /// of a KeyboardInterrupt.
  void raise(const char* text) {
    if (!raised_) return;
    nb::python_error error = std::move(*raised_);
    raised_.reset();
    if (!error.matches(PyExc_KeyboardInterrupt)) throw error;
    PyErr_SetString(PyExc_KeyboardInterrupt, text);
    throw nb::python_error();
  }

  nb::object progress_;
  Clock::time_point last_look_ = Clock::now();  // last time that signals were checked
  std::optional<nb::python_error> raised_;      // the stored exception
};

}  // namespace macadam::python
