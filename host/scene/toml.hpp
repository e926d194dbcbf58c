// SPDX-License-Identifier: GPL-3.0-or-later
/// \file toml.hpp  toml++ with its assertions off in every build type. Some of them hold only for valid TOML (`[=`
/// breaks one): in a debug build they would end the program, and a compiler that takes them as assumptions may drop the
/// checks behind them, which report the error with its line.
#pragma once

#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_ASSERT(condition) static_assert(true)
#define TOML_MAX_NESTED_VALUES 16  // arrays and inline tables in each other
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")
