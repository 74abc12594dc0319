# SPDX-FileCopyrightText: The verge authors
# SPDX-License-Identifier: Apache-2.0

# verge_room(NAME SOURCES ... [HEADERS ...] [DEPENDS rooms] [PUBLIC libraries] [PRIVATE libraries] [TESTS files])
#
# One library a room: verge::NAME, headers beside sources, include root = the repository.
# DEPENDS names other rooms (public), PUBLIC names outside libraries that a header of the room shows, PRIVATE those
# that none does.
# TESTS makes one executable of the room's unit tests, found by CTest as NAME.*
function(verge_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;HEADERS;DEPENDS;PUBLIC;PRIVATE;TESTS" ${ARGN})
  add_library(verge_${name} STATIC ${ROOM_SOURCES})
  add_library(verge::${name} ALIAS verge_${name})
  set_target_properties(verge_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_sources(verge_${name} PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${ROOM_HEADERS})
  target_compile_features(verge_${name} PUBLIC cxx_std_20)
  list(TRANSFORM ROOM_DEPENDS PREPEND verge:: OUTPUT_VARIABLE rooms)
  verge_hide_header_only(private ${ROOM_PRIVATE})
  target_link_libraries(verge_${name} PUBLIC ${rooms} ${ROOM_PUBLIC} PRIVATE ${private} $<BUILD_INTERFACE:verge_options>)
  verge_install_room(${name} ROOMS ${ROOM_DEPENDS} LIBRARIES ${ROOM_PUBLIC} ${private})
  if(VERGE_DEVELOPER_MODE AND ROOM_TESTS)
    verge_test(${name}_test SOURCES ${ROOM_TESTS} LIBRARIES verge::${name})
  endif()
endfunction()

# verge_test(NAME SOURCES ... LIBRARIES ... [SHARDS N]): a GoogleTest executable whose cases CTest runs one by one; or in N
# shares, where making the cases takes longer than most of them: a process makes all of its cases before it runs one.
function(verge_test name)
  cmake_parse_arguments(TEST "" "SHARDS" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${TEST_SOURCES})
  target_link_libraries(${name} PRIVATE ${TEST_LIBRARIES} verge_options GTest::gmock GTest::gtest_main rapidcheck)
  set_source_files_properties(${TEST_SOURCES} PROPERTIES COMPILE_OPTIONS "${VERGE_TEST_OPTIONS}")
  # Property tests are replayable: the seed is fixed here; set RC_PARAMS by hand for others.
  string(REGEX REPLACE "_test$" "" subject ${name})
  if(TEST_SHARDS)
    math(EXPR last "${TEST_SHARDS} - 1")
    foreach(shard RANGE ${last})
      add_test(NAME ${subject}.share${shard} COMMAND ${name} --gtest_brief=1)
      set_tests_properties(${subject}.share${shard} PROPERTIES TIMEOUT 1200
        ENVIRONMENT "RC_PARAMS=seed=20261122;GTEST_TOTAL_SHARDS=${TEST_SHARDS};GTEST_SHARD_INDEX=${shard}")
    endforeach()
    return()
  endif()
  gtest_discover_tests(${name} TEST_PREFIX ${subject}. DISCOVERY_MODE PRE_TEST PROPERTIES TIMEOUT 300 ENVIRONMENT RC_PARAMS=seed=20261122)
endfunction()
