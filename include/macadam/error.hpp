// SPDX-License-Identifier: GPL-3.0-or-later
/// \file error.hpp  Errors carry the culprit: where it is, what was found, what was expected.
#pragma once

#include <stdexcept>
#include <string>

namespace macadam {

/// Base of everything that Macadam throws on purpose.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The input is wrong (command line exit code 2). The message names file and line, or the particle, and says what was
/// found and what was expected.
class InputError : public Error {
 public:
  using Error::Error;

  /// `file:line: what: found F, expected E`; line 0 means that no line applies.
  InputError(const std::string& file, int line, const std::string& what, const std::string& found,
             const std::string& expected)
      : Error(place(file, line) + ": " + in_one_line(what + ": found " + found + ", expected " + expected)) {}

 private:
  static std::string place(const std::string& file, int line) {
    return line > 0 ? file + ":" + std::to_string(line) : file;
  }
  /// Names in a damaged file, and what libraries say of it, may hold anything: control characters are shown as `?`.
  static std::string in_one_line(std::string text) {
    while (!text.empty() && text.back() == '\n') text.pop_back();
    for (char& c : text)
      if (static_cast<unsigned char>(c) < ' ' || c == 0x7F) c = '?';
    return text;
  }
};

/// The input was good but the run failed (exit code 1): divergence, no device, disk full.
class RunError : public Error {
 public:
  using Error::Error;
};

/// The run was asked to stop, by a signal for instance; the message says where its checkpoint is.
class InterruptedError : public RunError {
 public:
  using RunError::RunError;
};

/// A time step diverged: the first particle that left the range of sense, and when.
class DivergenceError : public RunError {
 public:
  DivergenceError(const std::string& message, long long particle, double time)
      : RunError(message), particle(particle), time(time) {}
  long long particle;  ///< particle number in specimen order
  double time;         ///< [s]
};

}  // namespace macadam
