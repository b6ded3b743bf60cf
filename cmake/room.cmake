# One library a room: genio_room(forward a.cpp b.cpp) makes genio_forward, alias genio::forward.
include(GNUInstallDirs)

add_library(genio_flags INTERFACE)
target_compile_options(genio_flags INTERFACE -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Wno-psabi
                       -Wno-maybe-uninitialized -Wno-restrict)  # GCC 12 bugs 105593, 105329
target_compile_definitions(genio_flags INTERFACE GENIO_VERSION="${PROJECT_VERSION}")
if(GENIO_WERROR)
  # GCC 12 bug 105593 once more: Eigen's AVX-512 logarithm, so only on machines that have it.
  target_compile_options(genio_flags INTERFACE -Werror -Wno-error=uninitialized)
endif()
if(GENIO_NATIVE)
  target_compile_options(genio_flags INTERFACE -march=native)
endif()
if(GENIO_SANITIZE)
  target_compile_options(genio_flags INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer
                         -fno-sanitize-recover=undefined)
  target_link_options(genio_flags INTERFACE -fsanitize=address,undefined)
endif()

function(genio_room name)
  add_library(genio_${name} STATIC ${ARGN})
  add_library(genio::${name} ALIAS genio_${name})
  set_target_properties(genio_${name} PROPERTIES EXPORT_NAME ${name})
  target_link_libraries(genio_${name} PRIVATE $<BUILD_INTERFACE:genio_flags>)
  target_compile_features(genio_${name} PUBLIC cxx_std_20)
  target_include_directories(genio_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/genio>)
endfunction()
