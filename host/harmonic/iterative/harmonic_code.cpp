// SPDX-License-Identifier: GPL-3.0-or-later
// harmonic_code.cpp  Defines the table of the frequency domain's functions compiled for one processor generation.
// CMakeLists.txt compiles this file once for each generation, with its own MACADAM_HARMONIC_CODE as the name of the
// table.
#include "host/harmonic/harmonic_code.hpp"

#include "host/harmonic/iterative/block_cocg.hpp"

#ifndef MACADAM_HARMONIC_CODE
#define MACADAM_HARMONIC_CODE macadam_harmonic_code_base
#endif

namespace macadam::harmonic {

extern "C" {
extern const HarmonicCode MACADAM_HARMONIC_CODE;
const HarmonicCode MACADAM_HARMONIC_CODE{solve_block, check_solutions};
}

}  // namespace macadam::harmonic
