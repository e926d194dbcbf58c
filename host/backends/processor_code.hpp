// SPDX-License-Identifier: GPL-3.0-or-later
/// \file processor_code.hpp  Declares the time step on the CPU, whose speed depends on the SIMD registers of the
/// processor. The code of the time step is compiled once for each processor generation. At run time the newest
/// generation that the processor supports is chosen. The functions of the frequency domain for this generation are in a
/// table of their own: host/harmonic/harmonic_code.hpp.
#pragma once

#include <cstdint>
#include <memory>

#include "macadam/stepper.hpp"

namespace macadam {

/// Generations of x86-64 processors: base runs on any of them, v3 has AVX2, v4 has AVX-512.
enum class ProcessorGeneration : std::uint8_t { base, v3, v4 };

/// The time step compiled for one processor generation.
struct ProcessorCode {
  const char* name;  ///< "native": compiled for this machine; "x86-64", "x86-64-v3" (AVX2), "x86-64-v4" (AVX-512)
  std::unique_ptr<Stepper> (*make_stepper)(const Specimen& specimen, const ContactNetwork& network,
                                           const LawTable& laws, const Inertia& inertia, const StepperOptions& options,
                                           std::unique_ptr<Stepper> used);
};

/// Returns the newest generation that this processor can run and for which the library has code. A build for this
/// machine alone (MACADAM_NATIVE) has only `base`. The environment variable MACADAM_PROCESSOR (x86-64, x86-64-v3,
/// x86-64-v4) asks for an older generation.
ProcessorGeneration processor_generation();

/// Returns the code for the generation that processor_generation() returns.
const ProcessorCode& processor_code();

}  // namespace macadam
