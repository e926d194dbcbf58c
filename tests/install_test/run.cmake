# SPDX-License-Identifier: GPL-3.0-or-later
# Installs a build. Then builds and runs a project that uses the installed library, the tutorial, and the installed
# program:
#   cmake -D BUILD=<build folder> -D WORK=<scratch folder> -D COMPILER=<C++ compiler> -D NUMBER=<version> -P run.cmake
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# Libraries that the installed package must not require of its users
foreach(library CGAL Boost Eigen3 fmt nlohmann_json tomlplusplus CLI11 ZLIB HDF5 ITK OpenMP CUDAToolkit)
  list(APPEND absent -D CMAKE_DISABLE_FIND_PACKAGE_${library}=ON)
endforeach()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${WORK}/build -G Ninja ${absent} -D MACADAM_NUMBER=${NUMBER}
    -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_PREFIX_PATH=${WORK}/prefix)
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/macadam_user)
set(examples ${WORK}/prefix/share/macadam/examples)
run(${CMAKE_COMMAND} -S ${examples}/tutorial -B ${WORK}/tutorial -G Ninja ${absent}
    -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_PREFIX_PATH=${WORK}/prefix)
run(${CMAKE_COMMAND} --build ${WORK}/tutorial)
execute_process(COMMAND ${WORK}/tutorial/tutorial ${examples}/demo/scene.toml ${WORK}/tutorial/results
                OUTPUT_VARIABLE said COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)  # fails if the two |E*| differ
string(REPLACE "\n" "\n    " said "    ${said}")
string(STRIP "${said}" said)
file(READ ${examples}/tutorial/README.md page)
string(FIND "${page}" "${said}" at)
if(at EQUAL -1)
  message(FATAL_ERROR "examples/tutorial/README.md: expected the tutorial's output, found another:\n    ${said}")
endif()
# the examples with a user's own laws and loads fail if their results differ from closed forms
foreach(example own_law own_loading)
  run(${CMAKE_COMMAND} -S ${examples}/${example} -B ${WORK}/${example} -G Ninja
      -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_PREFIX_PATH=${WORK}/prefix)
  run(${CMAKE_COMMAND} --build ${WORK}/${example})
  run(${WORK}/${example}/${example})
endforeach()
run(${WORK}/prefix/bin/macadam info)
run(${WORK}/prefix/bin/macadam fit ${examples}/laws/mastic.csv --shift wlf --units 3 --out ${WORK}/law)
foreach(file prefix/share/macadam/draw-fit prefix/share/macadam/draw-calibration law/law.toml
             prefix/share/man/man1/macadam.1 prefix/share/bash-completion/completions/macadam
             prefix/share/zsh/site-functions/_macadam prefix/share/fish/vendor_completions.d/macadam.fish)
  if(NOT EXISTS ${WORK}/${file})
    message(FATAL_ERROR "${file} is not there")
  endif()
endforeach()
