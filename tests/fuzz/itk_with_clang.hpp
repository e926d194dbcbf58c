// SPDX-License-Identifier: GPL-3.0-or-later
/// \file itk_with_clang.hpp  Before all else in sources that include ITK: Debian's headers of it ask which compiler
/// this is, and know GCC alone. What they do then, Clang does too.
#pragma once

#pragma push_macro("__clang__")
#pragma push_macro("__GNUC__")
#pragma push_macro("__GNUC_MINOR__")
#undef __clang__
#undef __GNUC__
#undef __GNUC_MINOR__
#define __GNUC__ 12
#define __GNUC_MINOR__ 2
#include <itk_compiler_detection.h>
#pragma pop_macro("__clang__")
#pragma pop_macro("__GNUC__")
#pragma pop_macro("__GNUC_MINOR__")
