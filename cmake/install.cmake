# `cmake --install`: program, libraries, headers, data, and a package for find_package(genio).
include(CMakePackageConfigHelpers)
if(GENIO_NATIVE)
  install(CODE "message(WARNING \"Genio was compiled for this machine's processor (GENIO_NATIVE=ON) and \
may not run on another; cmake --preset portable compiles for all.\")")
endif()
install(TARGETS genio RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
# Made where all is built.
include(GNUInstallDirs)
install(FILES ${PROJECT_BINARY_DIR}/cli/genio.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 OPTIONAL)
install(FILES ${PROJECT_BINARY_DIR}/cli/genio.bash RENAME genio
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions OPTIONAL)
# Not built by ./run; `genio bench` says what to do where it is missing.
install(TARGETS genio-bench RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} OPTIONAL)
install(TARGETS genio_messages EXPORT genioTargets)
install(EXPORT genioTargets NAMESPACE genio:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/genio)
install(DIRECTORY data/generic data/anatomy DESTINATION ${CMAKE_INSTALL_DATADIR}/genio)
configure_package_config_file(cmake/genioConfig.cmake.in ${PROJECT_BINARY_DIR}/genioConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/genio)
install(FILES ${PROJECT_BINARY_DIR}/genioConfig.cmake cmake/dependencies.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/genio)

# The unit of systemd names the program by its whole path, which is only known when it is installed.
# systemd looks below /usr and /usr/local; elsewhere `systemctl link` takes it.
install(CODE "set(GENIO_UNIT_TEMPLATE \"${PROJECT_SOURCE_DIR}/cmake/genio.service.in\")
set(GENIO_UNIT \"${PROJECT_BINARY_DIR}/genio.service\")
set(GENIO_BINDIR \"${CMAKE_INSTALL_BINDIR}\")" COMPONENT unit)
install(SCRIPT cmake/install_unit.cmake COMPONENT unit)
