# SPDX-License-Identifier: GPL-3.0-or-later
# Asks scripts/version for the version, before project() needs it. MACADAM_VERSION is the full version (0.1.0+3.gHASH),
# MACADAM_NUMBER the part that project() accepts (0.1.0), MACADAM_COMMIT the commit at the time when CMake last
# configured.
function(macadam_ask_version result)
  execute_process(COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/scripts/version ${ARGN} OUTPUT_VARIABLE said
                  OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  set(${result} ${said} PARENT_SCOPE)
endfunction()
macadam_ask_version(MACADAM_VERSION)
macadam_ask_version(MACADAM_NUMBER --number)
macadam_ask_version(MACADAM_COMMIT --commit)
macadam_ask_version(source --source)
message(STATUS "Macadam ${MACADAM_VERSION} (${source})")

# A new commit or tag makes CMake configure again. In a worktree git's files are elsewhere, so git is asked for their
# paths.
set(asked CHANGELOG.md scripts/version)
if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/.git)
  execute_process(COMMAND git rev-parse --git-path logs/HEAD --git-path refs/tags WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}
                  OUTPUT_VARIABLE paths OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  if(NOT failed)
    string(REPLACE "\n" ";" paths "${paths}")
    list(APPEND asked ${paths})
  endif()
endif()
foreach(file ${asked})
  get_filename_component(file ${file} ABSOLUTE BASE_DIR ${CMAKE_CURRENT_SOURCE_DIR})
  if(EXISTS ${file})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  endif()
endforeach()
