// SPDX-License-Identifier: GPL-3.0-or-later
/// \file long_tests.hpp  Says whether tests with very many steps run. MACADAM_SHORT_TESTS turns them off, for builds in
/// which checks (such as sanitizers) make every step slow.
#pragma once

#include <cstdlib>

namespace macadam::test {

inline const bool long_tests = std::getenv("MACADAM_SHORT_TESTS") == nullptr;

}  // namespace macadam::test
