// SPDX-License-Identifier: GPL-3.0-or-later
/// \file error.hpp  Defines the exceptions. A message says where the fault is, the value found and the value expected.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

namespace macadam {

/// Base class of all exceptions that Macadam throws on purpose.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The parts of a message about a wrong input.
struct InputCulprit {
  std::string file = {};  ///< file or option
  int line = 0;           ///< 0: no line applies
  std::string what = {};  ///< key, as messages name it: "[solver] method"
  std::string found = {}, expected = {};
};

/// The input is wrong (command line exit code 2). The message names file and line, or the particle, and says the value
/// found and the value expected.
class InputError : public Error {
 public:
  using Error::Error;

  /// Makes the message `file:line: what: found F, expected E`. Line 0 means that no line applies.
  InputError(const std::string& file, int line, const std::string& what, const std::string& found,
             const std::string& expected)
      : Error(place(file, line) + ": " + in_one_line(what + ": found " + found + ", expected " + expected)),
        culprit_(std::make_shared<const InputCulprit>(InputCulprit{file, line, what, found, expected})) {}

  /// Returns the parts of the message; nullptr if the error was made of a whole message.
  const InputCulprit* culprit() const noexcept { return culprit_.get(); }

 private:
  static std::string place(const std::string& file, int line) {
    return line > 0 ? file + ":" + std::to_string(line) : file;
  }
  /// Replaces control characters by `?`, because names in a damaged file, and messages of libraries about such a file,
  /// may contain them.
  static std::string in_one_line(std::string text) {
    while (!text.empty() && text.back() == '\n') text.pop_back();
    for (char& c : text)
      if (static_cast<unsigned char>(c) < ' ' || c == 0x7F) c = '?';
    return text;
  }

  std::shared_ptr<const InputCulprit> culprit_;  ///< shared, because copying an exception must not fail
};

/// The input was correct but the run failed (exit code 1), for example because it diverged, because there is no device,
/// or because the disk is full.
class RunError : public Error {
 public:
  using Error::Error;
};

/// The run was asked to stop, for example by a signal. The message says where the checkpoint of the run is.
class InterruptedError : public RunError {
 public:
  using RunError::RunError;
};

/// A time step diverged. Holds the first particle that moved too far, and the time.
class DivergenceError : public RunError {
 public:
  DivergenceError(const std::string& message, long long particle, double time)
      : RunError(message), particle(particle), time(time) {}
  long long particle;  ///< particle number in specimen order
  double time;         ///< [s]
};

}  // namespace macadam
