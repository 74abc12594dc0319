# SPDX-FileCopyrightText: The verge authors
# SPDX-License-Identifier: Apache-2.0

# cmake --install, and what find_package(verge) reads:
#
#   find_package(verge REQUIRED COMPONENTS io detect)   # or none: all rooms
#   target_link_libraries(mine PRIVATE verge::io verge::detect)
#
# A component is a room. Only the outside libraries of the rooms asked for (and of those behind them) are looked up.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(VERGE_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/verge)

# Libraries without a binary that no header of ours shows: whoever links an installed room needs none of them.
set(VERGE_HEADER_ONLY CLI11::CLI11 Eigen3::Eigen nlohmann_json::nlohmann_json)

# verge_hide_header_only(OUT libraries...): the libraries, those of VERGE_HEADER_ONLY visible in this build alone.
function(verge_hide_header_only out)
  set(libraries "")
  foreach(library IN LISTS ARGN)
    if(library IN_LIST VERGE_HEADER_ONLY)
      set(library $<BUILD_INTERFACE:${library}>)
    endif()
    list(APPEND libraries ${library})
  endforeach()
  set(${out} ${libraries} PARENT_SCOPE)
endfunction()

# verge_install_room(NAME ROOMS ... LIBRARIES ...): installs a room and notes what find_package has to look up for it.
function(verge_install_room name)
  cmake_parse_arguments(ROOM "" "" "ROOMS;LIBRARIES" ${ARGN})
  install(TARGETS verge_${name} EXPORT vergeTargets FILE_SET HEADERS)
  list(FILTER ROOM_LIBRARIES EXCLUDE REGEX "BUILD_INTERFACE|^/")
  set_property(GLOBAL APPEND PROPERTY VERGE_COMPONENTS ${name})
  set_property(GLOBAL APPEND_STRING PROPERTY VERGE_COMPONENT_LINES
    "set(verge_rooms_behind_${name} ${ROOM_ROOMS})\nset(verge_libraries_of_${name} ${ROOM_LIBRARIES})\n")
endfunction()

# verge_install_package(): after all rooms, installs the files that find_package(verge) reads.
function(verge_install_package)
  get_property(VERGE_COMPONENTS GLOBAL PROPERTY VERGE_COMPONENTS)
  get_property(VERGE_COMPONENT_LINES GLOBAL PROPERTY VERGE_COMPONENT_LINES)
  configure_package_config_file(cmake/vergeConfig.cmake.in ${PROJECT_BINARY_DIR}/vergeConfig.cmake
    INSTALL_DESTINATION ${VERGE_PACKAGE_DIR} NO_SET_AND_CHECK_MACRO)
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/vergeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/vergeConfig.cmake ${PROJECT_BINARY_DIR}/vergeConfigVersion.cmake
    DESTINATION ${VERGE_PACKAGE_DIR})
  install(EXPORT vergeTargets NAMESPACE verge:: DESTINATION ${VERGE_PACKAGE_DIR})
  install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
endfunction()
