// SPDX-License-Identifier: GPL-3.0-or-later
/// \file backend.hpp  The choices that decide which code runs a scene, and what this build and machine offer.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace macadam {

enum class Backend : std::uint8_t { automatic, cpu, cuda, reference };
/// Which quantities are double: all; the states of contacts and particles (`mixed`); none but displacements (`single`).
enum class Precision : std::uint8_t { double_, mixed, single };
/// `condensed`: six generalised displacements a contact; `points`: three displacements a contact point, as [1] has it.
/// Both give the same forces: docs/model.md, section 7.
enum class ContactForm : std::uint8_t { condensed, points };
/// `updated`: normals and lever arms follow the particles every step (docs/model.md, section 9); `fixed`: they stay
/// those of the start, for small strain.
enum class Geometry : std::uint8_t { updated, fixed };
/// `local`: F_d = −χ|F|sign(v), component by component; `viscous`: F_d = −β·m·v. docs/model.md, section 10.
enum class Damping : std::uint8_t { none, local, viscous };

const char* to_string(Backend);
const char* to_string(Precision);
const char* to_string(ContactForm);
const char* to_string(Geometry);
const char* to_string(Damping);

/// What one CUDA device says of itself.
struct DeviceInfo {
  int number = 0;  ///< CUDA's own, from 0
  std::string name;
  int compute_capability = 0;  ///< e.g. 90
  std::int64_t memory_bytes = 0;
  int multiprocessors = 0;
};

/// What this build can do on this machine.
struct BackendReport {
  bool cuda_compiled = false;
  std::vector<DeviceInfo> devices;               ///< empty without a usable device
  std::vector<DeviceInfo> devices_without_code;  ///< too old or too new for what this build was compiled for
  std::string cuda_status;                       ///< in words: why there is no device, or how many there are
  int threads = 1;                               ///< OpenMP's maximum
};

/// What a CUDA device can do at the most, as measured.
struct DeviceSpeed {
  std::string name;
  int multiprocessors = 0, driver = 0, runtime = 0;  ///< versions as CUDA numbers them: 13000 is 13.0
  std::int64_t cache_bytes = 0;                      ///< of the second-level cache
  double copy = 0;    ///< bytes read and written in a second by a copy within the memory [byte/s]
  double cache = 0;   ///< likewise within the second-level cache
  double shared = 0;  ///< likewise within the shared memories of all multiprocessors
  double clock = 0;   ///< of the multiprocessors, under load [Hz]
};

/// \throws RunError where the device is not there.
DeviceSpeed measure_device(int device);

/// Looks at the machine; makes no context on any device. Never throws.
BackendReport report_backends();

/// Numbers of CUDA devices: none for the first that can run; several share the work on one specimen, and results do not
/// depend on how many they are. A number given twice takes two shares. `every_device` alone: all that can run.
using DeviceList = std::vector<int>;
inline constexpr int every_device = -1;
/// "0, 1 and 3", "all"; empty for none.
std::string to_string(const DeviceList& devices);

/// Resolves `automatic` to cuda where the build has it and a device answers, else cpu; `reason` (optional) says why.
/// `devices` are those that are meant, where some are; `automatic` then is cuda. A context is made on them or, without
/// a number, on the first usable one. \throws RunError when cuda is asked for and is not there; InputError for a number
/// that no usable device has, or beside another backend.
Backend select_backend(Backend asked, std::string* reason = nullptr, const DeviceList& devices = {});

}  // namespace macadam
