# SPDX-License-Identifier: GPL-3.0-or-later
# Sets the compile options of Macadam's own code. They are not passed on to users of the library.
add_library(macadam_options INTERFACE)
target_include_directories(macadam_options INTERFACE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/include)
target_compile_options(macadam_options INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra>)
# A value of an enumeration that a list of names or cases leaves out is an error, never another value's name
target_compile_options(macadam_options INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Werror=switch>)
# A product followed by a sum is rounded twice, with every compiler, option and processor, so that results have the same
# bits everywhere. Otherwise gcc and clang would use fused multiply-add if the processor supports it, each in different
# places.
target_compile_options(macadam_options INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-ffp-contract=off>)
# Eigen's own threads would split sums according to the number of threads, so results would depend on this number. The
# thread sanitizer would also report the way in which these threads wait for one another as a race.
target_compile_definitions(macadam_options INTERFACE $<$<COMPILE_LANGUAGE:CXX>:EIGEN_DONT_PARALLELIZE>)
if(MACADAM_WERROR)
  target_compile_options(macadam_options INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Werror>)
endif()
# In release builds, names of files in the code are relative to the sources, so that builds in different folders give
# the same bytes (scripts/reproducible). In other builds the names stay absolute, because debuggers and coverage tools
# look for the files.
target_compile_options(macadam_options INTERFACE $<$<AND:$<COMPILE_LANGUAGE:CXX>,$<CONFIG:Release>>:
                       -ffile-prefix-map=${PROJECT_SOURCE_DIR}=. -ffile-prefix-map=${PROJECT_BINARY_DIR}=build>)
# Clang 14 and 16 miscompile libstdc++'s packets (std::experimental::simd) for AVX-512: assignments to lanes that a mask
# of doubles selects are lost, so that bonds would not break.
set(MACADAM_PACKETS $<$<CXX_COMPILER_ID:Clang>:-mno-avx512f>)
# the warning is about passing packets between libraries, but they are used only within one file
set(MACADAM_STEP_OPTIONS -Wno-psabi)
if(MACADAM_NATIVE)
  list(APPEND MACADAM_STEP_OPTIONS -march=native ${MACADAM_PACKETS})
endif()
# These checks are switched off: the address sanitizer finds null pointers and accesses beyond objects anyway, and
# together with the checks of alignment and of types they take a third of the build time.
set(MACADAM_CHECKS -fno-sanitize=null,alignment,object-size,vptr -fno-sanitize-recover=all -fno-omit-frame-pointer)
# The time step's inlined packets have thousands of temporaries. With checks of each one on the stack, gcc would need
# ten minutes per file. The step's arrays are on the heap, where every access is still checked.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(MACADAM_CHECKS_OF_STEP "--param=asan-stack=0")
endif()
if(MACADAM_SANITIZE)
  target_compile_options(macadam_options INTERFACE "$<$<COMPILE_LANGUAGE:CXX>:-fsanitize=${MACADAM_SANITIZE};${MACADAM_CHECKS}>")
  # The library's functions must call the library's own copies of templates, not the copies of a program built without
  # sanitizers.
  target_link_options(macadam_options INTERFACE -fsanitize=${MACADAM_SANITIZE} -Wl,-Bsymbolic-functions)
  # Without this definition, Eigen would pad allocations in files that are compiled with the address sanitizer but not
  # in the other files, although memory allocated in one may be freed in another.
  target_compile_definitions(macadam_options INTERFACE $<$<COMPILE_LANGUAGE:CXX>:EIGEN_MALLOC_ALREADY_ALIGNED=1>)
  set(MACADAM_SANITIZE_STEP ${MACADAM_CHECKS_OF_STEP})
  # CGAL's templates (wraps, trees, hulls) take gcc up to ten minutes per file with sanitizers. The files that use them
  # contain little other code, so gcc compiles them without sanitizers. Clang checks them (preset checked-cgal).
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    set(MACADAM_SANITIZE_CGAL "-fno-sanitize=all")
  endif()
endif()
if(MACADAM_COVERAGE)
  # Coverage is counted in the library only, and without atomic operations, which made a step of two threads ten times
  # slower. A lost count does not matter, because the question is only whether a line ran at all.
  set(MACADAM_COVER --coverage -fprofile-update=single -fprofile-exclude-files=/usr/.*)
  target_link_options(macadam_options INTERFACE --coverage)
endif()

# Precompiles the headers that most sources of a target need, and those in ARGN. This saves a fifth of the build time.
function(macadam_precompile target)
  target_precompile_headers(${target} PRIVATE <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <limits> <map>
                            <numbers> <numeric> <optional> <sstream> <string> <vector> <fmt/format.h> ${ARGN})
endfunction()

# Compiles sources of the targets in groups of eight, except sources with options of their own. Headers and templates
# that a group shares are read and compiled once, which saves a third of the time of a full build.
function(macadam_unite)
  if(MACADAM_UNITY)
    set_target_properties(${ARGN} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
  endif()
endfunction()

# ccache needs -fpch-preprocess for precompiled headers. The other options switch off false warnings: gcc 12 warns of
# concatenated std::string (bug 105329) and of Eigen's fixed-size kernels, gcc 14 of copies of vectors.
target_compile_options(macadam_options INTERFACE $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fpch-preprocess -Wno-restrict
  -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds -Wno-maybe-uninitialized -Wno-free-nonheap-object>)
