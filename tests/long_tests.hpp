// SPDX-License-Identifier: GPL-3.0-or-later
/// \file long_tests.hpp  Whether runs of very many steps are worth their time: not against a library full of checks.
#pragma once

#include <cstdlib>

namespace macadam::test {

inline const bool long_tests = std::getenv("MACADAM_SHORT_TESTS") == nullptr;

}  // namespace macadam::test
