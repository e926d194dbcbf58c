# SPDX-License-Identifier: GPL-3.0-or-later
# Finds the libraries that Macadam needs, all of them from Debian packages, which scripts/dependencies lists.
if(MACADAM_FUZZ)  # the readers need no threads, and clang's OpenMP would be another package to install
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
# CMake omits this dependency, which matters for the link order of static libraries
target_link_libraries(hdf5::hdf5_cpp INTERFACE hdf5::hdf5)
# later HDF5 versions change the arguments of some functions
target_compile_definitions(hdf5::hdf5_cpp INTERFACE H5_USE_110_API)
set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE TRUE)
set(CMAKE_POLICY_DEFAULT_CMP0167 NEW)  # CGAL searches for Boost in a way about which CMake 3.30 and later warn
find_package(CGAL 5.5 REQUIRED)
find_package(Boost 1.74 REQUIRED CONFIG)  # only headers: the distributions of Boost.Math

# Makes an imported target of a header and a library, for libraries without CMake targets, as Debian's SuiteSparse and
# METIS
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
# Ceres has CMake targets, but they would link ATLAS in addition to the BLAS that SuiteSparse uses. The shared library
# loads what it needs itself, so linking only that library is enough.
macadam_find_library(Ceres::ceres ceres/ceres.h "" ceres)
macadam_find_library(glog::glog glog/logging.h "" glog)

# Finds ITK, for images of computed tomography. This is a function, because ITK's configuration also searches for
# libraries and would overwrite the variables of the libraries found above.
function(macadam_find_itk)
  find_package(ITK 5.2 QUIET COMPONENTS ITKIOMeta ITKIONRRD ITKIOTIFF ITKIOPNG ITKSmoothing ITKDistanceMap)
  if(ITK_FOUND)
    add_library(ITK::ITK INTERFACE IMPORTED)
    target_include_directories(ITK::ITK SYSTEM INTERFACE ${ITK_INCLUDE_DIRS})
    # Links only the libraries whose code is used. ITK_LIBRARIES also names the dependencies of modules of which only
    # headers are used.
    target_link_libraries(ITK::ITK INTERFACE ITKCommon ITKIOImageBase ITKIOMeta ITKIONRRD ITKIOTIFF ITKIOPNG ITKSmoothing)
  endif()
  set(ITK_FOUND ${ITK_FOUND} PARENT_SCOPE)
  set(MACADAM_ITK_VERSION "${ITK_VERSION_MAJOR}.${ITK_VERSION_MINOR}" PARENT_SCOPE)
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

# Returns the CUDA architectures of a release: machine code for all device generations in use that this nvcc knows, and
# PTX of the newest one for later devices.
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
    elseif(NOT CMAKE_CUDA_ARCHITECTURES AND DEFINED ENV{CUDAARCHS})  # CMake reads it only at the first configuration
      set(CMAKE_CUDA_ARCHITECTURES "$ENV{CUDAARCHS}")
    elseif(NOT CMAKE_CUDA_ARCHITECTURES)
      # Compiles machine code for compute capability 9.0. For other devices from 7.5 on, the driver compiles the PTX.
      set(CMAKE_CUDA_ARCHITECTURES "75-virtual;90-real")
    endif()
    enable_language(CUDA)
    if(NOT DEFINED CMAKE_CUDA20_STANDARD_COMPILE_OPTION)  # CMake 3.25 of Debian 12 does not know the option for C++20
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

# Finds MPI and NCCL, for several processes with one device each: MPI starts the processes, NCCL passes messages between
# the devices
set(MACADAM_HAS_RANKS OFF)
if(MACADAM_RANKS STREQUAL "ON" AND NOT MACADAM_HAS_CUDA)
  message(FATAL_ERROR "MACADAM_RANKS=ON but there is no CUDA backend; use MACADAM_RANKS=AUTO")
endif()
if(MACADAM_HAS_CUDA AND NOT MACADAM_RANKS STREQUAL "OFF")
  find_package(MPI QUIET COMPONENTS C)
  find_path(NCCL_INCLUDE nccl.h HINTS ${CUDAToolkit_INCLUDE_DIRS})
  find_library(NCCL_LIBRARY nccl HINTS ${CUDAToolkit_LIBRARY_ROOT} ${CUDAToolkit_LIBRARY_DIR} PATH_SUFFIXES lib lib64)
  if(MPI_C_FOUND AND NCCL_INCLUDE AND NCCL_LIBRARY)
    add_library(NCCL::nccl INTERFACE IMPORTED)
    target_include_directories(NCCL::nccl SYSTEM INTERFACE ${NCCL_INCLUDE} ${CUDAToolkit_INCLUDE_DIRS})
    target_link_libraries(NCCL::nccl INTERFACE ${NCCL_LIBRARY})
    set(MACADAM_HAS_RANKS ON)
  elseif(MACADAM_RANKS STREQUAL "ON")
    message(FATAL_ERROR "MACADAM_RANKS=ON but MPI or NCCL was not found; install libopenmpi-dev and libnccl-dev or use MACADAM_RANKS=AUTO")
  endif()
endif()
message(STATUS "Several processes (MPI and NCCL): ${MACADAM_HAS_RANKS}")
