# SPDX-FileCopyrightText: The verge authors
# SPDX-License-Identifier: Apache-2.0

# What every target of ours is compiled with. No global flags: each target links verge_options privately.
add_library(verge_options INTERFACE)
target_compile_features(verge_options INTERFACE cxx_std_20)
target_compile_options(verge_options INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual
  -Wold-style-cast -Wcast-align -Wformat=2
  # clang's also warns of a float in Vec3{x, y, z}, which is meant.
  $<$<CXX_COMPILER_ID:GNU>:-Wdouble-promotion>
  # Same bytes out on every machine: no fused multiply-add behind our back.
  -ffp-contract=off)
# The loops over points test for NaN themselves; letting the compiler assume that comparisons do not trap and that
# errno is not read lets it vectorise them. Results do not change.
target_compile_options(verge_options INTERFACE -fno-math-errno -fno-trapping-math)
# g++ 12 warns of an overlap that cannot be in `"text" + string` (GCC bug 105651), where it inlines: in optimised builds.
target_compile_options(verge_options INTERFACE $<$<AND:$<CXX_COMPILER_ID:GNU>,$<CONFIG:Release>>:-Wno-restrict>)
if(VERGE_WERROR)
  target_compile_options(verge_options INTERFACE -Werror)
endif()
if(CMAKE_BUILD_TYPE STREQUAL "Release" OR CMAKE_BUILD_TYPE STREQUAL "RelWithDebInfo")
  # Bounds of standard containers stay checked in what users run: input is hostile.
  target_compile_definitions(verge_options INTERFACE _GLIBCXX_ASSERTIONS)
endif()
if(VERGE_SANITIZE)
  target_compile_options(verge_options INTERFACE
    -fsanitize=${VERGE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(verge_options INTERFACE -fsanitize=${VERGE_SANITIZE})
endif()

# Tests are compiled for a short build, since they are most of it: what they test is in the rooms' libraries, compiled in full.
# Under the sanitizers the tests' own code keeps the checks of addresses and of arithmetic, not those of each pointer.
set(VERGE_TEST_OPTIONS "")
if(CMAKE_BUILD_TYPE STREQUAL "Release")
  set(VERGE_TEST_OPTIONS -O1)
elseif(VERGE_SANITIZE MATCHES undefined)
  set(VERGE_TEST_OPTIONS -O0 -fno-sanitize=null,alignment,vptr,object-size,nonnull-attribute,returns-nonnull-attribute)
endif()
