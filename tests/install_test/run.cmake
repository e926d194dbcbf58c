# SPDX-License-Identifier: GPL-3.0-or-later
# Installs a build, then builds and runs an outside project and the installed program:
#   cmake -D BUILD=<build folder> -D WORK=<scratch folder> -D COMPILER=<C++ compiler> -P run.cmake
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# The installed package may ask its users for none of these
foreach(library CGAL Boost Eigen3 fmt nlohmann_json tomlplusplus CLI11 ZLIB HDF5 ITK OpenMP CUDAToolkit)
  list(APPEND absent -D CMAKE_DISABLE_FIND_PACKAGE_${library}=ON)
endforeach()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${WORK}/build -G Ninja ${absent}
    -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_PREFIX_PATH=${WORK}/prefix)
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/macadam_user)
run(${WORK}/prefix/bin/macadam info)
run(${WORK}/prefix/bin/macadam fit ${WORK}/prefix/share/macadam/examples/laws/mastic.csv --shift wlf --units 3 --out ${WORK}/law)
foreach(file prefix/share/macadam/draw-fit prefix/share/macadam/draw-calibration law/law.toml)
  if(NOT EXISTS ${WORK}/${file})
    message(FATAL_ERROR "${file} is not there")
  endif()
endforeach()
