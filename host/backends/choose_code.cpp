// SPDX-License-Identifier: GPL-3.0-or-later
// choose_code.cpp  Chooses the processor generation whose code runs.
#include <cstdlib>
#include <string_view>

#include "host/backends/processor_code.hpp"

namespace macadam {

extern "C" {
extern const ProcessorCode macadam_code_base;
#ifdef MACADAM_ALL_PROCESSORS
extern const ProcessorCode macadam_code_v3, macadam_code_v4;
#endif
}

namespace {

/// Returns the newest generation that the processor supports, but none newer than the environment variable
/// MACADAM_PROCESSOR says.
ProcessorGeneration newest_generation() {
#ifdef MACADAM_ALL_PROCESSORS
  const char* const named = std::getenv("MACADAM_PROCESSOR");
  const std::string_view most = named ? named : "";
  __builtin_cpu_init();
  if (most != "x86-64" && most != "x86-64-v3" && __builtin_cpu_supports("x86-64-v4")) return ProcessorGeneration::v4;
  if (most != "x86-64" && __builtin_cpu_supports("x86-64-v3")) return ProcessorGeneration::v3;
#endif
  return ProcessorGeneration::base;
}

}  // namespace

ProcessorGeneration processor_generation() {
  static const ProcessorGeneration generation = newest_generation();
  return generation;
}

const ProcessorCode& processor_code() {
  switch (processor_generation()) {
#ifdef MACADAM_ALL_PROCESSORS
    case ProcessorGeneration::v4:
      return macadam_code_v4;
    case ProcessorGeneration::v3:
      return macadam_code_v3;
#endif
    default:
      return macadam_code_base;
  }
}

}  // namespace macadam
