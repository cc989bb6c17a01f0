# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs the package, then builds and runs a project that finds it, and one that contains it.
#   cmake -D SOURCE=... -D BUILD=... -D WORK=... -D COMPILER=... -P test_install.cmake

function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed: ${ARGV}\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
foreach(way find_package add_subdirectory)
  run(${CMAKE_COMMAND} -S ${SOURCE}/test/install/consumer -B ${WORK}/${way} -G Ninja -D WAY=${way}
      -D CMAKE_BUILD_TYPE=Release -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_PREFIX_PATH=${WORK}/prefix
      -D MIXED_MESH_3_SOURCE_DIR=${SOURCE})
  run(${CMAKE_COMMAND} --build ${WORK}/${way})
  run(${WORK}/${way}/consumer)
endforeach()
