# SPDX-License-Identifier: GPL-3.0-or-later
# Finds what the Python package needs: an interpreter, its headers, and nanobind. Debian 12 does not have nanobind, so
# scripts/python installs it into build/python, which is used if it exists.
set(MACADAM_HAS_PYTHON OFF)
if(MACADAM_PYTHON STREQUAL "OFF" OR (MACADAM_PYTHON STREQUAL "AUTO" AND (MACADAM_SANITIZE OR MACADAM_COVERAGE)))
  message(STATUS "Python package: OFF")
  return()
endif()
if(NOT Python_EXECUTABLE AND EXISTS ${PROJECT_SOURCE_DIR}/build/python/bin/python3)
  set(Python_EXECUTABLE ${PROJECT_SOURCE_DIR}/build/python/bin/python3)
endif()
if(CMAKE_VERSION VERSION_GREATER_EQUAL 3.26)
  set(stable Development.SABIModule)
endif()
find_package(Python 3.11 QUIET COMPONENTS Interpreter Development.Module OPTIONAL_COMPONENTS ${stable})
if(Python_FOUND)
  execute_process(COMMAND ${Python_EXECUTABLE} -m nanobind --cmake_dir OUTPUT_VARIABLE nanobind_ROOT
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  find_package(nanobind CONFIG QUIET)
endif()
if(nanobind_FOUND)
  set(MACADAM_HAS_PYTHON ON)
elseif(MACADAM_PYTHON STREQUAL "ON")
  message(FATAL_ERROR "MACADAM_PYTHON=ON but no Python of at least 3.11 with headers and nanobind was found; run scripts/python or "
                      "use MACADAM_PYTHON=AUTO")
endif()
message(STATUS "Python package: ${MACADAM_HAS_PYTHON}")
