# SPDX-License-Identifier: GPL-3.0-or-later
# Libraries, all from Debian packages (scripts/dependencies names them).
if(MACADAM_FUZZ)  # the readers need no threads, and clang's OpenMP is a package more
  add_library(OpenMP::OpenMP_CXX INTERFACE IMPORTED)
  target_compile_options(OpenMP::OpenMP_CXX INTERFACE -Wno-unknown-pragmas -Wno-source-uses-openmp)
else()
  find_package(OpenMP REQUIRED COMPONENTS CXX)
endif()
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt 9 REQUIRED)
find_package(nlohmann_json 3.10 REQUIRED)
find_package(tomlplusplus 3.2 REQUIRED)
find_package(CLI11 2.1 REQUIRED)
find_package(ZLIB REQUIRED)
find_package(HDF5 REQUIRED COMPONENTS C CXX)
target_link_libraries(hdf5::hdf5_cpp INTERFACE hdf5::hdf5)  # which CMake leaves out: static libraries are taken in order
target_compile_definitions(hdf5::hdf5_cpp INTERFACE H5_USE_110_API)  # later ones have functions of the same names that ask for more
set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE TRUE)
set(CMAKE_POLICY_DEFAULT_CMP0167 NEW)  # CGAL asks for Boost in a way that CMake 3.30 and later warn of
find_package(CGAL 5.5 REQUIRED)
find_package(Boost 1.74 REQUIRED CONFIG)  # headers: distributions of Math

# Debian's SuiteSparse and METIS bring no CMake targets of their own
function(macadam_find_library target header suffix library)
  string(MAKE_C_IDENTIFIER "${target}" id)
  find_path(${id}_INCLUDE ${header} PATH_SUFFIXES ${suffix} REQUIRED)
  find_library(${id}_LIBRARY ${library} REQUIRED)
  add_library(${target} INTERFACE IMPORTED)
  target_include_directories(${target} SYSTEM INTERFACE ${${id}_INCLUDE})
  target_link_libraries(${target} INTERFACE ${${id}_LIBRARY})
endfunction()
macadam_find_library(SuiteSparse::CHOLMOD cholmod.h suitesparse cholmod)
macadam_find_library(METIS::METIS metis.h "" metis)
# Ceres brings some, which link ATLAS beside the BLAS that SuiteSparse takes; the shared library asks for what it needs itself
macadam_find_library(Ceres::ceres ceres/ceres.h "" ceres)
macadam_find_library(glog::glog glog/logging.h "" glog)

# Images of computed tomography. In a function, because ITK's configuration looks for libraries of its own and would leave
# other values in the variables of those above.
function(macadam_find_itk)
  find_package(ITK 5.2 QUIET COMPONENTS ITKIOMeta ITKIONRRD ITKIOTIFF ITKIOPNG ITKSmoothing ITKDistanceMap)
  if(ITK_FOUND)
    add_library(ITK::ITK INTERFACE IMPORTED)
    target_include_directories(ITK::ITK SYSTEM INTERFACE ${ITK_INCLUDE_DIRS})
    # the libraries of code; the rest of the list is what modules of headers alone depend on
    target_link_libraries(ITK::ITK INTERFACE ITKCommon ITKIOImageBase ITKIOMeta ITKIONRRD ITKIOTIFF ITKIOPNG ITKSmoothing)
  endif()
  set(ITK_FOUND ${ITK_FOUND} PARENT_SCOPE)
endfunction()
set(MACADAM_HAS_CT OFF)
if(NOT MACADAM_CT STREQUAL "OFF")
  macadam_find_itk()
  if(ITK_FOUND)
    set(MACADAM_HAS_CT ON)
  elseif(MACADAM_CT STREQUAL "ON")
    message(FATAL_ERROR "MACADAM_CT=ON but ITK 5.2 or later was not found; install libinsighttoolkit5-dev or use MACADAM_CT=AUTO")
  endif()
endif()
message(STATUS "CT images: ${MACADAM_HAS_CT}")

# Machine code for the generations in use, as far as this nvcc knows them, and code of the newest for what comes after.
function(macadam_release_architectures result)
  execute_process(COMMAND ${CMAKE_CUDA_COMPILER} --list-gpu-code OUTPUT_VARIABLE known COMMAND_ERROR_IS_FATAL ANY)
  foreach(version 80 86 89 90 100 120)
    if(known MATCHES "sm_${version}(\n|$)")
      list(APPEND architectures ${version}-real)
      set(newest ${version})
    endif()
  endforeach()
  if(NOT newest)
    message(FATAL_ERROR "MACADAM_CUDA_RELEASE: ${CMAKE_CUDA_COMPILER} knows none of 8.0, 8.6, 8.9, 9.0, 10.0 and 12.0")
  endif()
  list(APPEND architectures ${newest}-virtual)
  message(STATUS "CUDA code: ${architectures}")
  set(${result} ${architectures} PARENT_SCOPE)
endfunction()

set(MACADAM_HAS_CUDA OFF)
if(NOT MACADAM_CUDA STREQUAL "OFF")
  if(NOT CMAKE_CUDA_COMPILER AND EXISTS /usr/local/cuda/bin/nvcc)
    set(CMAKE_CUDA_COMPILER /usr/local/cuda/bin/nvcc)
  endif()
  check_language(CUDA)
  if(CMAKE_CUDA_COMPILER)
    if(MACADAM_CUDA_RELEASE)
      macadam_release_architectures(CMAKE_CUDA_ARCHITECTURES)
    elseif(NOT CMAKE_CUDA_ARCHITECTURES AND DEFINED ENV{CUDAARCHS})  # CMake asks for it only when it meets the compiler first
      set(CMAKE_CUDA_ARCHITECTURES "$ENV{CUDAARCHS}")
    elseif(NOT CMAKE_CUDA_ARCHITECTURES)
      set(CMAKE_CUDA_ARCHITECTURES "75-virtual;90-real")  # made for sm_90; the driver compiles for any other from 7.5 on
    endif()
    enable_language(CUDA)
    if(NOT DEFINED CMAKE_CUDA20_STANDARD_COMPILE_OPTION)  # Debian 12's CMake 3.25 does not know it
      set(CMAKE_CUDA20_STANDARD_COMPILE_OPTION "-std=c++20")
      set(CMAKE_CUDA20_EXTENSION_COMPILE_OPTION "-std=c++20")
    endif()
    find_package(CUDAToolkit REQUIRED)
    set(MACADAM_HAS_CUDA ON)
  elseif(MACADAM_CUDA STREQUAL "ON")
    message(FATAL_ERROR "MACADAM_CUDA=ON but no CUDA compiler was found; set CMAKE_CUDA_COMPILER or use MACADAM_CUDA=AUTO")
  endif()
endif()
message(STATUS "CUDA backend: ${MACADAM_HAS_CUDA}")
