// SPDX-License-Identifier: GPL-3.0-or-later
/// \file itk_with_clang.hpp  To be included before everything else in sources that include ITK. Debian's ITK headers
/// check the compiler and know only GCC, so this file makes Clang look like GCC 12 during the check. Clang accepts the
/// code that the headers select for GCC 12.
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
