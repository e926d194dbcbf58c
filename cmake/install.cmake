# SPDX-License-Identifier: GPL-3.0-or-later
# `find_package(macadam)`: the library hides its own dependencies, so a user needs none of them.
install(TARGETS macadam EXPORT macadamTargets)
install(TARGETS macadam_cli)
install(DIRECTORY include/macadam DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(PROGRAMS scripts/draw-fit scripts/draw-calibration scripts/draw-relaxation DESTINATION ${CMAKE_INSTALL_DATADIR}/macadam)
install(DIRECTORY examples/ DESTINATION ${CMAKE_INSTALL_DATADIR}/macadam/examples)
install(EXPORT macadamTargets NAMESPACE macadam:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/macadam)
file(WRITE ${PROJECT_BINARY_DIR}/macadamConfig.cmake "include(\${CMAKE_CURRENT_LIST_DIR}/macadamTargets.cmake)\n")
write_basic_package_version_file(macadamConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/macadamConfig.cmake ${PROJECT_BINARY_DIR}/macadamConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/macadam)
