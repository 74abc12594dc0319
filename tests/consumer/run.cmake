# SPDX-FileCopyrightText: The verge authors
# SPDX-License-Identifier: Apache-2.0

# cmake -D BUILD=DIR -P run.cmake: installs the build in DIR to a fresh prefix, and has the program there and the
# consumer beside this file work on a simulated drive.
set(work ${BUILD}/consumer)
set(prefix ${work}/prefix)
file(REMOVE_RECURSE ${work})

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${work}/build -G Ninja -D CMAKE_PREFIX_PATH=${prefix}
    -D CMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${work}/build -- -k 0)
run(${prefix}/bin/verge simulate street --scans 40 -o ${work}/drive)

execute_process(COMMAND ${work}/build/consumer ${work}/drive/LIDAR_TOP
  OUTPUT_VARIABLE printed COMMAND_ERROR_IS_FATAL ANY)
message("${printed}")
foreach(side IN ITEMS left right)
  if(NOT printed MATCHES "${side}")
    message(FATAL_ERROR "the consumer found no ${side} boundary on the simulated drive")
  endif()
endforeach()
