# SPDX-License-Identifier: GPL-3.0-or-later
# Debian packages by CPack, which scripts/release calls: `macadam`, and `libmacadam-dev` for programs that are built with the
# library. What they depend on, dpkg-shlibdeps finds in the binaries.
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
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)  # and with it ldconfig
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME macadam)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "Macadam builds a virtual specimen from a mix design, grain by grain, loads it,
and gives the stiffness modulus and the phase angle over frequency and
temperature. This package has the program and its library, without the CUDA
backend.")
# A fast BLAS below SuiteSparse; pictures, reports and studies: Debian 12's pandas and matplotlib are older than these two ask for, so pip brings them there
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "libopenblas0, python3-matplotlib")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "python3-pandas (>= 2), python3-venv")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libmacadam-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "macadam (= ${MACADAM_VERSION})")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "What programs in C++ that are built with Macadam's library need, and its
kernels as templates for contact laws of one's own.")

# What Debian compresses: with no time in it, so that the same sources give the same package
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/compress_pages.cmake)
include(CPack)
