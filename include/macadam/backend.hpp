// SPDX-License-Identifier: GPL-3.0-or-later
/// \file backend.hpp  Defines the options that decide which code runs a scene (backend, precision, form, geometry,
/// damping), and reports which backends and devices (GPUs) this build can use on this machine.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace macadam {

/// The code that computes one run. `automatic`: cuda if possible, else cpu.
enum class Backend : std::uint8_t { automatic, cpu, cuda, reference };
/// The quantities that are stored in double precision. `double_`: all quantities; `mixed`: the states of contacts and
/// particles, and displacements; `single`: only displacements.
enum class Precision : std::uint8_t { double_, mixed, single };
/// The degrees of freedom of a contact. `condensed`: six generalised displacements per contact; `points`: three
/// displacements per contact point, as in [1]. Both give the same forces: docs/model.md, section 7.
enum class ContactForm : std::uint8_t { condensed, points };
/// The geometry of the contacts. `updated`: normals and lever arms follow the particles in every step (docs/model.md,
/// section 9). `fixed`: normals and lever arms keep their initial values, for small strain.
enum class Geometry : std::uint8_t { updated, fixed };
/// The damping force on a particle. `local`: F_d = −χ|F|sign(v), for each component; `viscous`: F_d = −β·m·v. See
/// docs/model.md, section 10.
enum class Damping : std::uint8_t { none, local, viscous };

const char* to_string(Backend);
const char* to_string(Precision);
const char* to_string(ContactForm);
const char* to_string(Geometry);
const char* to_string(Damping);

/// Properties of one CUDA device.
struct DeviceInfo {
  int number = 0;  ///< CUDA's own number, from 0
  std::string name;
  int compute_capability = 0;  ///< for example 90
  std::int64_t memory_bytes = 0;
  int multiprocessors = 0;
};

/// The devices and threads that this build can use on this machine.
struct BackendReport {
  bool cuda_compiled = false;
  std::vector<DeviceInfo> devices;               ///< usable devices
  std::vector<DeviceInfo> devices_without_code;  ///< devices that cannot run the code of this build
  std::string cuda_status;                       ///< in words: the number of usable devices, or why no device is usable
  int threads = 1;                               ///< OpenMP's largest number of threads
  /// The processor generation for which the CPU code that runs here was compiled: "native" (this machine), "x86-64",
  /// "x86-64-v3" (AVX2) or "x86-64-v4" (AVX-512).
  std::string processor;
};

/// Largest speeds of a CUDA device, as measured.
struct DeviceSpeed {
  std::string name;
  /// Number of multiprocessors. `driver`, `runtime`: versions in CUDA's numbering (13000 means 13.0).
  int multiprocessors = 0, driver = 0, runtime = 0;
  std::int64_t cache_bytes = 0;  ///< size of the L2 cache
  double copy = 0;               ///< bytes read and written per second by a copy within the device memory [byte/s]
  double cache = 0;              ///< as `copy`, but within the L2 cache [byte/s]
  double shared = 0;             ///< as `copy`, but within the shared memories of all multiprocessors [byte/s]
  double clock = 0;              ///< clock frequency of the multiprocessors under load [Hz]
};

/// Measures one device. \throws RunError if the device does not exist.
DeviceSpeed measure_device(int device);

/// Returns the devices and threads that this build can use on this machine. Creates no context on any device. Never
/// throws.
BackendReport report_backends();

/// Numbers of CUDA devices. An empty list means the first device that can run. Several devices step one specimen
/// together; results do not depend on how many devices there are. A device whose number is given twice takes two parts
/// of the work. A list with only `every_device` means all devices that can run.
using DeviceList = std::vector<int>;
inline constexpr int every_device = -1;
/// Returns "0, 1 and 3", "all", or an empty text for an empty list.
std::string to_string(const DeviceList& devices);

/// Resolves `automatic` to cuda if this build includes CUDA and a device answers, else to cpu. `reason` (optional)
/// receives the reason for the choice. If `devices` names devices, `automatic` is cuda. Creates a context on these
/// devices or, without numbers, on the first usable one. \throws RunError if cuda is asked for but not available;
/// InputError for a number that no usable device has, or for numbers together with another backend.
Backend select_backend(Backend asked, std::string* reason = nullptr, const DeviceList& devices = {});

}  // namespace macadam
