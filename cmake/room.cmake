# One library a room.
include(GNUInstallDirs)

add_library(genio_flags INTERFACE)
target_compile_options(genio_flags INTERFACE -fPIC -pthread -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Wno-psabi
                       -Wno-maybe-uninitialized -Wno-restrict -Wno-array-bounds
                       -Wno-stringop-overflow -Wno-stringop-overread)  # GCC 12 bugs 105593, 105329, 105651
target_compile_definitions(genio_flags INTERFACE GENIO_VERSION="${PROJECT_VERSION}")
# The compiler's garbage collector takes a tenth of the time; memory per process grows by a seventh.
target_compile_options(genio_flags INTERFACE
  $<$<CXX_COMPILER_ID:GNU>:SHELL:--param=ggc-min-heapsize=400000 --param=ggc-min-expand=300>)
if(GENIO_WERROR)
  # GCC 12 bug 105593 once more: Eigen's AVX-512 logarithm, so only on machines that have it.
  target_compile_options(genio_flags INTERFACE -Werror -Wno-error=uninitialized)
endif()
target_compile_options(genio_flags INTERFACE ${GENIO_ARCH_FLAG})
if(GENIO_FUZZ)
  target_compile_options(genio_flags INTERFACE -fsanitize=fuzzer-no-link,address,undefined
                         -fno-sanitize-recover=undefined -fno-omit-frame-pointer
                         -fsanitize-coverage-ignorelist=${CMAKE_CURRENT_LIST_DIR}/fuzz_ignore.txt
                         -Wno-unknown-warning-option)
  target_link_options(genio_flags INTERFACE -fsanitize=address,undefined)
elseif(GENIO_SANITIZE)
  target_compile_options(genio_flags INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer
                         -fno-sanitize-recover=undefined)
  target_link_options(genio_flags INTERFACE -fsanitize=address,undefined)
endif()

# Eigen aligns by the processor it is compiled for; whoever links this must align alike.
set(genio_align EIGEN_MAX_ALIGN_BYTES=64)
target_compile_definitions(genio_flags INTERFACE ${genio_align})

# Headers read once for all files: genio_precompiled(TARGET genio_pch).
foreach(kind pch pch_program pch_tests)
  file(WRITE ${PROJECT_BINARY_DIR}/${kind}.cpp "")
  add_library(genio_${kind} OBJECT EXCLUDE_FROM_ALL ${PROJECT_BINARY_DIR}/${kind}.cpp)
  target_link_libraries(genio_${kind} PRIVATE genio_flags Eigen3::Eigen fmt::fmt)
  target_include_directories(genio_${kind} PRIVATE ${PROJECT_SOURCE_DIR})
  target_precompile_headers(genio_${kind} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/${kind}.hpp)
  set_target_properties(genio_${kind} PROPERTIES UNITY_BUILD OFF)
endforeach()
target_link_libraries(genio_pch_program PRIVATE CLI11::CLI11 nlohmann_json::nlohmann_json)
function(genio_precompiled target kind)
  target_precompile_headers(${target} REUSE_FROM genio_${kind})
endfunction()

# With CMAKE_UNITY_BUILD=ON (presets release and ci) the sources of a folder are compiled as one
# file, which instantiates their templates once: genio_grouped(TARGET [SINGLE_FOLDER ...]). So names
# in the anonymous namespaces of one folder must differ; the compiler says where they do not. Folders
# whose files are alike by design, as readers of formats, are compiled file by file.
function(genio_grouped target)
  get_target_property(sources ${target} SOURCES)
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  foreach(source ${sources})
    get_filename_component(folder ${source} DIRECTORY)
    file(RELATIVE_PATH sub ${CMAKE_CURRENT_SOURCE_DIR} ${folder})
    file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${folder})
    if(sub AND sub IN_LIST ARGN)
      set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    else()
      string(MAKE_C_IDENTIFIER "${folder}" group)
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
    endif()
  endforeach()
endfunction()

# Puts the headers of a folder in the place of folder/* in a list of headers.
function(genio_spell_out list)
  set(headers "")
  foreach(header ${${list}})
    if(header MATCHES "[*]$")
      file(GLOB found RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} CONFIGURE_DEPENDS
           ${CMAKE_CURRENT_SOURCE_DIR}/${header}.hpp)
      list(TRANSFORM found REPLACE "[.]hpp$" "")
      list(APPEND headers ${found})
    else()
      list(APPEND headers ${header})
    endif()
  endforeach()
  set(${list} ${headers} PARENT_SCOPE)
endfunction()

# Sources that must run on every processor of the kind, whatever the rest is compiled for.
function(genio_checks_processor)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON
                              SKIP_PRECOMPILE_HEADERS ON)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS -march=x86-64)
  endif()
endfunction()

# genio_room(forward
#   ROOMS base geometry ...       sub-rooms, lowest first: a file may include its own and lower ones;
#                                 . is the room's own folder, where that holds files beside them
#   HEADERS base/types ...        what other rooms may include; these are installed. folder/* means
#                                 all headers of a folder
#   SINGLY recording/curves ...   sub-rooms whose files define alike names (genio_grouped)
#   PUBLIC ... PRIVATE ...        libraries and rooms it links
#   INTERNAL)                     not installed
# Sources are every .cpp of the sub-rooms (of the room's own folder where there are none), so that a
# new file needs no line here. check_rooms.py holds the includes against what is said here.
function(genio_room name)
  cmake_parse_arguments(room "INTERNAL" "" "ROOMS;HEADERS;SINGLY;PUBLIC;PRIVATE" ${ARGN})
  genio_spell_out(room_HEADERS)
  set(patterns ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  set(room_FOLDERS ${room_ROOMS})
  list(REMOVE_ITEM room_FOLDERS .)
  foreach(sub ${room_FOLDERS})
    list(APPEND patterns ${CMAKE_CURRENT_SOURCE_DIR}/${sub}/*.cpp)
  endforeach()
  file(GLOB sources CONFIGURE_DEPENDS ${patterns})
  add_library(genio_${name} STATIC ${sources})
  add_library(genio::${name} ALIAS genio_${name})
  set_target_properties(genio_${name} PROPERTIES EXPORT_NAME ${name})
  target_link_libraries(genio_${name} PUBLIC ${room_PUBLIC}
                        PRIVATE ${room_PRIVATE} $<BUILD_INTERFACE:genio_flags>)
  target_compile_features(genio_${name} PUBLIC cxx_std_20)
  genio_precompiled(genio_${name} pch)
  genio_grouped(genio_${name} ${room_SINGLY})
  target_include_directories(genio_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/genio>)
  genio_describe(${name} "${room_ROOMS}" "${room_HEADERS}" "${room_PUBLIC};${room_PRIVATE}")
  if(room_INTERNAL)
    return()
  endif()
  install(TARGETS genio_${name} EXPORT genioTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  foreach(header ${room_HEADERS})
    get_filename_component(folder ${header} DIRECTORY)
    install(FILES ${header}.hpp
            DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/genio/${name}/${folder})
  endforeach()
endfunction()

# One line a room in build/rooms.txt: what check_rooms.py reads.
function(genio_describe name rooms headers links)
  set(line "${name}|${rooms}|${headers}|${links}")
  string(REPLACE ";" " " line "${line}")
  set_property(GLOBAL APPEND_STRING PROPERTY GENIO_ROOMS "${line}\n")
endfunction()
