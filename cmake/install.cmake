# SPDX-License-Identifier: GPL-3.0-or-later
# Installs two components, each of which becomes a package (cmake/package.cmake): `program` has the program and
# everything that it needs, `development` everything that is needed to build programs with the library. The CUDA backend
# is in neither of them; docs/python.md says why it is not distributed.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)
install(TARGETS macadam EXPORT macadamTargets LIBRARY NAMELINK_COMPONENT development)
install(TARGETS macadam_cli)
if(MACADAM_HAS_CUDA)
  install(TARGETS macadam_cuda COMPONENT cuda)
endif()
if(MACADAM_HAS_RANKS)
  install(TARGETS macadam_ranks COMPONENT cuda)
endif()
install(PROGRAMS scripts/draw-fit scripts/draw-calibration scripts/draw-relaxation DESTINATION ${CMAKE_INSTALL_DATADIR}/macadam)
install(DIRECTORY examples/ DESTINATION ${CMAKE_INSTALL_DATADIR}/macadam/examples)
# Reports and studies, which are plain Python; host/cli/tool_commands/python_commands.cpp starts them
install(DIRECTORY python/macadam DESTINATION ${CMAKE_INSTALL_DATADIR}/macadam/python
        FILES_MATCHING PATTERN "*.py" PATTERN "*.css" PATTERN "py.typed" PATTERN "__pycache__" EXCLUDE)
# Manual page and completions of shells
install(FILES ${PROJECT_BINARY_DIR}/macadam.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${PROJECT_BINARY_DIR}/completion/macadam.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        RENAME macadam)
install(FILES ${PROJECT_BINARY_DIR}/completion/macadam.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/${MACADAM_ZSH_FOLDER}
        RENAME _macadam)
install(FILES ${PROJECT_BINARY_DIR}/completion/macadam.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
install(FILES cmake/copyright CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

# Files for `find_package(macadam)`. The library hides its own dependencies, so its users need not install their
# headers.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)
install(DIRECTORY include/macadam DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
# The kernels as templates, for contact laws that users write
install(DIRECTORY kernels DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/macadam-kernels FILES_MATCHING PATTERN "*.hpp")
install(EXPORT macadamTargets NAMESPACE macadam:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/macadam)
configure_package_config_file(cmake/macadamConfig.cmake.in ${PROJECT_BINARY_DIR}/macadamConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/macadam PATH_VARS CMAKE_INSTALL_INCLUDEDIR)
write_basic_package_version_file(macadamConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/macadamConfig.cmake ${PROJECT_BINARY_DIR}/macadamConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/macadam)
unset(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME)
