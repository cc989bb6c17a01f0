# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs the package, runs its programs, then builds and runs a project that finds it, and one that contains it.
#   cmake -D SOURCE=... -D BUILD=... -D WORK=... -D COMPILER=... -D CONSUMERS=... -D PROGRAMS=... -D BINDIR=...
#         -D DOCDIR=... -P test_install.cmake
# CONSUMERS are programs of consumer/, PROGRAMS those that are installed.

function(run)
  execute_process(COMMAND ${ARGV} WORKING_DIRECTORY ${WORK} RESULT_VARIABLE result OUTPUT_VARIABLE output
                  ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed: ${ARGV}\n${output}")
  endif()
endfunction()

# Builds and runs some of the consumers; Debug compiles fastest.
function(consume way)
  string(REPLACE ";" "\\;" consumers "${ARGN}")
  run(${CMAKE_COMMAND} -S ${SOURCE}/test/install/consumer -B ${WORK}/${way} -G Ninja -D WAY=${way}
      -D CMAKE_BUILD_TYPE=Debug -D CMAKE_CXX_FLAGS_DEBUG=-O0 -D CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE=TRUE
      -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_PREFIX_PATH=${WORK}/prefix -D MIXED_MESH_3_SOURCE_DIR=${SOURCE}
      -D "CONSUMERS=${consumers}")
  run(${CMAKE_COMMAND} --build ${WORK}/${way} --parallel 1)
  foreach(consumer ${ARGN})
    run(${WORK}/${way}/${consumer})
  endforeach()
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
foreach(program ${PROGRAMS})
  run(${WORK}/prefix/${BINDIR}/${program} --version)
endforeach()
if(NOT EXISTS ${WORK}/prefix/${DOCDIR}/LICENSE)
  message(FATAL_ERROR "LICENSE is not installed")
endif()
consume(find_package ${CONSUMERS})
consume(add_subdirectory mesh)
