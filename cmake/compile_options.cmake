# SPDX-License-Identifier: GPL-3.0-or-later
# Options of our own code; never passed on to users of the library.
add_library(macadam_options INTERFACE)
target_include_directories(macadam_options INTERFACE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/include)
target_compile_options(macadam_options INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra>)
# A product and a sum are rounded twice, whatever the compiler, its options and the processor: the same bits everywhere. gcc
# and clang would join them in one rounding where the processor can, each in places of its own choice.
target_compile_options(macadam_options INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-ffp-contract=off>)
# Eigen's own threads would cut sums as their number has it, and wait for one another in a way that looks like a race.
target_compile_definitions(macadam_options INTERFACE $<$<COMPILE_LANGUAGE:CXX>:EIGEN_DONT_PARALLELIZE>)
if(MACADAM_WERROR)
  target_compile_options(macadam_options INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Werror>)
endif()
# The same bytes wherever the sources lie (scripts/reproducible): names of files as seen from them. Not where a debugger or the
# counters of coverage look for the files.
target_compile_options(macadam_options INTERFACE $<$<AND:$<COMPILE_LANGUAGE:CXX>,$<CONFIG:Release>>:
                       -ffile-prefix-map=${PROJECT_SOURCE_DIR}=. -ffile-prefix-map=${PROJECT_BINARY_DIR}=build>)
# Compiled by clang 14 or 16 for AVX-512, libstdc++'s packets (std::experimental::simd) lose what is assigned to lanes that a
# mask of doubles chooses: bonds would not break.
set(MACADAM_PACKETS $<$<CXX_COMPILER_ID:Clang>:-mno-avx512f>)
set(MACADAM_STEP_OPTIONS -Wno-psabi)  # the warning speaks of calls between libraries, and packets never leave their files
if(MACADAM_NATIVE)
  list(APPEND MACADAM_STEP_OPTIONS -march=native ${MACADAM_PACKETS})
endif()
# Null pointers and ends of objects are the address sanitizer's too; asked twice, and with alignment and types of objects,
# they take a third of a build.
set(MACADAM_CHECKS -fno-sanitize=null,alignment,object-size,vptr -fno-sanitize-recover=all -fno-omit-frame-pointer)
# The step's inlined packets have thousands of temporaries: watching each on the stack takes gcc ten minutes a file.
# Its arrays are on the heap, where every access is still checked.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(MACADAM_CHECKS_OF_STEP "--param=asan-stack=0")
endif()
if(MACADAM_SANITIZE)
  target_compile_options(macadam_options INTERFACE "$<$<COMPILE_LANGUAGE:CXX>:-fsanitize=${MACADAM_SANITIZE};${MACADAM_CHECKS}>")
  # Functions of the library call its own copies of templates, not those of a program built without checks.
  target_link_options(macadam_options INTERFACE -fsanitize=${MACADAM_SANITIZE} -Wl,-Bsymbolic-functions)
  # Eigen would pad what it allocates in files that the address sanitizer watches, and not in those that are left out: what
  # one allocates another frees.
  target_compile_definitions(macadam_options INTERFACE $<$<COMPILE_LANGUAGE:CXX>:EIGEN_MALLOC_ALREADY_ALIGNED=1>)
  set(MACADAM_SANITIZE_STEP ${MACADAM_CHECKS_OF_STEP})
  # CGAL's wraps, trees and hulls take gcc up to ten minutes a file: those files are thin shells around them. Clang checks them.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    set(MACADAM_SANITIZE_CGAL "-fno-sanitize=all")
  endif()
endif()
if(MACADAM_COVERAGE)
  # Of the library only, and counted without atomics, which made a step of two threads ten times slower: a lost count
  # does not matter where the question is whether a line ran at all.
  set(MACADAM_COVER --coverage -fprofile-update=single -fprofile-exclude-files=/usr/.*)
  target_link_options(macadam_options INTERFACE --coverage)
endif()

# The headers that most sources of a target need, parsed once: a fifth of the time of a build.
function(macadam_precompile target)
  target_precompile_headers(${target} PRIVATE <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <limits> <map>
                            <numbers> <numeric> <optional> <sstream> <string> <vector> <fmt/format.h> ${ARGN})
endfunction()

# Eight sources of a target as one, but those with options of their own: headers and templates that they share are read and
# compiled once, a third of the time of a build from nothing.
function(macadam_unite)
  if(MACADAM_UNITY)
    set_target_properties(${ARGN} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
  endif()
endfunction()

# gcc 12 misreads std::string concatenation (bug 105329) and Eigen's fixed-size kernels, and gcc 14 copies of vectors; ccache needs
# the first for precompiled headers
target_compile_options(macadam_options INTERFACE $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fpch-preprocess -Wno-restrict
  -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds -Wno-maybe-uninitialized -Wno-free-nonheap-object>)
