# SPDX-License-Identifier: GPL-3.0-or-later
# Settings of CPack, which scripts/release calls to make two Debian packages: `macadam`, and `libmacadam-dev` for
# building programs with the library. dpkg-shlibdeps finds their dependencies from the binaries.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME macadam)
set(CPACK_PACKAGE_VERSION ${MACADAM_VERSION})
set(CPACK_PACKAGE_CONTACT "The maintainers of Macadam <maintainers@macadam.invalid>" CACHE STRING "Who answers for the packages")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "stiffness of asphalt mixtures by discrete elements")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/package)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)  # this also makes the package run ldconfig
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME macadam)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "Macadam builds a virtual specimen from a mix design, grain by grain, loads it,
and gives the stiffness modulus and the phase angle over frequency and
temperature. This package has the program and its library, without the CUDA
backend.")
# Recommended: a fast BLAS for SuiteSparse, and matplotlib for pictures. Reports and studies need newer versions of
# pandas and matplotlib than Debian 12 has, so these packages are only suggested; on Debian 12 pip installs them.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "libopenblas0, python3-matplotlib")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "python3-pandas (>= 2), python3-venv")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libmacadam-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "macadam (= ${MACADAM_VERSION})")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "What programs in C++ that are built with Macadam's library need, and its
kernels as templates for contact laws of one's own.")

# Compresses the files that Debian wants compressed, without a time stamp, so that the same sources give the same
# package
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/compress_pages.cmake)
include(CPack)
