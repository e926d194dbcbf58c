# SPDX-License-Identifier: GPL-3.0-or-later
# Makes one library that runs on any x86-64 processor and is fast on new ones. The time step and the iteration of the
# frequency domain are compiled again for each newer generation of processors (v3, v4). At run time the library chooses
# the newest code that the processor can run. In each of these parts all symbols are made local, except the table of the
# functions for the time step and the table of those for the frequency domain. Otherwise the linker would keep only one
# copy of a template that occurs in several parts (also of templates of the standard library), and an old processor
# could be given instructions that it lacks.
function(macadam_add_processors library sources)
  foreach(level v3 v4)
    set(part macadam_code_${level})
    add_library(${part} OBJECT ${sources})
    target_link_libraries(${part} PRIVATE macadam_options OpenMP::OpenMP_CXX fmt::fmt Eigen3::Eigen)
    # Without -fno-gnu-unique gcc would make some symbols unique, and unique symbols cannot be made local.
    target_compile_options(${part} PRIVATE -Wno-psabi -march=x86-64-${level} ${MACADAM_PACKETS} -fno-gnu-unique)
    target_compile_definitions(${part} PRIVATE MACADAM_CODE=${part} MACADAM_CODE_NAME="x86-64-${level}"
      MACADAM_HARMONIC_CODE=macadam_harmonic_code_${level})
    set(joined ${CMAKE_CURRENT_BINARY_DIR}/${part}.o)
    add_custom_command(OUTPUT ${joined}
      COMMAND ${CMAKE_LINKER} -r --force-group-allocation -o ${joined} $<TARGET_OBJECTS:${part}>
      COMMAND ${CMAKE_OBJCOPY} --keep-global-symbol=${part}
        --keep-global-symbol=macadam_harmonic_code_${level} ${joined}
      DEPENDS ${part} $<TARGET_OBJECTS:${part}> COMMAND_EXPAND_LISTS VERBATIM)
    set_source_files_properties(${joined} PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
    target_sources(${library} PRIVATE ${joined})
  endforeach()
endfunction()
