// SPDX-License-Identifier: GPL-3.0-or-later
/// \file toml.hpp  Includes toml++ with its assertions turned off in every build type. Some assertions hold only
/// for valid TOML; the text `[=` violates one. In a debug build a failed assertion would end the program. A compiler
/// that treats assertions as assumptions may remove the checks that follow an assertion, and those checks report the
/// error with its line.
#pragma once

#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_ASSERT(condition) static_assert(true)
#define TOML_MAX_NESTED_VALUES 16  // depth of nested arrays and inline tables
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")
