// SPDX-License-Identifier: GPL-3.0-or-later
/// \file long_tests.hpp  Whether runs of very many steps are worth their time: not in sanitizer and coverage builds.
#pragma once

namespace macadam::test {

#ifdef MACADAM_LONG_TESTS
inline constexpr bool long_tests = true;
#else
inline constexpr bool long_tests = false;
#endif

}  // namespace macadam::test
