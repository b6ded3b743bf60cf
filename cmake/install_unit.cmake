# Run by `cmake --install`: see install.cmake.
get_filename_component(prefix "${CMAKE_INSTALL_PREFIX}" ABSOLUTE)
get_filename_component(GENIO_PROGRAM "${GENIO_BINDIR}/genio" ABSOLUTE BASE_DIR "${prefix}")
string(REPLACE "%" "%%" GENIO_PROGRAM "${GENIO_PROGRAM}")  # a specifier of systemd otherwise
configure_file("${GENIO_UNIT_TEMPLATE}" "${GENIO_UNIT}" @ONLY)
file(INSTALL "${GENIO_UNIT}" DESTINATION "${prefix}/lib/systemd/system")
