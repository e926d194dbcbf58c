# SPDX-License-Identifier: GPL-3.0-or-later
# Code for any x86-64 processor that is fast on new ones: the time step and the iteration of the frequency domain are compiled
# once more for each newer generation, and the library takes the newest that the processor runs. In each such part, all
# symbols but its entry are made local: templates that several parts have, of the standard library too, must not be joined,
# or an old processor would meet instructions of a new one.
function(macadam_add_processors library sources)
  foreach(level v3 v4)
    set(part macadam_code_${level})
    add_library(${part} OBJECT ${sources})
    target_link_libraries(${part} PRIVATE macadam_options OpenMP::OpenMP_CXX fmt::fmt Eigen3::Eigen)
    target_compile_options(${part} PRIVATE -Wno-psabi -march=x86-64-${level} ${MACADAM_PACKETS} -fno-gnu-unique)  # what is unique cannot be made local
    target_compile_definitions(${part} PRIVATE MACADAM_CODE=${part} MACADAM_CODE_NAME="x86-64-${level}")
    set(joined ${CMAKE_CURRENT_BINARY_DIR}/${part}.o)
    add_custom_command(OUTPUT ${joined}
      COMMAND ${CMAKE_LINKER} -r --force-group-allocation -o ${joined} $<TARGET_OBJECTS:${part}>
      COMMAND ${CMAKE_OBJCOPY} --keep-global-symbol=${part} ${joined}
      DEPENDS ${part} $<TARGET_OBJECTS:${part}> COMMAND_EXPAND_LISTS VERBATIM)
    set_source_files_properties(${joined} PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
    target_sources(${library} PRIVATE ${joined})
  endforeach()
endfunction()
